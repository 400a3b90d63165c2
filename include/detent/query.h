#pragma once
#include <detent/numbers.h>
#include <detent/world.h>

/// Queries of a world: which bodies a ray or a moving shape hits, which a shape or a box overlaps, which are nearest.
///
/// Queries use the current poses of all bodies, whether they move, sleep or were created since the last step. They skip
/// sensors. The result is that of the narrow phase (toi.h, distance.h), applied to all bodies one by one. It depends on
/// the world's state alone, and is the same on every target.
///
/// Hits of casts are sorted by their fraction, hits of query_closest() by their distance. Hits with equal values are
/// sorted by slot, undecided ones after all others. If the narrow phase reaches an iteration cap, or cannot test a
/// body, the body is still reported, as an `undecided` hit. Its fraction or distance is then a lower bound: nearer than
/// this, the body is certainly not hit.
///
/// A terrain (terrain()) gives one hit: its first or nearest triangle. If several triangles are equally near, it is the
/// one with the lowest index. A one-sided terrain is not hit from behind.
///
/// Errors of all queries: out_of_range, not_normalised; for shapes also those of create_body(). After an error, the
/// outputs are unchanged.
///
/// visit_triangles() visits the triangles of a terrain, for drawing. Only programs that call it link its code.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Selects the bodies that a query tests: the category of the body shares a bit with `mask`, and the mask of the body
/// shares a bit with `category`. The groups and filter rules of the bodies have no effect.
struct QueryFilter {
  uint32_t category = 1;  ///< bit set: the categories of the query
  uint32_t mask = ~0u;    ///< bit set: the categories of bodies that the query tests
  BodyId ignore = {};     ///< a body that the query skips; null: none
};

/// A body that a query found.
struct QueryHit {
  BodyId body = {};  ///< the body
  /// If true, the body may or may not be hit: `fraction` and `distance` are lower bounds, `point` and `normal` are 0.
  bool undecided = false;
  Fraction fraction = 0.0;  ///< rays and casts: fraction of the displacement up to the hit, never too large
  Real distance = 0.0;      ///< query_closest(): the distance of the surfaces, m; 0 if the shapes overlap
  Position point = {};      ///< hit point on the body's surface, m, world; 0 from query_bounds()
  /// The body's outward normal at `point`, world; 0 if the hit is undecided, if the cores (the shapes without their
  /// rounding, distance.h) overlap, and from query_bounds().
  Vec3<Unit> normal = {};
  /// The triangle that is hit, if the body is a terrain (terrain() in shape.h); else, and from query_bounds(),
  /// UINT32_MAX.
  uint32_t triangle = UINT32_MAX;
  uint32_t material = 0;  ///< the material of that triangle, as cooked
};

/// The caller's buffer for hits. If there are more than `capacity` hits, the last ones in sort order are dropped, and
/// counted in the report.
struct QueryHits {
  QueryHit* data = nullptr;  ///< room for `capacity` hits
  uint32_t capacity = 0;     ///< the number of hits that `data` has room for
};

/// The counts of a query.
struct QueryReport {
  uint32_t hits = 0;       ///< number of hits written
  uint32_t dropped = 0;    ///< number of hits beyond QueryHits::capacity
  uint32_t undecided = 0;  ///< number of undecided hits, written or dropped
  uint64_t digest = 0;     ///< a hash of all hits, written or dropped
};

/// A ray: the straight segment from `origin` to `origin + displacement`.
struct RayQuery {
  Position origin = {0.0, 0.0, 0.0};          ///< m, world
  Vec3<Real> displacement = {0.0, 0.0, 0.0};  ///< m, world; each component within 2^14
  QueryFilter filter = {};                    ///< the bodies that the query tests
  bool all = false;                           ///< true: find every body that the ray hits; false: only the first
};

/// A shape that moves at constant velocity and rotates at constant angular velocity. `shape`: any shape of a body
/// except half-space, terrain and compound; or a point, which is a sphere of radius 0.
struct CastQuery {
  Shape shape = {};                              ///< a shape of a body, or a point
  Position position = {0.0, 0.0, 0.0};           ///< position at the start, m, world
  Quat rotation = {0.0, 0.0, 0.0, 1.0};          ///< rotation at the start, local to world
  Vec3<Real> displacement = {0.0, 0.0, 0.0};     ///< m, world; each component within 2^14
  Vec3<Real> rotation_vector = {0.0, 0.0, 0.0};  ///< rotation of the whole cast, world axes, rad; length at most 2^16
  QueryFilter filter = {};                       ///< the bodies that the query tests
  bool all = false;                              ///< true: find every body that the shape hits; false: only the first
};

/// A shape at rest. The shapes are those that a CastQuery permits.
struct OverlapQuery {
  Shape shape = {};                      ///< a shape of a body, or a point
  Position position = {0.0, 0.0, 0.0};   ///< m, world
  Quat rotation = {0.0, 0.0, 0.0, 1.0};  ///< local to world
  QueryFilter filter = {};               ///< the bodies that the query tests
  bool all = false;                      ///< true: find every body that overlaps; false: only the first
};

/// An axis-aligned box, which is tested only against the axis-aligned bounds of the bodies. This is a cheap query. A
/// half-space overlaps every box.
struct BoundsQuery {
  Position lower = {0.0, 0.0, 0.0};  ///< m, world
  Position upper = {0.0, 0.0, 0.0};  ///< m, world; no component is less than that of `lower`
  QueryFilter filter = {};           ///< the bodies that the query tests
  bool all = false;                  ///< true: find every body that overlaps; false: only the first
};

/// A shape at rest and a search distance around it. The shapes are those that a CastQuery permits.
struct ClosestQuery {
  Shape shape = {};                      ///< a shape of a body, or a point
  Position position = {0.0, 0.0, 0.0};   ///< m, world
  Quat rotation = {0.0, 0.0, 0.0, 1.0};  ///< local to world
  Real distance_max = 16.0;              ///< search distance between the surfaces, m, [0, 2^14]
  QueryFilter filter = {};               ///< the bodies that the query tests
  bool all = false;                      ///< true: find every body within `distance_max`; false: only the nearest
};

/// Finds the bodies that the ray hits. A body that contains the origin is hit at fraction 0. No ray passes between two
/// adjacent triangles of a terrain: hits on a terrain are exact to the resolution of its coordinates (docs/mesh.md).
/// The hit is undecided if the ray begins 2^15 m or more from the terrain's origin.
Status query_ray(const World& world, const RayQuery& query, QueryHits hits, QueryReport& report);
/// Finds the bodies that the moving shape hits. Tolerance: as time_of_impact().
Status query_cast(const World& world, const CastQuery& query, QueryHits hits, QueryReport& report);
/// Finds the bodies that the shape overlaps or touches, in slot order. A body at distance 0 overlaps. Precision: as
/// closest_points().
Status query_overlap(const World& world, const OverlapQuery& query, QueryHits hits, QueryReport& report);
/// Finds the bodies whose bounds overlap the box, in slot order. Precision: the error of a body's bounds is at most
/// 2^-28 u plus half the resolution of a position. Here u is the least power of two, m, above the body's bounding
/// radius.
Status query_bounds(const World& world, const BoundsQuery& query, QueryHits hits, QueryReport& report);
/// Finds the bodies that are nearest to the shape, within the search distance. Precision: as closest_points().
Status query_closest(const World& world, const ClosestQuery& query, QueryHits hits, QueryReport& report);

/// The answer to one query of a batch.
struct QueryAnswer {
  /// The status that a single call of the query returns. After an error, the report and the hits are unchanged.
  Status status = Status::ok;
  QueryReport report = {};  ///< the report of a single call of the query
};

/// Answers `count` queries of one kind. The status, the report and the hits of each query are bit for bit those of a
/// single call such as query_ray(). The queries run on the threads of WorldHooks::tasks, or on the calling thread if
/// there are none or if `count` is small (Tasks::least).
///
/// `hits`: room for `hits_each` hits of each query; those of query i begin at hits[i * hits_each]. If a query has more
/// hits, the last ones in sort order are dropped, and counted in its report. `hits` may be null if `hits_each` is 0.
/// `answers`: room for one answer of each query. The three arrays must not overlap.
///
/// An invalid query does not affect the others. Returns the status of the first query that is not ok, if there is one.
/// @{
Status query_batch(const World& world, const RayQuery* queries, uint32_t count, QueryHit* hits, uint32_t hits_each,
                   QueryAnswer* answers);
Status query_batch(const World& world, const CastQuery* queries, uint32_t count, QueryHit* hits, uint32_t hits_each,
                   QueryAnswer* answers);
Status query_batch(const World& world, const OverlapQuery* queries, uint32_t count, QueryHit* hits, uint32_t hits_each,
                   QueryAnswer* answers);
Status query_batch(const World& world, const BoundsQuery* queries, uint32_t count, QueryHit* hits, uint32_t hits_each,
                   QueryAnswer* answers);
Status query_batch(const World& world, const ClosestQuery* queries, uint32_t count, QueryHit* hits, uint32_t hits_each,
                   QueryAnswer* answers);
/// @}

/// A triangle of a body, at the body's current pose.
struct BodyTriangle {
  uint32_t index = 0;       ///< index of the triangle, as in QueryHit::triangle
  uint32_t material = 0;    ///< material of the triangle, as cooked
  Position corner[3] = {};  ///< corners, counter-clockwise as seen from the front, m, world
};

/// Calls visit(user, triangle) for each triangle of the body, always in the same order. Rounding: to the resolution of
/// a position. Errors: bad_id, bad_argument (the body's shape is no terrain), asset_missing.
Status visit_triangles(const World& world, BodyId id, void* user,
                       void (*visit)(void* user, const BodyTriangle& triangle));

}  // namespace DETENT_NAMESPACE
}  // namespace detent
