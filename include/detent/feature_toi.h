#pragma once
#include <detent/toi.h>

/// @file
/// Time of impact of a moving vertex and a moving face, or of two moving edges. No world is needed.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The kinds of the two features, and the order of their corners in the arrays `corner`, `start` and `end` of the
/// functions below.
enum class FeatureKind : uint32_t {
  vertex_face = 1,  ///< A's vertex, corner 0, and B's triangle, corners 1 to 3
  edge_edge = 2,    ///< A's edge, corners 0 and 1, and B's edge, corners 2 and 3
};

/// The time of impact of two moving features.
struct FeatureToi {
  ToiOutcome outcome = ToiOutcome::undecided;  ///< whether the features meet
  Fraction time = 0.0;                         ///< fraction of the step; before it the features do not meet; 1 if clear
  uint32_t intervals = 0;                      ///< number of intervals searched, at most k_feature_intervals_max
};

/// The largest gap at the time of a hit, as a fraction of the features' size, which is their longest edge. The
/// tolerance of each function is this gap plus the other lengths that its "Tolerance" lists.
inline constexpr double k_feature_tolerance = 1e-6;
/// The largest number of time intervals that are searched. If that is not enough, the outcome is `undecided`.
inline constexpr uint32_t k_feature_intervals_max = 1024;

/// Finds when two features first meet if their corners move in straight lines, from `start` to `end`, at constant
/// velocity. Touching counts as meeting. The features may be degenerate.
/// Corners: m, in one common frame; each component within 2^14.
/// Tolerance: k_feature_tolerance times the features' longest edge, at the start or at the end, plus 2^-41 m.
/// Errors: bad_argument for another kind; out_of_range.
Status feature_toi_linear(FeatureKind kind, const Vec3<Real> (&start)[4], const Vec3<Real> (&end)[4],
                          FeatureToi& result);

/// Finds when two features first meet if each is fixed to a body with constant velocity and constant angular velocity.
/// Touching counts as meeting. The features may be degenerate. The outcome may be `undecided` if a body makes many
/// revolutions in the step.
/// Corners: m, in the axes of their body and relative to its position; each component within 2^14.
/// Tolerance: the sum of three lengths: k_feature_tolerance times the features' longest edge; 2^-23 times (the largest
/// distance of A's corners from A's position + the largest distance of B's corners from B's position); 2^-41 m.
/// Errors: bad_argument for another kind; not_normalised; out_of_range. It is also out_of_range if a component of the
/// displacements, or of the initial offset between the positions, is more than 2^14 m, or a rotation is more than
/// 2^16 rad.
Status feature_toi(FeatureKind kind, const Vec3<Real> (&corner)[4], const Motion& motion_a, const Motion& motion_b,
                   FeatureToi& result);

/// The poses of a body at the beginning and at the end of a step.
struct PosePair {
  Pose start = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};  ///< pose at the beginning of the step
  Pose end = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};    ///< pose at the end of the step
};

/// Finds when two features first meet if the poses of their bodies are given at the beginning and at the end of a step.
/// In A's frame, B moves on a screw motion from its start pose to its end pose, with the smaller of the two possible
/// rotations. The translation along the screw axis and the tangent of half the rotation angle are linear in time.
/// Therefore the coplanarity of the features is a cubic polynomial in time divided by a quadratic that has no real
/// roots.
/// Touching counts as meeting. The features may be degenerate.
/// Corners: m, in the axes of their body and relative to its position; each component within 2^10. B's position
/// relative to A's: each component within 2^10 m.
/// Tolerance: the sum of three lengths: k_feature_tolerance times the features' longest edge; 2^-21 times (the largest
/// distance of B's corners from B's position + the distance between A's and B's positions); 2^-39 m. Errors:
/// bad_argument for another kind; not_normalised; out_of_range, also if B rotates in A's frame by more than 2.65 rad
/// (the tangent of half the angle is at most 4).
Status feature_toi_screw(FeatureKind kind, const Vec3<Real> (&corner)[4], const PosePair& a, const PosePair& b,
                         FeatureToi& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
