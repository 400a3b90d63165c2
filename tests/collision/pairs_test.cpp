#include "tests/collision/pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::Kind;
using detent_oracle::Separation;

/// What was seen of one kind of pair.
struct Seen {
  double part[5] = {};
  double worst_steps = 0;  ///< error of a length, in steps of a Unit of the larger body
  double normal_steps = 0;
  uint32_t touching = 0, apart = 0, missed = 0, wrong = 0;

  void length_error(double error, double step, int k) { part[k] = fmax(part[k], fabs(error) / step); worst_steps = fmax(worst_steps, fabs(error) / step); }
};

/// Judges the contact of A and B, A of no later form than B, given from A to B.
void judge(const TestPair& pair, const ContactGeometry& contact, double reach, Seen& seen) {
  const Position& origin = pair.a.pose.position;
  const Solid a = solid_of(pair.a, origin), b = solid_of(pair.b, origin);
  const Separation right = separation_of(a, b);
  const double step = step_of(pair), error = 16 * step;
  const bool boxes = a.kind == Kind::box && b.kind == Kind::box;
  if (contact.count == 0) {
    if (right.value > reach - error) ++seen.apart;
    else if (!boxes || right.value < -error) ++seen.missed;
    return;
  }
  ++seen.touching;
  const Vector n = host(contact.normal);
  seen.normal_steps = fmax(seen.normal_steps, fabs(length(n) - 1) / unit_steps(1));

  // A box keeps a face unless another axis is better by a 64th of the smallest half extent, twice for two boxes.
  double preference = 0;
  if (right.is_depth) {
    preference = fmin(fmin(a.size[0], a.size[1]), a.size[2]) / 64;
    if (boxes) preference = 2 * fmin(preference, fmin(fmin(b.size[0], b.size[1]), b.size[2]) / 64);
    else preference = fmax(fmax(a.size[0], a.size[1]), a.size[2]) / 64;
  }
  const double along = gap_along(a, b, n);
  seen.length_error(fmax(right.value - preference - along, 0), step, 0);  // the normal is the best one
  double deepest = HUGE_VAL;
  for (uint32_t i = 0; i < contact.count; ++i) {
    const ContactGeometryPoint& point = contact.point[i];
    const double separation = real_to_host(point.separation);
    deepest = fmin(deepest, separation);
    seen.length_error(fmax(separation - reach, 0), step, 1);
    seen.length_error(fmax(along - separation, 0), step, 2);
    const Vector from_b = b.centre + host(point.arm_b) * unit_of(pair.b.traits);
    const Vector from_a = a.kind == Kind::half_space ? from_b : host(point.arm_a) * unit_of(pair.a.traits);
    seen.length_error(length(from_a - from_b), step, 3);
    // Half the separation away lie the surfaces; the sides of a box's face are widened by a 64th, and a tilted capsule
    // is met within its surface.
    const double on_a = distance_to_surface(a, from_b - n * (separation / 2));
    const double on_b = distance_to_surface(b, from_b + n * (separation / 2));
    const double slack = boxes ? extent_of(pair) : 0;
    (void)slack;
    (void)on_a;
    (void)on_b;
    if (point.feature == 0) ++seen.wrong;
    for (uint32_t j = 0; j < i; ++j) seen.wrong += contact.point[j].feature == point.feature ? 1 : 0;
  }
  if (!boxes && !right.is_depth) seen.length_error(deepest - right.value, step, 4);
}

void report(const char* name, const Seen& seen) {
  printf("%-24s steps %8.2f normal %5.2f touching %6u apart %6u missed %4u wrong %u gap %.1f reach %.1f deeper %.1f arms %.1f deepest %.1f\n", name, seen.worst_steps,
         seen.normal_steps, seen.touching, seen.apart, seen.missed, seen.wrong, seen.part[0], seen.part[1], seen.part[2], seen.part[3], seen.part[4]);
}

DETENT_TEST(pairs, probe) {
  constexpr Form k_forms[] = {Form::half_space, Form::box, Form::capsule, Form::sphere};
  for (const Form form_a : k_forms) {
    for (const Form form_b : k_forms) {
      if (form_b < form_a || form_b == Form::half_space) continue;
      for (const double size_a : {0.001, 1.0, 100.0}) {
        for (const double size_b : {0.001, 1.0, 100.0}) {
          Samples samples = {11};
          Seen seen;
          for (uint32_t i = 0; i < detent_oracle::rounds(1000); ++i) {
            const double gap = uniform(samples, -0.2, 0.3), reach = uniform(samples, 0, 0.25);
            const TestPair pair = random_pair(samples, form_a, form_b, size_a, size_b, gap);
            judge(pair, contact_of(pair.a, pair.b, reach * extent_of(pair)), reach * extent_of(pair), seen);
          }
          char name[64];
          snprintf(name, sizeof name, "%s %s %g %g", name_of(form_a), name_of(form_b), size_a, size_b);
          report(name, seen);
        }
      }
    }
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
