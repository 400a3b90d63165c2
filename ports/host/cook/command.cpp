#include "command.h"

#include <math.h>
#include <stdio.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "cook_compound.h"
#include "describe.h"
#include "engine.h"
#include "file.h"
#include "json_line.h"
#include "read_heights.h"
#include "read_mesh.h"
#include "read_points.h"
#include "stream.h"
#include "text.h"

namespace detent_tool {
namespace {

using Json = nlohmann::ordered_json;

bool fail(const std::string& path, const std::string& problem, bool json) {
  if (json) {
    print_json_line({{"file", path}, {"ok", false}, {"problem", problem}});
  } else {
    fprintf(stderr, "%s: %s\n", printable(path).c_str(), printable(problem).c_str());
  }
  return false;
}

/// The bytes of the source file. read() returns false, and prints a line to standard error, if it cannot read them.
struct Source {
  std::vector<uint8_t> bytes;
  std::string_view text;

  bool read(const std::string& path, bool json) {
    if (const std::string problem = read_file(path, bytes); !problem.empty()) return fail(path, problem, json);
    if (bytes.empty()) return fail(path, "is empty, not something to cook", json);
    if (const FileKind kind = kind_of(bytes); kind != FileKind::other)
      return fail(path, is_not(kind, "something to cook"), json);
    text = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    return true;
  }
};

Json json_of(const std::string& path, const detent_cook::HullDescription& hull) {
  Json json = {{"file", path}, {"ok", true}};
  json["vertices"] = hull.vertex_count;
  json["faces"] = hull.face_count;
  json["edges"] = hull.edge_count;
  json["frame"] = hull.principal ? "principal" : "source";
  json["unit"] = ldexp(1.0, hull.exponent);
  json["radius"] = hull.radius;
  json["volume"] = hull.volume;
  json["origin"] = hull.origin;
  json["rotation"] = hull.rotation;
  return json;
}

void print_text(const std::string& path, const detent_cook::HullDescription& hull) {
  printf("%s: %u vertices, %u faces, %u edges, radius %.6g m, volume %.6g m^3, ", printable(path).c_str(),
         hull.vertex_count, hull.face_count, hull.edge_count, hull.radius, hull.volume);
  if (hull.principal) {
    printf("centre of mass at (%.6g, %.6g, %.6g) m of the source, axes turned by (%.6g, %.6g, %.6g, %.6g)",
           hull.origin[0], hull.origin[1], hull.origin[2], hull.rotation[0], hull.rotation[1], hull.rotation[2],
           hull.rotation[3]);
  } else {
    printf("in the source's frame");
  }
}

Json json_of(const std::string& path, const detent_cook::TerrainDescription& terrain) {
  Json json = {{"file", path}, {"ok", true}};
  json["kind"] = terrain.is_mesh ? "mesh" : "height field";
  json["vertices"] = terrain.vertex_count;
  json["triangles"] = terrain.triangle_count;
  if (terrain.is_mesh) {
    json["nodes"] = terrain.node_count;
    json["flat"] = terrain.edges[0];
    json["convex"] = terrain.edges[1];
    json["concave"] = terrain.edges[2];
    json["open"] = terrain.edges[3];
  } else {
    json["columns"] = terrain.columns;
    json["rows"] = terrain.rows;
  }
  json["one_sided"] = terrain.one_sided;
  json["step"] = terrain.step;
  json["low"] = terrain.low;
  json["high"] = terrain.high;
  return json;
}

void print_text(const std::string& path, const detent_cook::TerrainDescription& terrain) {
  printf("%s: ", printable(path).c_str());
  if (terrain.is_mesh) {
    printf("%u triangles, %u vertices, sides: %u flat, %u convex, %u concave, %u open", terrain.triangle_count,
           terrain.vertex_count, terrain.edges[0], terrain.edges[1], terrain.edges[2], terrain.edges[3]);
  } else {
    printf("%u by %u cells, %u triangles", terrain.columns, terrain.rows, terrain.triangle_count);
  }
  printf(", %s, from (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g) m, step %.3g m",
         terrain.one_sided ? "one-sided" : "two-sided", terrain.low[0], terrain.low[1], terrain.low[2], terrain.high[0],
         terrain.high[1], terrain.high[2], terrain.step);
}

Json json_of(const std::string& path, const detent_cook::CompoundDescription& compound) {
  Json json = {{"file", path}, {"ok", true}};
  json["kind"] = "compound";
  json["parts"] = compound.child_count;
  json["hulls"] = compound.hull_count;
  json["radius"] = compound.radius;
  json["thickness"] = compound.thickness;
  json["volume"] = compound.volume;
  json["origin"] = compound.origin;
  json["rotation"] = compound.rotation;
  return json;
}

void say(const std::string& path, const detent_cook::CompoundDescription& compound, bool json) {
  if (json) {
    print_json_line(json_of(path, compound));
    return;
  }
  printf("%s: %u parts, %u of them hulls, radius %.6g m, thinnest %.6g m, volume %.6g m^3, ", printable(path).c_str(),
         compound.child_count, compound.hull_count, compound.radius, compound.thickness, compound.volume);
  printf("centre of mass at (%.6g, %.6g, %.6g) m of the source, axes turned by (%.6g, %.6g, %.6g, %.6g)\n",
         compound.origin[0], compound.origin[1], compound.origin[2], compound.rotation[0], compound.rotation[1],
         compound.rotation[2], compound.rotation[3]);
}

}  // namespace

bool cook_compound_file(const std::string& input, const std::string& output, detent_cook::Frame frame, bool json) {
  Source source;
  if (!source.read(input, json)) return false;
  const detent_cook::CompoundRead read = detent_cook::read_compound_text(source.text);
  if (!read.problem.empty()) return fail(input, read.problem, json);
  const detent_cook::CompoundResult result = detent_cook::cook_compound(read.parts, frame);
  if (result.bytes.empty()) return fail(input, result.reason, json);
  if (const std::string problem = write_file(output, result.bytes); !problem.empty())
    return fail(output, problem, json);
  say(output, detent_cook::describe_compound(result.bytes), json);
  return true;
}

bool describe_compound_file(const std::string& path, bool json) {
  std::vector<uint8_t> bytes;
  if (const std::string problem = read_file(path, bytes); !problem.empty()) return fail(path, problem, json);
  const detent_cook::CompoundDescription compound = detent_cook::describe_compound(bytes);
  if (!compound.problem.empty()) return fail(path, compound.problem, json);
  say(path, compound, json);
  return true;
}

bool cook_mesh_file(const MeshRequest& request, bool json, const detent_cook::CookProgress& progress) {
  Source source;
  if (!source.read(request.input, json)) return false;
  const detent_cook::MeshRead read = detent_cook::read_mesh_file(request.input, source.text, progress);
  if (!read.problem.empty()) return fail(request.input, read.problem, json);
  for (const std::string& buffer : read.buffers) {
    if (is_same_file(buffer, request.output))
      return fail(request.output, "is an input file, and is not overwritten", json);
  }
  const detent_cook::MeshResult result = detent_cook::cook_mesh(read.mesh, request.options, progress);
  if (result.bytes.empty()) return fail(request.input, result.reason, json);
  if (const std::string problem = write_file(request.output, result.bytes); !problem.empty())
    return fail(request.output, problem, json);

  const detent_cook::TerrainDescription terrain = detent_cook::describe_terrain(result.bytes);
  if (json) {
    Json object = json_of(request.output, terrain);
    object["welded"] = result.welded;
    object["degenerate"] = result.degenerate;
    object["repeated"] = result.repeated;
    object["forked"] = result.forked_edges;
    object["bytes"] = result.bytes.size();
    print_json_line(object);
    return true;
  }
  print_text(request.output, terrain);
  printf("; of %zu triangles %u degenerate and %u repeated left out, %u vertices welded, %u edges forked, %zu bytes\n",
         read.mesh.triangles.size(), result.degenerate, result.repeated, result.welded, result.forked_edges,
         result.bytes.size());
  return true;
}

bool cook_height_field_file(const HeightFieldRequest& request, bool json) {
  Source source;
  if (!source.read(request.input, json)) return false;
  detent_cook::HeightsRead read = detent_cook::read_pgm(source.text, request.spacing, request.height);
  if (!read.problem.empty()) return fail(request.input, read.problem, json);
  read.field.one_sided = request.one_sided;
  const detent_cook::HeightFieldResult result = detent_cook::cook_height_field(read.field);
  if (result.bytes.empty()) return fail(request.input, result.reason, json);
  if (const std::string problem = write_file(request.output, result.bytes); !problem.empty())
    return fail(request.output, problem, json);

  const detent_cook::TerrainDescription terrain = detent_cook::describe_terrain(result.bytes);
  if (json) {
    Json object = json_of(request.output, terrain);
    object["height_step"] = result.height_step;
    object["bytes"] = result.bytes.size();
    print_json_line(object);
    return true;
  }
  print_text(request.output, terrain);
  printf("; heights in steps of %.3g m, %zu bytes\n", result.height_step, result.bytes.size());
  return true;
}

bool describe_terrain_file(const std::string& path, bool json) {
  std::vector<uint8_t> bytes;
  if (const std::string problem = read_file(path, bytes); !problem.empty()) return fail(path, problem, json);
  const detent_cook::TerrainDescription terrain = detent_cook::describe_terrain(bytes);
  if (!terrain.problem.empty()) return fail(path, terrain.problem, json);
  if (json) {
    print_json_line(json_of(path, terrain));
  } else {
    print_text(path, terrain);
    printf("\n");
  }
  return true;
}

bool cook_file(const CookRequest& request, bool json) {
  Source source;
  if (!source.read(request.input, json)) return false;
  const detent_cook::PointsRead read = detent_cook::read_points(request.input, source.text, request.index);
  if (!read.problem.empty()) return fail(request.input, read.problem, json);
  const detent_cook::CookResult result = detent_cook::cook_hull(read.points, request.options);
  if (result.bytes.empty()) return fail(request.input, result.reason, json);
  if (const std::string problem = write_file(request.output, result.bytes); !problem.empty())
    return fail(request.output, problem, json);

  const detent_cook::HullDescription hull = detent_cook::describe_hull(result.bytes);
  if (json) {
    Json object = json_of(request.output, hull);
    object["points"] = read.points.size();
    object["centre"] = result.centre;
    object["reduced"] = result.reduced;
    object["error"] = result.error;
    object["bytes"] = result.bytes.size();
    print_json_line(object);
    return true;
  }
  print_text(request.output, hull);
  if (!hull.principal) {
    printf(", centre of mass at (%.6g, %.6g, %.6g) m", result.centre[0], result.centre[1], result.centre[2]);
  }
  printf(", %s%zu points, error %.3g m, %zu bytes\n", result.reduced ? "reduced from " : "from ", read.points.size(),
         result.error, result.bytes.size());
  return true;
}

bool describe_hull_file(const std::string& path, bool json) {
  std::vector<uint8_t> bytes;
  if (const std::string problem = read_file(path, bytes); !problem.empty()) return fail(path, problem, json);
  const detent_cook::HullDescription hull = detent_cook::describe_hull(bytes);
  if (!hull.problem.empty()) return fail(path, hull.problem, json);
  if (json) {
    print_json_line(json_of(path, hull));
  } else {
    print_text(path, hull);
    printf("\n");
  }
  return true;
}

}  // namespace detent_tool
