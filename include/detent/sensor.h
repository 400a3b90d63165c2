#pragma once
#include <detent/world.h>

/// @file
/// Sensors: bodies that push nothing and tell who is within them (BodyDef::sensor).
///
/// A fixed or kinematic sensor senses the dynamic and kinematic bodies that its filter lets through, a dynamic one the
/// fixed bodies too; no sensor senses another, nor what it is joined to unless they collide. A sensor moves as any body
/// of its type does, joins no islands, wakes nobody and keeps nobody awake.
///
/// *Within* is whose surface is no farther from the sensor's than 2^-14 of the smaller one's smallest diameter at the
/// end of a step. On their way in the step bodies are asked for by their time of impact, also in a world that is not
/// continuous: who is through a sensor within a step has entered and left it, however fast, and never goes unnoticed.
/// What cannot be decided counts as within, or through, and is counted in StepReport::sensed_undecided.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Who is within a sensor after the last step, in the order of their slots: the first `capacity` of them in `bodies`,
/// which may be null for none; `count` is how many there are. Errors: bad_id, bad_argument (not a sensor).
Status get_sensed(const World& world, BodyId sensor, BodyId* bodies, uint32_t capacity, uint32_t& count);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
