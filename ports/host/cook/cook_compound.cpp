#include "cook_compound.h"

#include <math.h>
#include <string.h>

#include <algorithm>

#include "describe.h"
#include "mass.h"
#include "shape/compound.h"
#include "writer.h"

namespace detent_cook {
namespace {

constexpr double k_one = 0x1p30;
constexpr double k_pi = 3.14159265358979323846;
constexpr double k_inner_scale = 0.5;  ///< a hull's inner hull is the hull scaled by this about its centre of mass
constexpr int k_exponent_min = -14, k_exponent_max = 15;

/// Second moments about a centre, divided by the mass: xx, yy, zz, xy, yz, zx.
using Second = std::array<double, 6>;

struct PartMass {
  double mass = 0;
  Point centre{};
  Second second{};
};

std::string part_text(size_t i) { return "part " + std::to_string(i + 1) + ": "; }

bool is_length(double value) { return value >= 0x1p-15 && value <= 0x1p15; }

/// R diag(d) R*; the columns of R are the axes.
Second turned(const Matrix& r, const std::array<double, 3>& d) {
  const auto entry = [&](size_t i, size_t j) {
    return r[i][0] * d[0] * r[j][0] + r[i][1] * d[1] * r[j][1] + r[i][2] * d[2] * r[j][2];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)};
}

PartMass ball_mass(const CompoundPart& part) {
  const double r = part.radius, along = r * r / 5;
  return {4 * k_pi / 3 * r * r * r, part.points[0], {along, along, along, 0, 0, 0}};
}

PartMass capsule_mass(const CompoundPart& part) {
  const Point &a = part.points[0], &b = part.points[1];
  const Point displacement = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const double length = sqrt(displacement[0] * displacement[0] + displacement[1] * displacement[1] +
                             displacement[2] * displacement[2]),
               h = length / 2, r = part.radius;
  const double cylinder = k_pi * r * r * length, balls = 4 * k_pi / 3 * r * r * r, mass = cylinder + balls;
  const double across = (cylinder * r * r / 4 + balls * r * r / 5) / mass;
  const double along = (cylinder * h * h / 3 + balls * (h * h + 0.75 * h * r + r * r / 5)) / mass;
  // `across` in every direction, and the rest along the axis
  const double n[3] = {displacement[0] / length, displacement[1] / length, displacement[2] / length},
               more = along - across;
  return {mass,
          {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2},
          {across + more * n[0] * n[0], across + more * n[1] * n[1], across + more * n[2] * n[2], more * n[0] * n[1],
           more * n[1] * n[2], more * n[2] * n[0]}};
}

std::vector<Point> grown(const std::vector<Point>& points, double radius) {
  if (radius == 0) return points;
  std::vector<Point> result;
  for (const Point& p : points) {
    for (int k = 0; k < 8; ++k) {
      result.push_back({p[0] + ((k & 1) != 0 ? radius : -radius), p[1] + ((k & 2) != 0 ? radius : -radius),
                        p[2] + ((k & 4) != 0 ? radius : -radius)});
    }
  }
  return result;
}

/// Returns the problem; empty if there is none.
std::string hull_mass(const CompoundPart& part, PartMass& mass) {
  const CookResult sharp = cook_hull(part.points, {});
  if (sharp.bytes.empty()) return sharp.reason;
  const CookResult hull = cook_hull(grown(part.points, part.radius), {});
  if (hull.bytes.empty()) return hull.reason;
  std::array<double, 3> inertia;
  const double unit = ldexp(1, hull.exponent);
  for (size_t k = 0; k < 3; ++k) inertia[k] = unit * unit / hull.inverse_inertia[k];
  const double half = (inertia[0] + inertia[1] + inertia[2]) / 2;
  GridRotation rotation;
  for (size_t k = 0; k < 4; ++k) rotation[k] = static_cast<int32_t>(hull.rotation[k] * k_one);
  mass.mass = hull.volume;
  mass.centre = hull.centre;
  mass.second = turned(matrix_from(rotation), {half - inertia[0], half - inertia[1], half - inertia[2]});
  return {};
}

std::string mass_of(const CompoundPart& part, PartMass& mass) {
  if (!(part.density > 0) || !(part.density <= 0x1p20) || part.density < 0x1p-20)
    return "its density must be from 2^-20 to 2^20 of the body's";
  if (part.kind != CompoundPart::Kind::hull || part.radius != 0) {
    if (!is_length(part.radius)) return "its radius must be from 2^-15 to 2^15 m";
  }
  for (const Point& point : part.points) {
    for (const double value : point) {
      if (!(fabs(value) <= 0x1p31)) return "a coordinate is no number, or beyond 2^31 m";
    }
  }
  if (part.kind == CompoundPart::Kind::hull) {
    if (const std::string problem = hull_mass(part, mass); !problem.empty()) return problem;
  } else if (part.points.size() != (part.kind == CompoundPart::Kind::ball ? 1 : 2)) {
    return "a ball has one point, a capsule two";
  } else if (part.kind == CompoundPart::Kind::capsule && part.points[0] == part.points[1]) {
    return "a capsule's ends must differ";
  } else {
    mass = part.kind == CompoundPart::Kind::ball ? ball_mass(part) : capsule_mass(part);
  }
  mass.mass *= part.density;
  return {};
}

/// Sums all parts about the common centre, or about the origin in the source frame.
PartMass total_of(const std::vector<PartMass>& masses, Frame frame) {
  PartMass total;
  for (const PartMass& part : masses) total.mass += part.mass;
  for (const PartMass& part : masses) {
    if (frame == Frame::source) break;
    for (size_t k = 0; k < 3; ++k) total.centre[k] += part.mass / total.mass * part.centre[k];
  }
  for (const PartMass& part : masses) {
    const double share = part.mass / total.mass;
    const Point d = {part.centre[0] - total.centre[0], part.centre[1] - total.centre[1],
                     part.centre[2] - total.centre[2]};
    const Second shift = {d[0] * d[0], d[1] * d[1], d[2] * d[2], d[0] * d[1], d[1] * d[2], d[2] * d[0]};
    for (size_t m = 0; m < 6; ++m) total.second[m] += share * (part.second[m] + shift[m]);
  }
  return total;
}

/// The body's frame in the source frame.
struct Placement {
  Point origin{};
  GridRotation rotation = k_no_rotation;
  Matrix axes = matrix_from(k_no_rotation);

  Point to_body(const Point& p) const {
    const Point d = {p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
    Point result;
    for (size_t i = 0; i < 3; ++i) result[i] = axes[0][i] * d[0] + axes[1][i] * d[1] + axes[2][i] * d[2];
    return result;
  }
  /// The second moment along an axis of the body.
  double along(size_t axis, const Second& s) const {
    const double x = axes[0][axis], y = axes[1][axis], z = axes[2][axis];
    return s[0] * x * x + s[1] * y * y + s[2] * z * z + 2 * (s[3] * x * y + s[4] * y * z + s[5] * z * x);
  }
};

/// A part in the body's frame, with cooked hulls.
struct Child {
  CompoundPart part;
  std::vector<uint8_t> hull{}, inner{};
};

std::string cook_child(const CompoundPart& part, const PartMass& mass, const Placement& placement, Child& child) {
  child.part = part;
  for (Point& point : child.part.points) point = placement.to_body(point);
  if (part.kind != CompoundPart::Kind::hull) return {};
  CookOptions options;
  options.frame = Frame::source;
  const CookResult hull = cook_hull(child.part.points, options);
  if (hull.bytes.empty()) return hull.reason;
  const Point centre = placement.to_body(mass.centre);
  std::vector<Point> within = child.part.points;
  for (Point& point : within) {
    for (size_t k = 0; k < 3; ++k) point[k] = centre[k] + k_inner_scale * (point[k] - centre[k]);
  }
  const CookResult inner = cook_hull(within, options);
  if (inner.bytes.empty()) return inner.reason;
  child.hull = hull.bytes;
  child.inner = inner.bytes;
  return {};
}

/// Copies the bytes to an 8-byte aligned block, as the library requires.
std::vector<uint64_t> aligned_to_8(const std::vector<uint8_t>& bytes) {
  std::vector<uint64_t> words(bytes.size() / 8);
  if (!bytes.empty()) memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

struct Measured {
  detent::CompoundChild child;
  detent::ChildMeasure measure;
};

/// Measures each child in steps of 2^-30 of the unit 2^exponent m. False if a child extends beyond the unit.
bool measure_all(const std::vector<Child>& children, int exponent, std::vector<Measured>& measured) {
  measured.clear();
  for (const Child& from : children) {
    const auto steps = [&](double value) {
      return static_cast<int32_t>(floor(std::clamp(ldexp(value, 30 - exponent), -k_one, k_one - 1) + 0.5));
    };
    const auto vector = [&](const Point& p) { return detent::Vec32{steps(p[0]), steps(p[1]), steps(p[2])}; };
    Measured one = {};
    if (ldexp(from.part.radius, 30 - exponent) >= k_one) return false;
    one.child.radius = steps(from.part.radius);
    detent::HullView hull;
    const std::vector<uint64_t> words = aligned_to_8(from.hull);
    if (from.part.kind == CompoundPart::Kind::hull) {
      one.child.kind = detent::ChildKind::hull;
      hull = detent::hull_view(reinterpret_cast<const uint8_t*>(words.data()));
      if (hull.exponent() > exponent) return false;
    } else {
      one.child.kind =
          from.part.kind == CompoundPart::Kind::ball ? detent::ChildKind::ball : detent::ChildKind::capsule;
      for (const Point& point : from.part.points) {
        for (const double value : point) {
          if (fabs(ldexp(value, 30 - exponent)) >= k_one) return false;
        }
      }
      one.child.low = vector(from.part.points.front());
      one.child.high = vector(from.part.points.back());
    }
    one.measure = detent::measure_child(one.child, hull, exponent);
    if (one.measure.radius >= int64_t{1} << 30) return false;
    measured.push_back(one);
  }
  return true;
}

void put_vector(Writer& writer, uint32_t at, const detent::Vec32& v) {
  writer.put(at, v.x);
  writer.put(at + 4, v.y);
  writer.put(at + 8, v.z);
}

void put_bytes(Writer& writer, uint32_t at, const std::vector<uint8_t>& bytes) {
  for (size_t i = 0; i < bytes.size(); ++i) writer.put(at + static_cast<uint32_t>(i), bytes[i]);
}

std::vector<uint8_t> encode(const std::vector<Child>& children, const std::vector<Measured>& measured, int32_t exponent,
                            const PartMass& mass, const Placement& placement) {
  const uint32_t count = static_cast<uint32_t>(children.size());
  uint32_t at = detent::k_compound_header_bytes + detent::k_compound_child_bytes * count, end = at;
  for (const Child& child : children) end += static_cast<uint32_t>(child.hull.size() + child.inner.size());
  Writer writer(end);
  writer.put_magic(detent::k_compound_magic, detent::k_compound_format_version);
  writer.put(detent::k_compound_exponent_at, exponent);
  writer.put(detent::k_compound_child_count_at, count);
  int64_t radius = 0, thickness = INT32_MAX;
  detent::Vec32 half = {0, 0, 0};
  for (uint32_t i = 0; i < count; ++i) {
    detent::CompoundChild child = measured[i].child;
    const detent::ChildMeasure& measure = measured[i].measure;
    child.low = measure.low;
    child.high = measure.high;
    radius = std::max(radius, measure.radius);
    thickness = std::min(thickness, measure.half_thickness);
    const detent::ChildBox box = detent::child_box(child);
    half = {std::max({half.x, -box.low.x, box.high.x}), std::max({half.y, -box.low.y, box.high.y}),
            std::max({half.z, -box.low.z, box.high.z})};
    const uint32_t start = detent::k_compound_header_bytes + detent::k_compound_child_bytes * i;
    writer.put(start + detent::k_child_kind_at, static_cast<uint32_t>(child.kind));
    writer.put(start + detent::k_child_radius_at, child.radius);
    put_vector(writer, start + detent::k_child_low_at, child.low);
    put_vector(writer, start + detent::k_child_high_at, child.high);
    writer.put(start + detent::k_child_half_thickness_at, static_cast<int32_t>(measure.half_thickness));
    if (children[i].hull.empty()) continue;
    writer.put(start + detent::k_child_hull_at, at);
    put_bytes(writer, at, children[i].hull);
    at += static_cast<uint32_t>(children[i].hull.size());
    writer.put(start + detent::k_child_inner_at, at);
    put_bytes(writer, at, children[i].inner);
    at += static_cast<uint32_t>(children[i].inner.size());
  }
  writer.put(detent::k_compound_radius_at, static_cast<int32_t>(radius));
  put_vector(writer, detent::k_compound_half_extents_at, half);
  writer.put(detent::k_compound_half_thickness_at, static_cast<int32_t>(thickness));
  writer.put_scaled(detent::k_compound_volume_at, ldexp(mass.mass, -3 * exponent));
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const double inertia = placement.along((axis + 1) % 3, mass.second) + placement.along((axis + 2) % 3, mass.second);
    writer.put_scaled(detent::k_compound_inverse_inertia_at + 8 * axis, ldexp(1, 2 * exponent) / inertia);
    const double origin = placement.origin[axis] + 0.0;  // never -0
    uint64_t bits;
    memcpy(&bits, &origin, sizeof bits);
    writer.put(detent::k_compound_origin_at + 8 * axis, bits);
  }
  for (uint32_t k = 0; k < 4; ++k) writer.put(detent::k_compound_rotation_at + 4 * k, placement.rotation[k]);
  return writer.sealed();
}

}  // namespace

CompoundResult cook_compound(const std::vector<CompoundPart>& parts, Frame frame) {
  const auto refused = [](const std::string& reason) { return CompoundResult{{}, reason}; };
  if (parts.empty() || parts.size() > detent::k_compound_children_max)
    return refused("a compound has 1 to 64 parts, not " + std::to_string(parts.size()));
  std::vector<PartMass> masses(parts.size());
  for (size_t i = 0; i < parts.size(); ++i) {
    if (const std::string problem = mass_of(parts[i], masses[i]); !problem.empty())
      return refused(part_text(i) + problem);
  }
  const PartMass total = total_of(masses, frame);
  Placement placement;
  placement.origin = total.centre;
  if (frame == Frame::principal) placement.rotation = rotation_from(principal_axes(total.second));
  placement.axes = matrix_from(placement.rotation);
  std::vector<Child> children(parts.size());
  for (size_t i = 0; i < parts.size(); ++i) {
    if (const std::string problem = cook_child(parts[i], masses[i], placement, children[i]); !problem.empty())
      return refused(part_text(i) + problem);
  }
  std::vector<Measured> measured;
  int exponent = k_exponent_min;
  while (exponent <= k_exponent_max && !measure_all(children, exponent, measured)) ++exponent;
  if (exponent > k_exponent_max) return refused("the furthest point lies 2^15 m or more from the centre of mass");
  CompoundResult result = {encode(children, measured, exponent, total, placement), {}};
  result.reason = describe_compound(result.bytes).problem;
  if (result.reason.empty()) return result;
  return refused("the library refuses the cooked compound (" + result.reason + "): it may be too small, or too thin");
}

std::vector<Point> box_points(const Point& centre, const Point& half, const std::array<double, 4>& rotation) {
  const auto [x, y, z, w] = rotation;
  const double s = 2 / (x * x + y * y + z * z + w * w);
  const Matrix m = {{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (z * x + w * y)},
                     {s * (x * y + w * z), 1 - s * (z * z + x * x), s * (y * z - w * x)},
                     {s * (z * x - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
  std::vector<Point> points;
  for (int k = 0; k < 8; ++k) {
    const Point corner = {(k & 1) != 0 ? half[0] : -half[0], (k & 2) != 0 ? half[1] : -half[1],
                          (k & 4) != 0 ? half[2] : -half[2]};
    Point point;
    for (size_t i = 0; i < 3; ++i)
      point[i] = centre[i] + m[i][0] * corner[0] + m[i][1] * corner[1] + m[i][2] * corner[2];
    points.push_back(point);
  }
  return points;
}

}  // namespace detent_cook
