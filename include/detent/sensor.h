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
/// A body is *within* a sensor if, at the end of a step, the distance of their surfaces is at most 2^-14 of the lesser
/// of their smallest diameters. During the step, bodies are tested by their time of impact, also if the world is not
/// continuous: a body that passes through a sensor in one step enters and leaves it, however fast it is. An undecided
/// test counts as within, or as passing through, and is counted in StepReport::lost.sensed_undecided.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The bodies within a sensor after the last step, in slot order. Writes the first `capacity` of them to `bodies`,
/// or none if `bodies` is null; `count` is the number of all. Errors: bad_id, bad_argument (not a sensor).
Status get_sensed(const World& world, BodyId sensor, BodyId* bodies, uint32_t capacity, uint32_t& count);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
