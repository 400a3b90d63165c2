#pragma once
#include <detent/toi.h>

/// @file
/// Time of impact of a vertex and a face, or of two edges, that move. It needs no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Which features meet.
enum class FeatureKind : uint32_t {
  vertex_face = 1,  ///< A's vertex, corner 0, and B's triangle, corners 1 to 3
  edge_edge = 2,    ///< A's edge, corners 0 and 1, and B's edge, corners 2 and 3
};

/// When two moving features meet.
struct FeatureToi {
  ToiOutcome outcome = ToiOutcome::undecided;  ///< whether they do
  Fraction time = 0.0;                         ///< never late: before it the features do not meet; 1 if clear
  uint32_t intervals = 0;                      ///< intervals of time looked at; at most k_feature_intervals_max
};

/// A hit is at most this part of the features' size early in gap, beside the lengths that each question names. The size
/// is the longest edge of the two features.
inline constexpr double k_feature_tolerance = 1e-6;
/// After so many intervals of time the answer is `undecided`.
inline constexpr uint32_t k_feature_intervals_max = 1024;

/// When two features first meet whose corners move in straight lines, from `start` to `end`, with constant velocities.
/// Touching is meeting. The features may be degenerate. Corners: m, in one frame, each component within 2^14.
/// Tolerance: k_feature_tolerance of the size, at the start or the end, and 2^-41 m.
/// Errors: bad_argument for another kind; out_of_range.
Status feature_toi_linear(FeatureKind kind, const Vec3<Real> (&start)[4], const Vec3<Real> (&end)[4],
                          FeatureToi& result);

/// When two features of bodies with constant velocity and constant spin first meet. Corners: m, in their bodies' axes
/// and from their positions, each component within 2^14. Touching is meeting. The features may be degenerate.
/// Tolerance: k_feature_tolerance of the size, 2^-23 of how far A's and B's corners are from their positions, together,
/// and 2^-41 m. A step of many turns may be `undecided`.
/// Errors: bad_argument for another kind; not_normalised; out_of_range, also for positions more than 2^14 m apart in a
/// component, displacements as long, and turns of more than 2^16 rad.
Status feature_toi(FeatureKind kind, const Vec3<Real> (&corner)[4], const Motion& motion_a, const Motion& motion_b,
                   FeatureToi& result);

/// Where a body is at both ends of a step.
struct PosePair {
  Pose start = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};  ///< at the beginning of the step
  Pose end = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};    ///< at its end
};

/// When two features of bodies first meet that are known at both ends of a step: in A's frame B moves in the screw that
/// leads from its first pose to its last, the shorter way round. Its way along the axis and the tangent of half its
/// angle grow evenly with time, so that the coplanarity is a cubic in time over a quadratic that has no roots. Corners:
/// m, in their bodies' axes and from their positions, each component within 2^10; so for B's position from A's.
/// Touching is meeting. The features may be degenerate. Tolerance: k_feature_tolerance of the size, 2^-21 of how far
/// B's corners are from its position and of how far the positions are apart, and 2^-39 m. Errors: bad_argument for
/// another kind; not_normalised; out_of_range, also for a turn of B in A's frame of more than 2.65 rad (the tangent of
/// half of it is at most 4).
Status feature_toi_screw(FeatureKind kind, const Vec3<Real> (&corner)[4], const PosePair& a, const PosePair& b,
                         FeatureToi& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
