#pragma once
#include <detent/fraction.h>
#include <detent/world.h>

/// Questions to a world: what a ray or a moving shape hits, what a shape or a box overlaps, what is nearest.
///
/// The bodies are where their poses are now, whether they move, sleep or were made since the last step. Each is asked
/// by the narrow phase (toi.h, distance.h), and the answer is that of asking them all one by one: it depends on the
/// world's state alone, and is the same on every target.
///
/// Hits are in the order of their fraction (a cast) or distance, of equals those that are decided first, then of the
/// lower slot. Where the narrow phase meets a cap, or cannot be asked, the body is a hit all the same, marked
/// `undecided`: at the time or distance up to which it is certainly clear.
///
/// A surface() is one hit: the first or nearest of its triangles, of equals the one of the lower index. What comes from
/// behind a one-sided one meets nothing.
///
/// Errors of all: out_of_range, not_normalised; for shapes as create_body(). Outputs are then untouched.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Which bodies are asked: those whose category has a bit in `mask`, and whose mask has one of `category`. Groups and
/// rules have no part in it.
struct QueryFilter {
  uint32_t category = 1;  ///< bits: what the question is
  uint32_t mask = ~0u;    ///< bits: the categories that it asks
  BodyId ignore = {};     ///< but for this one; null: none
};

/// A body that a query found.
struct QueryHit {
  BodyId body = {};        ///< which
  bool undecided = false;  ///< what follows is a bound: there may be no hit, but none is sooner; point and normal are 0
  Fraction fraction = 0.0;  ///< of a cast: the part of the way until the hit, never late
  Real distance = 0.0;      ///< of query_closest(): between the surfaces, m; 0 where they overlap
  Position point = {};      ///< on the body's surface, m, world; 0 from query_bounds()
  Vec3<Unit> normal = {};   ///< of the body there, outward, world; 0 where the cores overlap, and from query_bounds()
  uint32_t triangle =
      UINT32_MAX;         ///< of a surface() (shape.h): which is met; else, and from query_bounds(), UINT32_MAX
  uint32_t material = 0;  ///< that triangle's, as it was cooked
};

/// Where hits go: the caller's memory. Those beyond it are dropped after all have been sorted, and counted.
struct QueryHits {
  QueryHit* data = nullptr;  ///< the first place
  uint32_t capacity = 0;     ///< places
};

/// What a query found, in numbers.
struct QueryReport {
  uint32_t hits = 0;       ///< written
  uint32_t dropped = 0;    ///< for want of room
  uint32_t undecided = 0;  ///< of both
  uint64_t digest = 0;     ///< of all hits, those dropped as well
};

/// A straight line. At most as far as a cast.
struct RayQuery {
  Position origin = {0.0, 0.0, 0.0};  ///< m, world
  Vec3<Real> way = {0.0, 0.0, 0.0};   ///< m, world; each component within 2^14
  QueryFilter filter = {};            ///< whom it asks
  bool all = false;                   ///< every body that it meets, and not only the first
};

/// A shape on its way, which turns at a constant rate about a constant axis. `shape`: as of a body, or a sphere of
/// radius 0, which is a point; not a half-space, surface or compound.
struct CastQuery {
  Shape shape = {};                      ///< as of a body, or a point
  Position position = {0.0, 0.0, 0.0};   ///< at the start, m, world
  Quat rotation = {0.0, 0.0, 0.0, 1.0};  ///< at the start, local to world
  Vec3<Real> way = {0.0, 0.0, 0.0};      ///< m, world; each component within 2^14
  Vec3<Real> turn = {0.0, 0.0, 0.0};     ///< rotation vector, world, rad; |turn| <= 2^16
  QueryFilter filter = {};               ///< whom it asks
  bool all = false;                      ///< every body found, and not only the first
};

/// A shape at rest, as CastQuery has it.
struct OverlapQuery {
  Shape shape = {};                      ///< as of a body, or a point
  Position position = {0.0, 0.0, 0.0};   ///< m, world
  Quat rotation = {0.0, 0.0, 0.0, 1.0};  ///< local to world
  QueryFilter filter = {};               ///< whom it asks
  bool all = false;                      ///< every body found, and not only the first
};

/// A box along the axes, which need only overlap that of a body. Cheap. A half-space is everywhere.
struct BoundsQuery {
  Position lower = {0.0, 0.0, 0.0};  ///< m, world
  Position upper = {0.0, 0.0, 0.0};  ///< m, world; not below `lower`
  QueryFilter filter = {};           ///< whom it asks
  bool all = false;                  ///< every body found, and not only the first
};

/// A shape at rest, as CastQuery has it, and how far around it is looked.
struct ClosestQuery {
  Shape shape = {};                      ///< as of a body, or a point
  Position position = {0.0, 0.0, 0.0};   ///< m, world
  Quat rotation = {0.0, 0.0, 0.0, 1.0};  ///< local to world
  Real reach = 16.0;                     ///< between the surfaces, m, [0, 2^14]
  QueryFilter filter = {};               ///< whom it asks
  bool all = false;                      ///< every body found, and not only the first
};

/// What the ray hits. A body that holds the origin is hit at fraction 0. No ray passes between the triangles of a
/// surface(): its hits err by a step of its grid (docs/mesh.md), and one that begins 2^15 m from its origin is
/// undecided.
Status query_ray(const World& world, const RayQuery& query, QueryHits hits, QueryReport& report);
/// What the moving shape meets. Tolerance: as time_of_impact().
Status query_cast(const World& world, const CastQuery& query, QueryHits hits, QueryReport& report);
/// What the shape overlaps or touches, in the order of the slots. Precision: as closest_points(), of which it is the
/// distance 0.
Status query_overlap(const World& world, const OverlapQuery& query, QueryHits hits, QueryReport& report);
/// Whose bounds overlap the box, in the order of the slots. Precision: of a body's bounds 2^-28 of its size, and half a
/// step of a coordinate.
Status query_bounds(const World& world, const BoundsQuery& query, QueryHits hits, QueryReport& report);
/// What is nearest to the shape within reach. Precision: as closest_points().
Status query_closest(const World& world, const ClosestQuery& query, QueryHits hits, QueryReport& report);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
