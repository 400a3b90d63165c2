#include "contact/contact_axis.h"

#include "distance/penetration.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int32_t k_push = 256;  ///< ulps; two cores that overlap by this much have a reliable axis

constexpr int64_t k_rounded = 1024;  ///< ulps; more than the errors of gjk() and of the support points

ContactAxis axis_of(const Penetration& found) {
  return {found.normal, -int64_t{found.depth}, found.point_a, found.point_b, found.capped};
}

/// Finds the contact axis of two cores whose gjk() search was capped. `distance`: an upper bound of their distance,
/// ulps. The function moves B by `distance` + k_push in the direction opposite to `normal`, and finds the direction of
/// least penetration there. Returns false, with `axis` unchanged, if the cores do not overlap even then.
bool axis_by_pushing(const RestingPair& pair, const Vec32& normal, int32_t distance, ContactAxis& axis) {
  const int64_t push = int64_t{distance} + k_push;
  const Vec32 offset = subtract(pair.offset, scaled_vector(normal, push));
  Simplex simplex;
  if (gjk(pair.a, pair.b, offset, simplex, {}).outcome != GjkOutcome::overlap) return false;
  axis = axis_of(penetration(pair.a, pair.b, offset, simplex));
  axis.separation += (push * (dot(normal, axis.normal) >> 30)) >> 30;
  return true;
}

/// A copy of a placed core. If the core is a cylinder, the copy is smaller: 1/8 of the lesser of radius and half length
/// is subtracted from both. Other cores are copied unchanged.
class SmallerCore {
 public:
  explicit SmallerCore(const Placed& core) : convex_(*core.convex), placed_(core) {
    placed_.convex = &convex_;
    if (convex_.type != ShapeType::cylinder) return;
    int32_t(&size)[3] = convex_.size;
    const int32_t less = (size[0] < size[1] ? size[0] : size[1]) >> 3;
    size[0] -= less;
    size[1] -= less;
    less_ = placed_.shift > 31 ? 0 : less >> placed_.shift;
  }
  SmallerCore(const SmallerCore&) = delete;
  SmallerCore& operator=(const SmallerCore&) = delete;

  const Placed& placed() const { return placed_; }
  int32_t less() const { return less_; }  ///< the length subtracted, in ulps (2^-30 of the pair's unit)

 private:
  Convex convex_;
  Placed placed_;
  int32_t less_ = 0;
};

/// Finds the axis of two cores that overlap, without penetration(), which needs many iterations for curved surfaces.
/// Makes the cylinders smaller (SmallerCore) and takes the direction between the nearest points of the smaller cores.
/// Returns false, with `axis` unchanged, in these cases: neither core is a cylinder; a core is a half-space; the
/// overlap is so deep that the smaller cores are not apart; a rim touches, so that the overlap of the whole cores along
/// this direction is larger than the least overlap.
bool axis_of_smaller_cylinders(const RestingPair& pair, ContactAxis& axis) {
  const auto is_cylinder = [](const Placed& core) { return core.convex->type == ShapeType::cylinder; };
  if (pair.planar() || !(is_cylinder(pair.a) || is_cylinder(pair.b))) return false;
  const SmallerCore a(pair.a), b(pair.b);
  Simplex simplex;
  const GjkResult found = gjk(a.placed(), b.placed(), pair.offset, simplex, {});
  if (found.outcome != GjkOutcome::apart) return false;
  const Vec32& normal = found.normal;
  const Vec32 from = support(pair.a, normal).point, to = support(pair.b, negate(normal)).point;
  const int64_t separation = dot(normal, subtract(add(pair.offset, to), from)) >> 30;
  if (separation < found.lower - a.less() - b.less() - k_rounded) return false;
  const NearestPoints nearest = nearest_points(a.placed(), b.placed(), simplex);
  axis = {normal, separation, add(nearest.on_a, scaled_vector(normal, a.less())),
          subtract(nearest.on_b, scaled_vector(normal, b.less())), false};
  return true;
}

}  // namespace

bool find_contact_axis(const RestingPair& pair, int32_t above, DistanceCache* cache, ContactAxis& axis) {
  Simplex simplex;
  if (cache != nullptr) load_cache(*cache, pair, simplex);
  const GjkResult found = gjk_on(pair.a, pair.b, pair.offset, simplex, {-1, above});
  if (cache != nullptr) save_cache(simplex, *cache);
  if (found.outcome == GjkOutcome::overlap) {
    if (axis_of_smaller_cylinders(pair, axis)) return true;
    axis = axis_of(penetration(pair.a, pair.b, pair.offset, simplex));
    return true;
  }
  if (found.lower > above) return false;
  const bool capped = found.outcome == GjkOutcome::capped;
  if (capped && axis_by_pushing(pair, found.normal, found.upper, axis)) return true;
  const NearestPoints nearest = nearest_points(pair.a, pair.b, simplex);
  axis = {found.normal, found.upper, nearest.on_a, nearest.on_b, capped};
  if (pair.planar()) {  // the half-space's point is the projection of the other core's point onto the plane
    const Vec32 offset = subtract(add(pair.offset, axis.point_b), axis.point_a);
    const int64_t height = dot(axis.normal, offset) >> 30;
    if (pair.a.convex->type == ShapeType::half_space) {
      axis.point_a = subtract(add(pair.offset, axis.point_b), scaled_vector(axis.normal, height));
    } else {
      axis.point_b = subtract(add(axis.point_a, scaled_vector(axis.normal, height)), pair.offset);
    }
  }
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
