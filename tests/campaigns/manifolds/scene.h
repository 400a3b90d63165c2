#pragma once
#include <stdint.h>

#include <string>
#include <vector>

#include "tests/common/oracle/convex_distance.h"
#include "tests/common/queries/query.h"

/// Pairs of bodies in resting and sliding configurations, and their poses in the following ticks. Host code,
/// independent of the configuration.
namespace detent_manifolds {

using detent_oracle::Arrow;
using detent_oracle::Number;
using detent_oracle::solid_of;
using detent_queries::Solid;
using SolidKind = detent_queries::Kind;
using detent_queries::Triple;

/// The contact of B with A.
enum class Kind : uint32_t {
  aligned,   ///< face on face, aligned axes
  turned,    ///< face on face, rotated about the normal
  overhang,  ///< as `turned`, partly beyond A's side
  leaning,   ///< face on face, tilted by 1e-6 to 0.1 rad
  edge,      ///< an edge, or the side of a round solid, on a face
  /// Edge along edge, at an angle of up to 0.1 rad, or round side along round side.
  along,
  crossing,  ///< edge across edge
  corner,    ///< a corner, an apex or a ball on a face
  rim,       ///< the rim of a cylinder or a cone on a face
  large,     ///< a face on the face of a box that is 10 to 1,000 times larger
  mesh,      ///< anything on a flat mesh of triangles
};
inline constexpr uint32_t k_kinds = 11;
const char* name_of(Kind kind);

enum class Motion : uint32_t {
  still,            ///< disturbed by the last bit
  slide,            ///< translation across the normal
  rotation_vector,  ///< rotation about the normal
  /// Rotation about an axis across the normal, by a fraction of the allowed depth.
  rock,
  carried  ///< sliding on a body that moves and rotates
};
inline constexpr uint32_t k_motions = 5;
const char* name_of(Motion motion);

struct Pose {
  Triple position = {};                           ///< x, y, z, w, not normalised
  std::array<double, 4> rotation = {0, 0, 0, 1};  ///< x, y, z, w, to be normalised
};

inline constexpr uint32_t k_ticks = 16;

/// All sizes are multiples of 2^-20 m of at most 24 bits, so no configuration rounds them.
struct Scene {
  uint64_t seed = 0;
  Kind kind = Kind::aligned;
  Motion motion = Motion::still;
  Solid a{}, b{};
  /// If not 0, A is a flat mesh at y = 0 with this many cells a side; `a` is then a block below it.
  uint32_t mesh_cells = 0;
  double gap = 0;   ///< m, at the start; negative where they overlap
  double lean = 0;  ///< rad
  /// Places of A at most this much farther from B than the deepest place belong to the patch, m.
  double tolerance = 0;
  std::vector<Pose> pose_a{}, pose_b{};  ///< k_ticks + 1 of each
  std::string shapes() const;            ///< e.g. "box/cylinder", in the order of the names
};

/// The pair of a seed: the same everywhere except for the last bits of libm.
Scene random_scene(uint64_t seed);
/// The kind of a seed's pair, without making the pair.
Kind kind_of(uint64_t seed);

/// The thickness of a solid, m: twice its least half extent, as in the library.
double thickness_of(const Solid& solid);
const char* name_of(const Solid& solid);

}  // namespace detent_manifolds
