#include "tests/common/oracle/contact_patch.h"

#include <math.h>

namespace detent_oracle {
namespace {

constexpr Number k_pi = 3.141592653589793238462643383279502884L;

/// The planes through three of the points that hold all of them.
std::vector<FacePlane> faces_of(const std::vector<Arrow>& points, Number size) {
  std::vector<FacePlane> faces;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = i + 1; j < points.size(); ++j) {
      for (size_t k = j + 1; k < points.size(); ++k) {
        const Arrow across = cross(points[j] - points[i], points[k] - points[i]);
        const Number area = length(across);
        if (area <= 1e-14L * size * size) continue;
        Arrow normal = across * (1 / area);
        Number low = HUGE_VALL, high = -HUGE_VALL;
        for (const Arrow& p : points) {
          const Number height = dot(normal, p - points[i]);
          low = std::min(low, height);
          high = std::max(high, height);
        }
        if (high > 1e-16L * size && low < -1e-16L * size) continue;
        if (high > 1e-16L * size) normal = -normal;
        const Number limit = dot(normal, points[i]);
        const bool known = std::any_of(faces.begin(), faces.end(), [&](const FacePlane& face) {
          return length(face.normal - normal) < 1e-12L && fabsl(face.limit - limit) < 1e-12L * size;
        });
        if (!known) faces.push_back({normal, limit});
      }
    }
  }
  return faces;
}

/// Angles all round, close to each other about 0.
std::vector<Number> graded_angles() {
  constexpr int k_even = 48, k_fine = 26;
  std::vector<Number> angles;
  for (int i = 0; i < k_even; ++i) angles.push_back(2 * k_pi * i / k_even);
  Number angle = 2 * k_pi / k_even / sqrtl(2);
  for (int i = 0; i < k_fine; ++i, angle /= sqrtl(2)) {
    angles.push_back(angle);
    angles.push_back(-angle);
  }
  return angles;
}

struct Span {
  Number from = -HUGE_VALL, to = HUGE_VALL;
  bool empty() const { return !(from <= to); }
  /// Keeps what has at + s rate <= 0.
  void hold(Number at, Number rate) {
    if (rate > 0)
      to = std::min(to, -at / rate);
    else if (rate < 0)
      from = std::max(from, -at / rate);
    else if (at > 0)
      to = -HUGE_VALL;
  }
};

/// Of a ball about a rod's core: a convex set, so the span of what its parts have.
Span span_of_rod(const Arrow& end_a, const Arrow& end_b, Number radius, const Arrow& p, const Arrow& d) {
  Span result = {HUGE_VALL, -HUGE_VALL};
  const auto take = [&](Number from, Number to) {
    result.from = std::min(result.from, from);
    result.to = std::max(result.to, to);
  };
  for (const Arrow* end : {&end_a, &end_b}) {
    const Arrow displacement = p - *end;
    const Number half = dot(displacement, d), rest = dot(displacement, displacement) - radius * radius,
                 root = half * half - rest;
    if (root >= 0) take(-half - sqrtl(root), -half + sqrtl(root));
  }
  const Arrow axis = end_b - end_a;
  const Number size = length(axis);
  if (size == 0) return result;
  const Arrow along = axis * (1 / size), displacement = p - end_a;
  const Arrow across = displacement - along * dot(displacement, along), rate = d - along * dot(d, along);
  const Number a = dot(rate, rate), half = dot(across, rate),
               root = half * half - a * (dot(across, across) - radius * radius);
  if (a <= 0 || root < 0) return result;
  Span side = {(-half - sqrtl(root)) / a, (-half + sqrtl(root)) / a};
  side.hold(-dot(displacement, along), -dot(d, along));
  side.hold(dot(displacement, along) - size, dot(d, along));
  if (!side.empty()) take(side.from, side.to);
  return result;
}

/// Where a quadratic a s^2 + 2 half s + c crosses 0.
int roots_of(Number a, Number half, Number c, Number (&root)[2]) {
  if (a == 0) {
    if (half == 0) return 0;
    root[0] = -c / (2 * half);
    return 1;
  }
  const Number square = half * half - a * c;
  if (square < 0) return 0;
  const Number sum = half < 0 ? -half + sqrtl(square) : -half - sqrtl(square);
  root[0] = sum / a;
  root[1] = sum == 0 ? root[0] : c / sum;
  return 2;
}

Span span_of_cylinder(const ConvexSolid& solid, const Arrow& p, const Arrow& d) {
  Span result;
  result.hold(p.y - solid.half_length, d.y);
  result.hold(-p.y - solid.half_length, -d.y);
  const Number a = d.x * d.x + d.z * d.z, half = p.x * d.x + p.z * d.z,
               c = p.x * p.x + p.z * p.z - solid.radius * solid.radius;
  Number root[2];
  if (a == 0 && c <= 0) return result;
  if (a == 0 || roots_of(a, half, c, root) != 2) return {1, -1};
  result.from = std::max(result.from, std::min(root[0], root[1]));
  result.to = std::min(result.to, std::max(root[0], root[1]));
  return result;
}

/// Of the places where a line crosses the side or the base, those that are on them.
Span span_of_cone(const ConvexSolid& solid, const Arrow& p, const Arrow& d) {
  const Number low = -solid.half_length / 2, high = 1.5L * solid.half_length;
  const Number slope = solid.radius / (high - low), down = high - p.y;  // radius at y: slope (high - y)
  const Number a = d.x * d.x + d.z * d.z - slope * slope * d.y * d.y;
  const Number half = p.x * d.x + p.z * d.z + slope * slope * down * d.y;
  const Number c = p.x * p.x + p.z * p.z - slope * slope * down * down;
  Span result = {HUGE_VALL, -HUGE_VALL};
  const auto take = [&](Number s) {
    result.from = std::min(result.from, s);
    result.to = std::max(result.to, s);
  };
  Number root[2];
  const int count = roots_of(a, half, c, root);
  for (int i = 0; i < count; ++i) {
    const Number y = p.y + root[i] * d.y;
    if (y >= low && y <= high) take(root[i]);
  }
  if (d.y != 0) {
    const Number s = (low - p.y) / d.y;
    if (hypotl(p.x + s * d.x, p.z + s * d.z) <= solid.radius) take(s);
  }
  return result;
}

/// A plane in a patch's axes: u, v across and w along the normal.
struct FlatPlane {
  Number u, v, w, limit;
  bool of_a;
};

void add_planes(const FacedSolid& solid, const Frame& frame, const Arrow& at, const Arrow& towards, const Patch& patch,
                bool of_a, std::vector<FlatPlane>& planes) {
  for (const FacePlane& face : solid.planes(to_local(frame, towards))) {
    const Arrow normal = to_world(frame, face.normal);
    planes.push_back(
        {dot(patch.u, normal), dot(patch.v, normal), dot(patch.normal, normal), face.limit + dot(normal, at), of_a});
  }
}

}  // namespace

FacedSolid::FacedSolid(const ConvexSolid& solid) : solid_(solid) {
  if (solid.core == CoreKind::points && solid.points.size() > 3) faces_ = faces_of(solid.points, solid.distance_max);
}

std::vector<FacePlane> FacedSolid::planes(const Arrow& direction) const {
  if (!faces_.empty()) return faces_;
  std::vector<FacePlane> planes;
  if (solid_.core == CoreKind::points) {
    const Number grown = 1e-7L * std::max(solid_.distance_max, solid_.rounding);
    const Arrow axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const Arrow& axis : axes) {
      for (const Arrow& normal : {axis, -axis}) planes.push_back({normal, support_value(solid_, normal) + grown});
    }
    return planes;
  }
  const bool is_cone = solid_.core == CoreKind::cone;
  planes.push_back({{0, -1, 0}, is_cone ? solid_.half_length / 2 : solid_.half_length});
  if (!is_cone) planes.push_back({{0, 1, 0}, solid_.half_length});
  const Number rise = is_cone ? solid_.radius / (2 * solid_.half_length) : 0, scale = 1 / hypotl(1, rise);
  const Number towards = direction.x == 0 && direction.z == 0 ? 0 : atan2l(direction.z, direction.x);
  for (const Number angle : graded_angles()) {
    const Arrow normal = {cosl(towards + angle) * scale, rise * scale, sinl(towards + angle) * scale};
    planes.push_back({normal, support_value(solid_, normal)});
  }
  return planes;
}

bool FacedSolid::span(const Arrow& p, const Arrow& direction, Number& from, Number& to) const {
  Span result;
  if (!faces_.empty()) {
    for (const FacePlane& face : faces_) result.hold(dot(face.normal, p) - face.limit, dot(face.normal, direction));
  } else if (solid_.core == CoreKind::points) {
    result = span_of_rod(solid_.points.front(), solid_.points.back(), solid_.rounding, p, direction);
  } else {
    result =
        solid_.core == CoreKind::cone ? span_of_cone(solid_, p, direction) : span_of_cylinder(solid_, p, direction);
  }
  from = result.from;
  to = result.to;
  return !result.empty();
}

Patch patch_of(const FacedSolid& a, const FacedSolid& b, const Placement& placement, const Arrow& normal,
               Number level) {
  Patch patch;
  const Arrow aside = fabsl(normal.x) < 0.6L ? Arrow{1, 0, 0} : Arrow{0, 1, 0};
  const Arrow across = cross(normal, aside);
  patch.normal = normal;
  patch.u = across * (1 / length(across));
  patch.v = cross(normal, patch.u);
  // Over a place of the patch A, moved out by its ball, reaches above the lower side of B, moved down by its ball and
  // the level: the height is eliminated from the planes, a lower one with an upper one at a time (Fourier, Motzkin).
  std::vector<FlatPlane> planes;
  add_planes(a, placement.a, normal * a.solid().rounding, normal, patch, true, planes);
  add_planes(b, placement.b, placement.offset - normal * (b.solid().rounding + level), -normal, patch, false, planes);
  const Number size = 2 * (a.solid().distance_max + b.solid().distance_max + a.solid().rounding + b.solid().rounding +
                           length(placement.offset));
  patch.outline = {{-size, -size}, {size, -size}, {size, size}, {-size, size}};
  const auto hold = [&](Number u, Number v, Number limit) {
    const Number across_size = hypotl(u, v);
    if (across_size > 0)
      cut(patch.outline, {u / across_size, v / across_size}, limit / across_size);
    else if (limit < 0)
      patch.outline.clear();
  };
  for (const FlatPlane& p : planes) {
    if (fabsl(p.w) < 1e-17L) hold(p.u, p.v, p.limit);
    if (p.w < 1e-17L) continue;
    for (const FlatPlane& q : planes) {
      if (patch.outline.empty()) return patch;
      if (q.w <= -1e-17L && (p.of_a || !q.of_a))
        hold(p.w * q.u - q.w * p.u, p.w * q.v - q.w * p.v, p.w * q.limit - q.w * p.limit);
    }
  }
  // A side between corners that are one but for rounding has no direction.
  const auto same = [&](const Spot& p, const Spot& q) { return hypotl(p.u - q.u, p.v - q.v) < 1e-13L * size; };
  Polygon& outline = patch.outline;
  outline.erase(std::unique(outline.begin(), outline.end(), same), outline.end());
  while (outline.size() > 1 && same(outline.front(), outline.back())) outline.pop_back();
  return patch;
}

bool gap_over(const FacedSolid& a, const FacedSolid& b, const Placement& placement, const Arrow& normal, const Arrow& p,
              Number& gap) {
  const auto span = [&](const FacedSolid& solid, const Frame& frame, const Arrow& from_centre, Number& from,
                        Number& to) {
    return solid.span(to_local(frame, from_centre), to_local(frame, normal), from, to);
  };
  Number a_from, a_to, b_from, b_to;
  if (!span(a, placement.a, p, a_from, a_to) || !span(b, placement.b, p - placement.offset, b_from, b_to)) return false;
  gap = b_from - a_to;
  return true;
}

}  // namespace detent_oracle
