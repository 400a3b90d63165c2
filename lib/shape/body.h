#pragma once
#include <detent/body.h>
#include <detent/detail/state.h>
#include <detent/filter.h>

/// Queries of body properties.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline BodyType type_of(const BodyTraits& traits) { return static_cast<BodyType>(traits.type); }
inline bool is_dynamic(const BodyTraits& traits) { return type_of(traits) == BodyType::dynamic; }
inline bool is_sensor(const BodyTraits& traits) { return traits.sensor != 0; }

inline ShapeType shape_of(const BodyTraits& traits) { return static_cast<ShapeType>(traits.shape); }
inline bool is_half_space(const BodyTraits& traits) { return shape_of(traits) == ShapeType::half_space; }
inline bool is_surface(const BodyTraits& traits) { return shape_of(traits) == ShapeType::surface; }
inline bool is_compound(const BodyTraits& traits) { return shape_of(traits) == ShapeType::compound; }
/// Whether a pair of bodies can have more than one contact.
inline bool has_parts(const BodyTraits& a, const BodyTraits& b) {
  return is_surface(a) || is_surface(b) || is_compound(a) || is_compound(b);
}
/// Whether a body has no thickness to which the motion of other bodies can be compared.
inline bool is_ground(const BodyTraits& traits) { return is_half_space(traits) || is_surface(traits); }

inline Filter filter_of(const BodyTraits& traits) { return {traits.category, traits.mask, traits.group, traits.rule}; }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
