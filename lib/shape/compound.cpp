#include "shape/compound.h"

#include "math/float_bits.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// |v|, rounded up. Range: |component| <= 2^30.
int64_t length_of(const Vec32& v) {
  const uint64_t square = static_cast<uint64_t>(dot(v, v));
  const uint64_t root = square_root_floor(square);
  return static_cast<int64_t>(root + (root * root < square ? 1 : 0));
}

/// value 2^-n, rounded up. Range: 0 <= n < 62.
int64_t shift_up(int64_t value, int n) { return (value + (int64_t{1} << n) - 1) >> n; }

/// The extent of the hull behind the plane of a face: the distance of the farthest vertex from the plane, in 2^-30 of
/// the hull's unit, rounded down.
int64_t depth_behind(const HullView& hull, uint32_t face) {
  const HullPlane plane = hull.plane(face);
  const Vec32 normal = {plane.normal[0], plane.normal[1], plane.normal[2]};
  int64_t least = INT64_MAX;
  for (uint32_t i = 0; i < hull.vertex_count; ++i) {
    const int64_t height = dot(normal, hull.vertex(i));
    least = height < least ? height : least;
  }
  return plane.offset - shift_up(least, 30);
}

void measure_hull(const HullView& hull, int shift, ChildMeasure& measure) {
  Vec32 low = hull.vertex(0), high = low;
  const auto take = [](int32_t value, int32_t& least, int32_t& most) {
    least = value < least ? value : least;
    most = value > most ? value : most;
  };
  for (uint32_t i = 1; i < hull.vertex_count; ++i) {
    take(hull.x(i), low.x, high.x);
    take(hull.y(i), low.y, high.y);
    take(hull.z(i), low.z, high.z);
  }
  const auto up = [shift](int32_t value) { return static_cast<int32_t>(shift_up(value, shift)); };
  measure.low = {low.x >> shift, low.y >> shift, low.z >> shift};
  measure.high = {up(high.x), up(high.y), up(high.z)};
  measure.radius += shift_up(hull.core_radius(), shift);
  int64_t depth = INT32_MAX;
  for (uint32_t face = 0; face < hull.face_count; ++face) {
    const int64_t behind = depth_behind(hull, face);
    depth = behind < depth ? behind : depth;
  }
  measure.half_thickness += depth >> (shift + 1);
}

bool is_point(const Vec32& v) {
  const auto component = [](int32_t a) { return a > -k_one && a < k_one; };
  return component(v.x) && component(v.y) && component(v.z);
}

bool header_is_good(const CompoundView& compound) {
  const uint8_t* const bytes = compound.bytes;
  if (!cooked_is_zero(bytes, k_compound_rotation_at + 16, k_compound_header_bytes)) return false;
  if (!compound.volume().is_canonical(-160, 0)) return false;
  uint64_t norm = 0;
  for (uint32_t k = 0; k < 4; ++k) {
    const int32_t component = cooked_i32(bytes + k_compound_rotation_at + 4 * k);
    if (component < -k_one || component > k_one) return false;
    norm += static_cast<uint64_t>(int64_t{component} * component);
  }
  if (norm < k_one_squared - k_unit_vector_slack || norm > k_one_squared + k_unit_vector_slack) return false;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    if (!compound.inverse_inertia(axis).is_canonical(-30, 40)) return false;
    if ((load_u64(bytes + k_compound_origin_at + 8 * axis) >> 52 & 0x7ff) == 0x7ff) return false;
  }
  return true;
}

/// Reads the hull at the offset `at`, and moves `at` to the end of a valid hull. Returns whether the hull is valid, in
/// the source frame, and has an exponent of at most `exponent`.
bool read_child_hull(const Asset& asset, uint32_t& at, int32_t exponent, HullView& hull) {
  if (asset.byte_count - at < k_hull_header_bytes) return false;
  const uint32_t bytes = cooked_u32(asset.bytes + at + k_hull_byte_count_at);
  if (bytes > asset.byte_count - at || read_hull({asset.bytes + at, bytes}, hull) != Status::ok) return false;
  at += bytes;
  return hull.frame() == HullFrame::source && hull.exponent() <= exponent;
}

/// Whether no vertex of `inner` lies above a face of `outer`.
bool is_within(const HullView& inner, const HullView& outer) {
  const int shift = outer.exponent() - inner.exponent();
  if (shift < 0) return false;
  for (uint32_t face = 0; face < outer.face_count; ++face) {
    const HullPlane plane = outer.plane(face);
    const Vec32 normal = {plane.normal[0], plane.normal[1], plane.normal[2]};
    for (uint32_t i = 0; i < inner.vertex_count; ++i) {
      if (dot(normal, inner.vertex(i)) >> shift > plane.offset * int64_t{k_one}) return false;
    }
  }
  return true;
}

/// Checks child `i` and computes its measure. Returns whether the child is valid. `at`: the offset at which the child's
/// first hull must start; the function moves `at` past the child's hulls.
bool read_child(const Asset& asset, const CompoundView& compound, uint32_t i, uint32_t& at, ChildMeasure& measure) {
  const CompoundChild child = compound.child(i);
  const uint32_t start = k_compound_header_bytes + k_compound_child_bytes * i;
  if (!cooked_is_zero(asset.bytes, start + k_child_half_thickness_at + 4, start + k_compound_child_bytes) ||
      child.radius < 0 || child.radius >= k_one || !is_point(child.low) || !is_point(child.high)) {
    return false;
  }
  HullView hull;
  if (child.kind == ChildKind::hull) {
    HullView inner;
    if (child.hull_at != at || !read_child_hull(asset, at, compound.exponent(), hull)) return false;
    if (child.inner_at != at || !read_child_hull(asset, at, compound.exponent(), inner)) return false;
    if (!is_within(inner, hull)) return false;
  } else {
    const bool is_ball = child.kind == ChildKind::ball;
    if ((!is_ball && child.kind != ChildKind::capsule) || child.radius == 0 || child.hull_at != 0 ||
        child.inner_at != 0 || (child.low == child.high) != is_ball) {
      return false;
    }
  }
  measure = measure_child(child, hull, compound.exponent());
  return measure.low == child.low && measure.high == child.high && measure.half_thickness == child.half_thickness &&
         measure.half_thickness > 0 && measure.radius < k_one;
}

}  // namespace

ChildMeasure measure_child(const CompoundChild& child, const HullView& hull, int32_t exponent) {
  ChildMeasure measure = {child.low, child.high, child.radius, child.radius};
  if (child.kind == ChildKind::hull) {
    measure_hull(hull, exponent - hull.exponent(), measure);
  } else {
    const int64_t a = length_of(child.low), b = length_of(child.high);
    measure.radius += a > b ? a : b;
  }
  return measure;
}

Status read_compound(const Asset& asset, CompoundView& compound) {
  if (const Status status = check_cooked(asset, k_compound_magic, k_compound_format_version, k_compound_header_bytes);
      status != Status::ok) {
    return status;
  }
  const CompoundView view = compound_view(asset.bytes);
  const uint32_t count = view.child_count;
  if (count < 1 || count > k_compound_children_max ||
      asset.byte_count < k_compound_header_bytes + k_compound_child_bytes * count) {
    return Status::corrupt;
  }
  if (view.exponent() < k_hull_exponent_min || view.exponent() > k_hull_exponent_max) return Status::out_of_range;
  if (!header_is_good(view)) return Status::corrupt;
  uint32_t at = k_compound_header_bytes + k_compound_child_bytes * count;
  int64_t radius = 0;
  Vec32 half = {0, 0, 0};
  int64_t thickness = INT32_MAX;
  for (uint32_t i = 0; i < count; ++i) {
    ChildMeasure measure;
    if (!read_child(asset, view, i, at, measure)) return Status::corrupt;
    radius = measure.radius > radius ? measure.radius : radius;
    thickness = measure.half_thickness < thickness ? measure.half_thickness : thickness;
    const ChildBox box = child_box(view.child(i));
    const auto most = [](int32_t low, int32_t high, int32_t before) {
      const int32_t far = -low > high ? -low : high;
      return far > before ? far : before;
    };
    half = {most(box.low.x, box.high.x, half.x), most(box.low.y, box.high.y, half.y),
            most(box.low.z, box.high.z, half.z)};
  }
  // The compound's unit is the least power of two above its radius, so the radius is at least half a unit, within
  // rounding.
  if (at != asset.byte_count || view.radius() != radius || radius < k_one / 2 - 2 || !(view.half_extents() == half) ||
      view.half_thickness() != thickness) {
    return Status::corrupt;
  }
  compound = view;
  return Status::ok;
}

Status compound_info(const Asset& asset, CompoundInfo& info) {
  CompoundView compound;
  if (const Status status = read_compound(asset, compound); status != Status::ok) return status;
  info = {};
  info.child_count = compound.child_count;
  for (uint32_t i = 0; i < compound.child_count; ++i)
    info.hull_count += compound.child(i).kind == ChildKind::hull ? 1u : 0u;
  info.exponent = compound.exponent();
  info.radius = compound.radius();
  info.half_thickness = compound.half_thickness();
  info.volume_mantissa = compound.volume().mantissa;
  info.volume_exponent = compound.volume().exponent + 3 * compound.exponent();
  read_source_frame(compound.bytes + k_compound_origin_at, compound.bytes + k_compound_rotation_at, info.origin,
                    info.rotation);
  return Status::ok;
}

Status compound_part(const Asset& asset, uint32_t index, CompoundPart& part) {
  const CompoundView compound = compound_view(asset.bytes);
  if (index >= compound.child_count) return Status::out_of_range;
  const CompoundChild child = compound.child(index);
  const auto metres = [&](int32_t steps) { return float_from_integer<double>(steps, compound.exponent() - 30); };
  CompoundPart made;
  made.type = child.kind == ChildKind::hull   ? ShapeType::hull
              : child.kind == ChildKind::ball ? ShapeType::sphere
                                              : ShapeType::capsule;
  made.radius = metres(child.radius);
  if (child.kind == ChildKind::hull) {
    const uint8_t* const bytes = asset.bytes + child.hull_at;
    made.hull = {bytes, cooked_u32(bytes + k_hull_byte_count_at)};
  } else {
    const int32_t from[3] = {child.low.x, child.low.y, child.low.z}, to[3] = {child.high.x, child.high.y, child.high.z};
    for (uint32_t k = 0; k < 3; ++k) {
      made.from[k] = metres(from[k]);
      made.to[k] = metres(to[k]);
    }
  }
  part = made;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
