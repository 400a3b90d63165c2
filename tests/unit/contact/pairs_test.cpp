#include "tests/unit/contact/pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::Kind;
using detent_oracle::Separation;

/// The error of a length may be 2^-26 (in floats: as many steps) of the larger diameter, which is two units of length.
constexpr double k_error_steps = 32;

/// The errors found for one kind of pair, in steps of a Unit of the larger body.
struct Seen {
  double gap = 0;       ///< what the normal's gap falls short of the largest one
  double beyond = 0;    ///< separation beyond the reach
  double too_deep = 0;  ///< separation below what the solids allow along the normal
  double deepest = 0;   ///< deepest separation from the right one
  double arms = 0;      ///< the two arms' ends from each other
  double midway = 0;    ///< the points from midway between the surfaces, beyond what is allowed
  double normal = 0;    ///< length of the normal from 1
  uint32_t touching = 0, leaning = 0, apart = 0, missed = 0, missed_ahead = 0, deepest_lost = 0, features_wrong = 0,
           mirrored_wrong = 0;
};

/// The distance by which a contact point may lie beyond a face, because the sides of a face are widened; for either
/// box.
double side_slack(const Solid& a, const Solid& b) {
  double largest = 0;
  for (int i = 0; i < 3; ++i) largest = fmax(largest, fmax(a.size[i], b.size[i]));
  return 1.5 * largest / 64;
}

double smallest_size(const Solid& box) { return fmin(fmin(box.size[0], box.size[1]), box.size[2]); }

/// Whether the vertex of `other` that is extreme against `n` lies over the face of `box` with normal n. False if no
/// face has this normal.
bool deepest_vertex_is_over_face(const Solid& box, const Solid& other, const Vector& n) {
  Vector vertex = other.centre;
  for (int i = 0; i < 3; ++i) {
    vertex = vertex - other.axis[i] * (dot(other.axis[i], n) < 0 ? -other.size[i] : other.size[i]);
  }
  int sides = 0;
  for (int i = 0; i < 3; ++i) {
    if (fabs(dot(box.axis[i], n)) > 1 - 1e-9) continue;
    ++sides;
    if (fabs(dot(vertex - box.centre, box.axis[i])) > box.size[i]) return false;
  }
  return sides == 2;
}

bool is_axis_of(const Solid& box, const Vector& n) {
  for (int i = 0; i < 3; ++i) {
    if (fabs(dot(box.axis[i], n)) > 1 - 1e-6) return true;
  }
  return false;
}

/// The advantage, m, by which another axis must separate better to be preferred: the normal need not be exactly the
/// best one.
double preference_of(const Solid& a, const Solid& b, const Separation& right) {
  if (!right.is_depth) return 0;
  if (b.kind == Kind::box) return 2 * fmin(smallest_size(a), smallest_size(b)) / 64;
  return fmax(fmax(a.size[0], a.size[1]), a.size[2]) / 64;
}

/// Checks the contact of A and B, whose direction is from A to B. The type of A is no later than that of B.
void judge(const OraclePair& pair, const ContactGeometry& contact, double distance_max, Seen& seen) {
  const Solid a = solid_of(pair.a, pair.a.pose.position), b = solid_of(pair.b, pair.a.pose.position);
  const Separation right = separation_of(a, b);
  const double step = step_of(pair), error = k_error_steps * step;
  const bool boxes = a.kind == Kind::box && b.kind == Kind::box;
  if (contact.count == 0) {
    if (right.value > distance_max - error)
      ++seen.apart;
    else if (!boxes || right.value < -error)
      ++seen.missed;
    else if (detent_oracle::distance_of_boxes(a, b) < distance_max - error) {
      ++seen.missed_ahead;
      seen.missed += contact.near ? 0 : 1;
    }
    return;
  }
  ++seen.touching;
  const auto worst = [&](double& most, double length) { most = fmax(most, length / step); };
  const Vector n = host(contact.normal);
  seen.normal = fmax(seen.normal, fabs(length(n) - 1) / unit_steps(1));
  const double along = gap_along(a, b, n);
  // Shapes that are almost aligned are treated as aligned. Lengths then have second-order errors: at the rim of a box
  // 2^-27 of the distance, for cores within 2^-8 rad of parallel less. Only f64 is precise enough to show this.
  const bool parallel = a.kind == Kind::round && fabs(dot(a.axis[1], b.axis[1])) > 0.9999;
  const double aligned = a.kind == Kind::box && !boxes ? 0x1.1p-27 * (b.size[0] + distance_max)
                         : parallel                    ? 0x1p-40 * unit_of(pair.b.properties)
                                                       : 0;
  // A face at an angle of up to 2^-3 rad to crossing edges separates them by less than the best axis: beyond the sides
  // of the face, an edge may lie far below it. What counts is the depth of the deepest point.
  const double preference = preference_of(a, b, right), lost = right.value - preference - along - aligned;
  const bool leans = boxes && contact.count > 1 && lost > 2 * error;
  // A face at an angle to a capsule that crosses its sides does not separate them beside the face: the depth of the
  // deepest point counts.
  const bool crosses = a.kind == Kind::box && !boxes && b.size[1] > 0 && lost > 2 * error && is_axis_of(a, n);
  seen.leaning += leans || crosses ? 1 : 0;
  const double span = 2 * (fabs(b.centre[0]) + fabs(b.centre[1]) + fabs(b.centre[2]) +
                           length(Vector{{a.size[0], a.size[1], a.size[2]}}) +
                           length(Vector{{b.size[0], b.size[1], b.size[2]}}) + distance_max);
  if (!crosses) worst(seen.gap, leans ? lost - span / 8 : lost);

  // A sphere or capsule just beyond the rim of a box counts as over the face, within 2^-13 of the distance.
  const double slack = boxes ? side_slack(a, b) : a.kind == Kind::box ? 0x1.1p-13 * (b.size[0] + distance_max) : 0;
  // A tilted capsule has its contacts at the ends of its core, where the points may lie below its surface.
  const bool tilted = b.size[1] > 0 && (a.kind == Kind::half_space || contact.count > 1 || crosses ||
                                        (a.kind == Kind::round && fabs(dot(a.axis[1], b.axis[1])) > 0.99));
  const bool exact = boxes ? right.value < 0 : !right.is_depth && (!tilted || b.kind == Kind::box);
  double deepest = HUGE_VAL;
  for (uint32_t i = 0; i < contact.count; ++i) {
    const ContactGeometryPoint& point = contact.point[i];
    const double separation = real_to_host(point.separation);
    deepest = fmin(deepest, separation);
    worst(seen.beyond, separation - distance_max);
    worst(seen.too_deep, along - separation);
    if (leans) worst(seen.too_deep, right.value - preference - separation);
    const Vector at = b.centre + host(point.arm_b) * unit_of(pair.b.properties);
    if (a.kind != Kind::half_space) worst(seen.arms, length(host(point.arm_a) * unit_of(pair.a.properties) - at));
    const double on_a = distance_to_surface(a, at - n * (separation / 2));
    const double on_b = distance_to_surface(b, at + n * (separation / 2));
    if (exact)
      worst(seen.midway, fmax(fabs(on_a), fabs(on_b)) - slack);
    else if (a.kind != Kind::round && !right.is_depth && !boxes)
      worst(seen.midway, fmax(fabs(on_a), on_b) - slack);
    if (point.feature == 0) ++seen.features_wrong;
    for (uint32_t j = 0; j < i; ++j) seen.features_wrong += contact.point[j].feature == point.feature ? 1 : 0;
  }
  const double leaning = crosses ? preference + 0x1p-7 * (right.value + b.size[0] + preference) : 0;
  if (crosses || (!boxes && !right.is_depth)) worst(seen.deepest, fabs(deepest - right.value) - aligned - leaning);
  if (boxes && (deepest_vertex_is_over_face(a, b, n) || deepest_vertex_is_over_face(b, a, n * -1))) {
    // Of five or more vertices the ones that span the face are kept; the deepest need not be one of them.
    if (contact.count >= 3 && deepest - along > error)
      ++seen.deepest_lost;
    else
      worst(seen.deepest, fabs(deepest - along));
  }
}

/// Whether the contact of B and A mirrors that of A and B: bit for bit where the library orders the shapes by type;
/// otherwise the same points within rounding. For two boxes another face may be chosen; the caller checks that case.
bool is_mirrored(const ContactGeometry& contact, const ContactGeometry& swapped, bool same_bits, double error) {
  if (contact.count != swapped.count) return !same_bits;  // at the very edge of reach
  for (uint32_t i = 0; i < contact.count; ++i) {
    const ContactGeometryPoint& p = contact.point[i];
    const ContactGeometryPoint& q = swapped.point[i];
    if (same_bits &&
        !(p.arm_a == q.arm_b && p.arm_b == q.arm_a && p.separation == q.separation && p.feature == q.feature)) {
      return false;
    }
    if (contact.count == 1 && fabs(real_to_host(p.separation) - real_to_host(q.separation)) > error) return false;
  }
  return contact.count == 0 || !same_bits || contact.normal == -swapped.normal;
}

/// Checks pairs with random poses, sizes, gaps and search distances, for every two of three sizes.
void judge_many(Form form_a, Form form_b, uint64_t seed) {
  Samples samples = {seed};
  Seen seen;
  const bool boxes = form_a == Form::box && form_b == Form::box;
  constexpr double k_sizes[] = {0.001, 1.0, 100.0};
  const uint32_t count = detent_oracle::rounds(2700);
  for (uint32_t i = 0; i < count; ++i) {
    const double gap = uniform(samples, -0.2, 0.3), part = uniform(samples, 0, 0.25);
    const OraclePair pair = random_pair(samples, form_a, form_b, k_sizes[i % 3], k_sizes[i / 3 % 3], gap);
    const double distance_max = real_to_host(real_near(part * extent_of(pair)));
    const ContactGeometry contact = contact_of(pair.a, pair.b, distance_max);
    const ContactGeometry swapped = contact_of(pair.b, pair.a, distance_max);
    judge(pair, contact, distance_max, seen);
    const bool same_bits = form_a != form_b && form_a <= Form::box;
    if (!boxes && !is_mirrored(contact, swapped, same_bits, k_error_steps * step_of(pair))) ++seen.mirrored_wrong;
    if (form_a == form_b) judge({pair.b, pair.a}, swapped, distance_max, seen);
  }
  const double largest = fmax(fmax(fmax(seen.gap, seen.too_deep), fmax(seen.deepest, seen.arms)), seen.midway);
  ::testing::Test::RecordProperty("error_steps", ::testing::PrintToString(largest));
  ::testing::Test::RecordProperty("deepest_lost", ::testing::PrintToString(seen.deepest_lost));
  ::testing::Test::RecordProperty("missed_ahead", ::testing::PrintToString(seen.missed_ahead));
  EXPECT_LE(25 * seen.leaning, seen.touching);
  EXPECT_LE(seen.gap, 2 * k_error_steps);  // a normal errs by the error of a length, times size over distance
  EXPECT_LE(seen.beyond, k_error_steps);
  EXPECT_LE(seen.too_deep, k_error_steps);
  EXPECT_LE(seen.deepest, k_error_steps);
  EXPECT_LE(seen.arms, k_error_steps);
  EXPECT_LE(seen.midway, k_error_steps);
  EXPECT_LE(seen.normal, 12);  // a column of a matrix: twice the quaternion's error and a rounding each
  EXPECT_EQ(seen.missed, 0u);
  // Two separated boxes that approach corner to corner or edge to edge have no overlapping faces. Such a pair gets its
  // points when it overlaps.
  EXPECT_LE(seen.missed_ahead, count / 100);
  EXPECT_LE(seen.deepest_lost, count / 100);
  EXPECT_EQ(seen.features_wrong, 0u);
  EXPECT_EQ(seen.mirrored_wrong, 0u);
  EXPECT_GT(seen.touching, count / 2);
  EXPECT_GT(seen.apart, count / 5);
}

DETENT_TEST(pairs, of_a_half_space_and_a_box_agree_with_the_oracle) { judge_many(Form::half_space, Form::box, 11); }
DETENT_TEST(pairs, of_a_half_space_and_a_capsule_agree_with_the_oracle) {
  judge_many(Form::half_space, Form::capsule, 12);
}
DETENT_TEST(pairs, of_a_half_space_and_a_sphere_agree_with_the_oracle) {
  judge_many(Form::half_space, Form::sphere, 13);
}
DETENT_TEST(pairs, of_two_boxes_agree_with_the_oracle) { judge_many(Form::box, Form::box, 14); }
DETENT_TEST(pairs, of_a_box_and_a_capsule_agree_with_the_oracle) { judge_many(Form::box, Form::capsule, 15); }
DETENT_TEST(pairs, of_a_box_and_a_sphere_agree_with_the_oracle) { judge_many(Form::box, Form::sphere, 16); }
DETENT_TEST(pairs, of_two_capsules_agree_with_the_oracle) { judge_many(Form::capsule, Form::capsule, 17); }
DETENT_TEST(pairs, of_a_capsule_and_a_sphere_agree_with_the_oracle) { judge_many(Form::capsule, Form::sphere, 18); }
DETENT_TEST(pairs, of_two_spheres_agree_with_the_oracle) { judge_many(Form::sphere, Form::sphere, 19); }

/// The edges cross at the least depth; the faces separate as well.
DETENT_TEST(pairs, of_bars_that_cross_and_rock_touch_in_several_points) {
  OraclePair pair;
  pair.a.properties = pair.b.properties = box_properties({{0.2, 0.02, 0.04}});
  pair.a.pose.rotation = rotation_near({0, 0, 0, 1});
  const double leans[][2] = {{0.02, 0.004}, {-0.02, 0.005}, {0.01, -0.004}, {0.02, 0}, {0, 0}};
  for (const double(&lean)[2] : leans) {
    pair.b.pose.rotation =
        rotation_near(detent_oracle::rotation_by({{lean[0], 0, lean[1]}}) * detent_oracle::rotation_by({{0, 1.5, 0}}));
    pair.b.pose.position = position_near({{0, 0.04 + 0.04 * (fabs(lean[0]) + fabs(lean[1])) - 0.001, 0}});
    const ContactGeometry found = contact_of(pair.a, pair.b, 0.002);
    EXPECT_GE(found.count, 2u) << lean[0] << " " << lean[1];
    EXPECT_GT(host(found.normal)[1], 0.99) << lean[0] << " " << lean[1];
  }
}

/// Far away from the plate, the edge of the bar lies 5 cm below the plate's face.
DETENT_TEST(pairs, of_a_plate_that_lies_across_a_long_edge_touch_on_both_sides) {
  OraclePair pair;
  pair.a.properties = box_properties({{5, 0.5, 0.5}});
  pair.a.pose.rotation = rotation_near(detent_oracle::rotation_by({{0.78539816339744831, 0, 0}}));
  pair.b.properties = box_properties({{0.6, 0.2, 0.4}});
  for (const double lean : {0.01, -0.01, 0.003}) {
    pair.b.pose.rotation = rotation_near(detent_oracle::rotation_by({{0, 0, lean}}));
    pair.b.pose.position = position_near({{0, 0.70710678118654752 + 0.2 - 0.004, 0}});
    const ContactGeometry found = contact_of(pair.a, pair.b, 0.01);
    EXPECT_EQ(found.count, 2u) << lean;
    EXPECT_NEAR(host(found.normal)[0], -sin(lean), 1e-6) << lean;
    EXPECT_NEAR(real_to_host(found.point[0].separation) + real_to_host(found.point[1].separation), -0.008, 1e-3)
        << lean;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
