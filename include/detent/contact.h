#pragma once
#include <detent/body.h>
#include <detent/distance.h>

/// @file
/// Contacts. contact_points() finds the contact points of two convex shapes at rest, and needs no world. get_contact()
/// reads the contacts of a world, which are pairs of bodies with contact points, in the state after the last step:
///
///     for (uint32_t i = next_contact(world, id, 0); i < get_info(world).contacts; i = next_contact(world, id, i + 1))
///     {
///       Contact contact;
///       if (get_contact(world, i, contact) == Status::ok) ...
///     }
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Which four contact points are kept if there are more. Stored in snapshots and recordings: a value is never reused.
enum class ManifoldReduction : uint32_t {
  /// The extreme points along four diagonals of the contact plane. The selection ignores depth, so that small changes
  /// of depth do not change the selected points. If the deepest point is deeper than all selected points by more than
  /// 2^-10 of the smaller core's bounding radius, it is added; if four points are selected already, it replaces the one
  /// nearest to it. If one point is extreme along several diagonals, further points are selected that add most to the
  /// area of the manifold.
  /// Source: the extremes of Moravanszky, Terdiman, "Fast Contact Reduction for Dynamics Simulation", 2004.
  projected_extremes = 1,
  /// The deepest point, the point farthest from it, the point that makes the largest triangle with both, and the point
  /// that adds most to the area of this triangle.
  deepest_area = 2,
};

/// The largest number of points in a manifold.
inline constexpr uint32_t k_contact_points_max = 4;

/// A contact point: a place where the two surfaces face each other along the manifold's normal.
struct ManifoldPoint {
  Vec3<Real> from_a = {};  ///< midway between the surfaces, m, from A's position, world axes
  Vec3<Real> from_b = {};  ///< the point of `from_a`, m, but from B's position, world axes
  Real separation = 0.0;   ///< m, along the normal; negative where the shapes overlap
  /// The key of the two features (vertex, edge or face) of A and of B that meet at the point. Never 0; distinct within
  /// a manifold; constant as long as the same features meet. If A and B are exchanged, its two 12-bit halves are
  /// exchanged.
  uint32_t feature = 0;
};

/// The contact of two shapes: one normal and up to four points.
struct ContactManifold {
  Vec3<Unit> normal = {};  ///< from A to B, world axes; zero if there are no points
  uint32_t count = 0;      ///< number of points, at most k_contact_points_max
  bool capped = false;     ///< an iteration cap was reached; `normal` may not be the direction of least penetration
  ManifoldPoint point[k_contact_points_max];  ///< the first `count` elements are in use
};

/// Finds the contact manifold of two convex shapes: the normal, and up to four points of the contact area. The shapes
/// are in contact if they overlap, or if their distance is at most `distance_max`, m (the search distance). If they are
/// not in contact, `manifold` has no points.
///
/// The contact axis is the direction between the closest points or, if the cores overlap, the direction of the least
/// translation that separates them. The normal is this axis, except that the normal of a face replaces it in three
/// cases. Here h is the least half extent of the thinner core:
/// - The face normal is within 2^-13 rad of the axis.
/// - The cores overlap or nearly touch, and the face normal separates them as well as the axis does, to within h / 64.
/// - The cores overlap or nearly touch at crossing edges, the face normal is within 2^-3 rad of the axis, and no point
///   on the face is deeper than the overlap along the axis by more than h / 64. Beyond the sides of the face, an edge
///   may be deeper.
///
/// Faces of a hull that are coplanar to within 1/64 of the hull's half thickness count as one face, with the normal of
/// their common outline.
///
/// The points are corners of the contact area: the intersection of the two supporting faces or edges, projected along
/// the normal. Edges are cut at the sides of a face. A vertex is a point even if it lies slightly beyond a side: by at
/// most 1/64 of the smaller of two lengths, the least distance of a side from the face's middle and the bounding radius
/// of the other core. `reduction` selects four points if there are more. A face of more than 32 vertices is represented
/// by 32 extreme vertices. The flat side of a cylinder or cone is represented by 8 points of its rim and the deepest
/// point.
///
/// Precision: as closest_points(). Errors: bad_argument for two half-spaces; not_normalised; out_of_range for NaN and
/// if `distance_max` < 0, and for a half-space in the same cases as in closest_points().
Status contact_points(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Real distance_max,
                      ContactManifold& manifold, DistanceCache* cache = nullptr,
                      ManifoldReduction reduction = ManifoldReduction::projected_extremes);

/// A contact point of two bodies.
struct ContactPoint {
  Position position = {0.0, 0.0, 0.0};  ///< midway between the surfaces, m, world
  Real separation = 0.0;                ///< m; negative where the bodies overlap
  uint32_t feature = 0;                 ///< key of the two features that meet, as in ManifoldPoint::feature
  uint32_t child_a = 0;                 ///< if A is a compound: its child at this point, counted from 1; else 0
  uint32_t child_b = 0;                 ///< if B is a compound: its child at this point, counted from 1; else 0
  Scaled normal_impulse = 0.0;          ///< N s, over the last tick
};

/// A contact of two bodies. A pair of convex bodies has one contact. A pair with a compound or a terrain (a mesh or
/// height field) has up to 16: points in one plane form one contact. The state stores only the impulses of the last
/// substep. The impulses and forces of this struct are the stored ones, scaled to the whole tick. They show the resting
/// load. They do not show impacts, which events report (event.h). The contacts of sleeping bodies keep their impulses.
struct Contact {
  BodyId a;                    ///< the body with the lower slot
  BodyId b;                    ///< the body with the higher slot
  Vec3<Unit> normal = {};      ///< from A to B, world; zero if there is no point
  uint32_t part = 0;           ///< 0 if both bodies are convex; else a key, distinct for each contact of the pair
  bool touching = false;       ///< the bodies pushed each other in the last step
  uint32_t age = 0;            ///< ticks for which the contact existed before the last tick, at most 65535
  uint32_t point_count = 0;    ///< number of points, at most 4
  ContactPoint point[4] = {};  ///< the first `point_count` elements are in use
  Vec3<Scaled> friction_impulse = {};  ///< friction impulse on B over the last tick, N s, world
  Scaled normal_impulse = 0.0;         ///< sum over all points, over the last tick, N s
  Scaled normal_force = 0.0;           ///< sum over all points, mean over the last tick, N
};

/// Reads the contact `index`, 0 to get_info(world).contacts - 1, in the order of (a.slot, b.slot, part). The function
/// computes the points for the current poses of the bodies. This costs as much as computing the contacts of the pair in
/// a step. If the bodies have moved apart since the step, there are no points. A point between features that did not
/// meet in the last step has impulse 0. Errors: out_of_range (the index).
Status get_contact(const World& world, uint32_t index, Contact& contact);
/// Returns the index of the first contact of this body at or after `index`. Returns the number of contacts if there is
/// none, or if `id` is not valid.
uint32_t next_contact(const World& world, BodyId id, uint32_t index);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
