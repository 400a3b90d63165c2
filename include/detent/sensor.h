#pragma once
#include <detent/world.h>

/// @file
/// Sensors: bodies that do not push other bodies, and report the bodies within them (BodyDef::sensor).
///
/// A fixed or kinematic sensor detects the dynamic and kinematic bodies that its filter allows; a dynamic sensor also
/// detects fixed bodies. A sensor does not detect other sensors, nor a body to which a joint with `collide` false
/// connects it. A sensor moves like any body of its type; it belongs to no island, wakes no body and keeps no body
/// awake.
///
/// A body is *within* a sensor if, at the end of a step, the body and the sensor overlap or their distance is at most
/// 2^-14 of the pair's smaller extent (WorldDef). A body that is not within the sensor then may have passed through it
/// during the step; this is tested by the time of impact, even if WorldDef::continuous is false. Therefore a body that
/// passes through a sensor in one step causes an enter and a leave event at any speed. If a test is undecided, the body
/// counts as within the sensor, or as passing through it; StepReport::lost.sensed_undecided counts these bodies.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Lists the bodies within a sensor after the last step, in slot order. Writes the first `capacity` ids to `bodies`, or
/// none if `bodies` is null. Sets `count` to the number of all bodies within the sensor. Errors: bad_id, bad_argument
/// (not a sensor).
Status get_sensed(const World& world, BodyId sensor, BodyId* bodies, uint32_t capacity, uint32_t& count);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
