#pragma once
#include <stdint.h>

#include <string>
#include <vector>

#include "tests/oracle/convex_distance.h"
#include "tests/queries/query.h"

/// Pairs of bodies placed as things rest and slide, and where they are in the ticks that follow. Host code of no
/// configuration.
namespace detent_manifolds {

using detent_oracle::Arrow;
using detent_oracle::Number;
using detent_oracle::solid_of;
using detent_queries::Solid;
using SolidKind = detent_queries::Kind;
using detent_queries::Triple;

/// How B lies on A.
enum class Kind : uint32_t {
  aligned,   ///< face on face, their axes alike
  turned,    ///< face on face, turned about the normal
  overhang,  ///< likewise, partly beyond A's side
  leaning,   ///< face on face, 1e-6 to 0.1 rad apart
  edge,      ///< an edge, or the side of what is round, on a face
  along,     ///< edge along edge, up to 0.1 rad apart, or round side along round side
  crossing,  ///< edge across edge
  corner,    ///< a corner, an apex or a ball on a face
  rim,       ///< the rim of a cylinder or a cone on a face
  large,     ///< face on the face of a box that is 10 to 1,000 times larger
  mesh,      ///< anything on a flat mesh of triangles
};
inline constexpr uint32_t k_kinds = 11;
const char* name_of(Kind kind);

enum class Motion : uint32_t {
  still,   ///< disturbed by the last bit
  slide,   ///< across the normal
  turn,    ///< about the normal
  rock,    ///< about an axis across the normal, by a part of the depth allowed
  carried  ///< slides on a body that moves and turns
};
inline constexpr uint32_t k_motions = 5;
const char* name_of(Motion motion);

struct Pose {
  Triple position = {};                           ///< m
  std::array<double, 4> rotation = {0, 0, 0, 1};  ///< x, y, z, w, to be normalised
};

inline constexpr uint32_t k_ticks = 16;

/// All sizes are multiples of 2^-20 m of at most 24 bits: no configuration rounds them.
struct Scene {
  uint64_t seed = 0;
  Kind kind = Kind::aligned;
  Motion motion = Motion::still;
  Solid a{}, b{};
  uint32_t mesh_cells = 0;  ///< A is a flat mesh of so many cells a side at y = 0; `a` then is a block under it
  double gap = 0;           ///< m, at the start; negative where they overlap
  double lean = 0;          ///< rad
  /// m: what is no more than this farther from B than the deepest place belongs to the patch.
  double tolerance = 0;
  std::vector<Pose> pose_a{}, pose_b{};  ///< k_ticks + 1 of each
  std::string shapes() const;            ///< e.g. "box/cylinder", in the order of the names
};

/// The pair of a seed: the same everywhere but for the last bits of libm.
Scene random_scene(uint64_t seed);
/// Without making it.
Kind kind_of(uint64_t seed);

/// The thickness of a solid, m: twice its least half extent, as the library counts.
double thickness_of(const Solid& solid);
const char* name_of(const Solid& solid);

}  // namespace detent_manifolds
