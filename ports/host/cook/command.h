#pragma once
#include "cook.h"
#include "cook_mesh.h"

/// The tool's commands for cooked shapes.
namespace detent_tool {

struct CookRequest {
  std::string input;
  std::string output;
  uint32_t index = 0;  ///< index of the cloud in a file of many
  detent_cook::CookOptions options;
};

/// Reads the points, cooks them, writes the .hull and prints a description of it. On failure, returns false, prints a
/// line to standard error, and leaves an existing output file unchanged.
bool cook_file(const CookRequest& request, bool json);

struct MeshRequest {
  std::string input;
  std::string output;
  detent_cook::MeshOptions options;
};

/// Reads the triangles, cooks them, writes the .mesh and prints its description. Failures as in cook_file().
bool cook_mesh_file(const MeshRequest& request, bool json, const detent_cook::CookProgress& progress);

struct HeightFieldRequest {
  std::string input;
  std::string output;
  double spacing = 1;  ///< distance of the samples, m
  double height = 1;   ///< height of the brightest sample, m
  bool one_sided = true;
};

/// Reads the picture, cooks it, writes the .field and prints its description. Failures as in cook_file().
bool cook_height_field_file(const HeightFieldRequest& request, bool json);

/// Prints the content of a .mesh or .field. False if the library refuses it.
bool describe_terrain_file(const std::string& path, bool json);

/// Reads the parts, cooks them, writes the .compound and prints its description. Failures as in cook_file().
bool cook_compound_file(const std::string& input, const std::string& output, detent_cook::Frame frame, bool json);

/// Prints the content of a .compound. False if the library refuses it.
bool describe_compound_file(const std::string& path, bool json);

/// Prints the content of a .hull. False if the library refuses it.
bool describe_hull_file(const std::string& path, bool json);

}  // namespace detent_tool
