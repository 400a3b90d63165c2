#pragma once
#include <detent/math.h>

/// @file
/// Poses for rendering. These read poses and never touch a world, and they are as deterministic as the rest.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A pose relative to a camera, in world axes.
struct CameraRelative {
  float position[3];  ///< m; x, y, z from the camera to the body's centre of mass
  float rotation[4];  ///< x, y, z, w; from local to world
};

/// Rounding: the exact difference of the positions, then to the nearest float: as precise at 10,000 km as at the
/// origin.
CameraRelative relative_to_camera(const Pose& pose, const Position& camera);

/// The pose between two ticks. Range: alpha in [0, 1]; coordinates less than 2^31 m apart.
/// The position is on the straight line; the rotation is the normalised mean along the shorter arc. 0 gives `from` and
/// 1 gives `to` (its rotation perhaps as -q, and renormalised).
Pose interpolate(const Pose& from, const Pose& to, Unit alpha);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
