#pragma once
#include "cook.h"
#include "cook_mesh.h"

/// The tool's commands on cooked shapes.
namespace detent_tool {

struct CookRequest {
  std::string input;
  std::string output;
  uint32_t index = 0;  ///< of the cloud, in a file of many
  detent_cook::CookOptions options;
};

/// Reads the points, cooks them, writes the .hull and says what it is. False if any of that failed: then there is a
/// line on standard error, and the output's file stays as it was.
bool cook_file(const CookRequest& request, bool json);

struct MeshRequest {
  std::string input;
  std::string output;
  detent_cook::MeshOptions options;
};

/// Reads the triangles, cooks them, writes the .mesh and says what it is. False as for cook_file().
bool cook_mesh_file(const MeshRequest& request, bool json, const detent_cook::CookProgress& progress);

struct HeightFieldRequest {
  std::string input;
  std::string output;
  double spacing = 1;  ///< of the samples, m
  double height = 1;   ///< of the brightest, m
  bool one_sided = true;
};

/// Reads the picture, cooks it, writes the .field and says what it is. False as for cook_file().
bool cook_height_field_file(const HeightFieldRequest& request, bool json);

/// Says what the .mesh or .field holds. False if the library refuses it.
bool describe_surface_file(const std::string& path, bool json);

/// Reads the parts, cooks them, writes the .compound and says what it is. False as for cook_file().
bool cook_compound_file(const std::string& input, const std::string& output, detent_cook::Frame frame, bool json);

/// Says what the .compound holds. False if the library refuses it.
bool describe_compound_file(const std::string& path, bool json);

/// Says what the .hull holds. False if the library refuses it.
bool describe_hull_file(const std::string& path, bool json);

}  // namespace detent_tool
