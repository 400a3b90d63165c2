#pragma once
#include <detent/asset.h>

#include "math/vector_integer.h"
#include "shape/hull.h"

/// Offsets and readers of a cooked compound in flash or in a file; docs/compound.md describes the format.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint8_t k_compound_magic[8] = {0x89, 'D', 'T', 'C', '\r', '\n', 0x1a, '\n'};
inline constexpr uint32_t k_compound_format_version = 1;
inline constexpr uint32_t k_compound_children_max = 64;

/// Byte offsets of the header's fields.
inline constexpr uint32_t k_compound_exponent_at = 20;
inline constexpr uint32_t k_compound_radius_at = 24;
inline constexpr uint32_t k_compound_child_count_at = 28;
inline constexpr uint32_t k_compound_half_extents_at = 32;  ///< x, y, z
inline constexpr uint32_t k_compound_half_thickness_at = 44;
inline constexpr uint32_t k_compound_volume_at = 48;           ///< mantissa, exponent
inline constexpr uint32_t k_compound_inverse_inertia_at = 56;  ///< mantissa, exponent; for each of the three axes
inline constexpr uint32_t k_compound_origin_at = 80;           ///< three doubles
inline constexpr uint32_t k_compound_rotation_at = 104;
inline constexpr uint32_t k_compound_header_bytes = 128;  ///< zero from 120 on; the children follow

/// Byte offsets of a child's fields from the child's start.
inline constexpr uint32_t k_child_kind_at = 0;
inline constexpr uint32_t k_child_radius_at = 4;
inline constexpr uint32_t k_child_hull_at = 8;
inline constexpr uint32_t k_child_inner_at = 12;
inline constexpr uint32_t k_child_low_at = 16;
inline constexpr uint32_t k_child_high_at = 28;
inline constexpr uint32_t k_child_half_thickness_at = 40;
inline constexpr uint32_t k_compound_child_bytes = 48;  ///< zero from 44 on

/// Values are stored in files and never reused.
enum class ChildKind : uint32_t {
  ball = 1,     ///< the centre is `low`; `high` is equal to `low`
  capsule = 2,  ///< `low` and `high` are the ends, in any order
  hull = 3,     ///< a cooked hull in the compound's axes
};

/// One convex part of a compound. Lengths are in 2^-30 of the compound's unit.
struct CompoundChild {
  ChildKind kind;
  int32_t radius;     ///< rounding radius
  uint32_t hull_at;   ///< of a hull: offset of its bytes from the compound's start; else 0
  uint32_t inner_at;  ///< of a hull: offset of its inner hull, which is tested against bodies that penetrate deeply
  Vec32 low, high;    ///< see ChildKind; of a hull: the least and the greatest coordinates of its vertices
  int32_t half_thickness;  ///< equal to `radius`; of a hull: `radius` + half its least extent along a face normal
};

/// An axis-aligned box, in 2^-30 of the compound's unit; both ends are included.
struct ChildBox {
  Vec32 low, high;
};

/// A view of a cooked compound; it copies nothing. The origin of the compound's frame is its centre of mass, and the
/// axes are its principal axes of inertia.
struct CompoundView {
  const uint8_t* bytes = nullptr;
  uint32_t child_count = 0;

  int32_t exponent() const { return cooked_i32(bytes + k_compound_exponent_at); }
  /// Greatest distance of the surface from the origin, rounded up.
  int32_t radius() const { return cooked_i32(bytes + k_compound_radius_at); }
  int32_t half_thickness() const { return cooked_i32(bytes + k_compound_half_thickness_at); }
  /// The greatest |x|, |y| and |z| of the surface.
  Vec32 half_extents() const { return vector(bytes + k_compound_half_extents_at); }
  /// The volume (mass over density), in unit^3.
  HullScaled volume() const { return scaled(k_compound_volume_at); }
  /// Inverse inertia (per unit mass), m unit^2 / I, about the body axis `axis` (0 to 2).
  HullScaled inverse_inertia(uint32_t axis) const { return scaled(k_compound_inverse_inertia_at + 8 * axis); }
  CompoundChild child(uint32_t i) const {
    DETENT_VERIFY_RANGE(i < child_count);
    const uint8_t* words = bytes + k_compound_header_bytes + k_compound_child_bytes * i;
    return {static_cast<ChildKind>(cooked_u32(words + k_child_kind_at)),
            cooked_i32(words + k_child_radius_at),
            cooked_u32(words + k_child_hull_at),
            cooked_u32(words + k_child_inner_at),
            vector(words + k_child_low_at),
            vector(words + k_child_high_at),
            cooked_i32(words + k_child_half_thickness_at)};
  }

 private:
  static Vec32 vector(const uint8_t* words) {
    return {cooked_i32(words), cooked_i32(words + 4), cooked_i32(words + 8)};
  }
  HullScaled scaled(uint32_t field) const { return {cooked_i32(bytes + field), cooked_i32(bytes + field + 4)}; }
};

/// The compound at `bytes`. read_compound() must have accepted them; this function checks nothing.
inline CompoundView compound_view(const uint8_t* bytes) {
  return {bytes, cooked_u32(bytes + k_compound_child_count_at)};
}

/// The child's bounds, including its rounding radius. Range: the components of the result are below 2^31 in magnitude.
inline ChildBox child_box(const CompoundChild& child) {
  const Vec32 &a = child.low, &b = child.high;
  const int32_t r = child.radius;
  const auto least = [r](int32_t p, int32_t q) { return (p < q ? p : q) - r; };
  const auto most = [r](int32_t p, int32_t q) { return (p > q ? p : q) + r; };
  return {{least(a.x, b.x), least(a.y, b.y), least(a.z, b.z)}, {most(a.x, b.x), most(a.y, b.y), most(a.z, b.z)}};
}

/// The measures of a child, in 2^-30 of the compound's unit. The values in the header and in the child follow from
/// them. `detent cook` writes these values; read_compound() computes them again and compares.
struct ChildMeasure {
  Vec32 low, high;
  int64_t radius;  ///< greatest distance of the child's surface from the origin, rounded up
  int64_t half_thickness;
};
/// Measures a child. `exponent`: the compound's exponent. `hull`: the child's hull, or an empty view.
ChildMeasure measure_child(const CompoundChild& child, const HullView& hull, int32_t exponent);

/// Checks untrusted bytes. The children of an accepted compound are balls, capsules and hulls that read_hull() accepts.
/// They lie within the bounds that the file states, and each inner hull lies within its hull. Volume, inverse inertia,
/// origin and rotation are checked only for their ranges. Errors: as compound_info().
Status read_compound(const Asset& asset, CompoundView& compound);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
