#pragma once
#include <detent/math.h>

/// @file
/// Poses for rendering. These functions need no world, and are deterministic like the rest of the library.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A pose relative to a camera, in world axes.
struct CameraRelative {
  float position[3];  ///< m; x, y, z from the camera to the body's centre of mass
  float rotation[4];  ///< x, y, z, w; from local to world
};

/// The pose relative to a camera. Rounding: the exact difference of the positions is rounded to the nearest float, so
/// it is as precise at 10,000 km as at the origin.
CameraRelative relative_to_camera(const Pose& pose, const Position& camera);

/// Interpolates between the poses of two ticks. Range: alpha in [0, 1]; coordinates less than 2^31 m apart.
/// The position is interpolated linearly; the rotation by a normalised weighted mean along the shorter arc. Alpha 0
/// gives `from`, and 1 gives `to` (its rotation is renormalised, and may be -q).
Pose interpolate(const Pose& from, const Pose& to, Unit alpha);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
