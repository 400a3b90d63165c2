#pragma once
#include <detent/body.h>
#include <detent/detail/state.h>

/// Functions that read the properties of a body.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline BodyType type_of(const BodyProperties& properties) { return static_cast<BodyType>(properties.type); }
inline bool is_kinematic(const BodyProperties& properties) { return type_of(properties) == BodyType::kinematic; }
inline bool is_dynamic(const BodyProperties& properties) { return type_of(properties) == BodyType::dynamic; }
inline bool is_sensor(const BodyProperties& properties) { return properties.sensor != 0; }

inline ShapeType shape_of(const BodyProperties& properties) { return static_cast<ShapeType>(properties.shape); }
inline bool is_half_space(const BodyProperties& properties) { return shape_of(properties) == ShapeType::half_space; }
inline bool is_terrain(const BodyProperties& properties) { return shape_of(properties) == ShapeType::terrain; }
inline bool is_compound(const BodyProperties& properties) { return shape_of(properties) == ShapeType::compound; }
/// Whether a pair of bodies can have more than one contact.
inline bool has_parts(const BodyProperties& a, const BodyProperties& b) {
  return is_terrain(a) || is_terrain(b) || is_compound(a) || is_compound(b);
}
/// Whether a body is a half-space or terrain. Such a body has no thickness with which the motion of another body could
/// be compared.
inline bool is_ground(const BodyProperties& properties) { return is_half_space(properties) || is_terrain(properties); }

inline Filter filter_of(const BodyProperties& properties) {
  return {properties.category, properties.mask, properties.group, properties.rule};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
