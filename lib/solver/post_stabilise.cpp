#include "solver/post_stabilise.h"

#include "math/trig.h"
#include "motion/angular_velocity.h"
#include "solver/contact_solver.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_position_sweeps = 4;  ///< sweeps over the contacts of an island

/// A body whose displacement and rotation vector take the places of the velocity and the angular velocity, so that the
/// solver's functions for velocities correct positions.
struct MovedBody {
  BodyMotion motion;
  BodyWork& work;
  Vec3<Real> rotation_vector = k_zero_vector;
  Vec3<Real> none = k_zero_vector;

  explicit MovedBody(BodyWork& of) : motion{of.displacement, k_zero_vector, k_zero_vector, k_zero_vector}, work(of) {}
  SolvedBody solved() {
    return {motion.linear_velocity, motion.angular_momentum, rotation_vector,     none, none,
            work.displacement,      work.rotation_vector,    work.inverse_inertia};
  }
  void store() {
    work.displacement = motion.linear_velocity;
    const Vec3<Real> more = scale_by_power(rotation_vector, k_angular_velocity_power);
    work.rotation_vector += more;
    work.angular_velocity += rotation_vector;  // the sum of all rotations, which is applied to `rotation` at the end
  }
};

void part(const StepSettings& settings, ContactWork& contact, BodyWork& work_a, BodyWork& work_b) {
  Block room;
  room.include(contact.separation, contact.state.point_count);
  const PairMotion<One> moved(room, work_b.displacement - work_a.displacement, work_a.rotation_vector,
                              work_b.rotation_vector, 0);
  const Block& block = moved.block;
  const NormalMotion<One> displacement(moved, contact);
  Normals<One> normals(contact, block, displacement);
  const Factor most = block.held(contact.push_max * settings.tick_time);
  for (uint32_t i = 0; i < normals.count; ++i) {
    normals.impulse[i] = k_no_ulps;
    normals.velocity[i] += sum_from(block.number(contact.separation[i]), contact.coupling_exponent);
    const Factor gap = held(normals.speed(i));
    normals.may[i] = gap < Factor(k_no_ulps);
    normals.wanted[i] = max(Factor(times(gap, Unit(0.5))), Factor(-most));
  }
  normals.solve_rows(Unit(1.0));
  Ulps along, about_first, about_second;
  normals.put(along, about_first, about_second);
  MovedBody a(work_a), b(work_b);
  SolvedBody solved_a = a.solved(), solved_b = b.solved();
  apply_normal<One>(contact, block, along, about_first, about_second, solved_a, solved_b);
  if (is_positive(contact.inverse_mass_a)) a.store();
  if (is_positive(contact.inverse_mass_b)) b.store();
}

}  // namespace

uint32_t post_stabilise(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island,
                        Span<const ContactOrder> order, Span<ContactWork> contacts) {
  for (const uint32_t slot : island) bodies.work[slot].angular_velocity = k_zero_vector;
  for (int sweep = 0; sweep < k_position_sweeps; ++sweep) {
    for (const ContactOrder& entry : order) {
      ContactWork& contact = contacts[entry.contact];
      part(settings, contact, bodies.work[contact.state.body_a], bodies.work[contact.state.body_b]);
    }
  }
  bool clamped = false;
  for (const uint32_t slot : island) {
    BodyWork& work = bodies.work[slot];
    const int exponent = bodies.properties[slot].size_exponent;
    const Vec3<Real> rotation_vector = scale_by_power(work.angular_velocity, k_angular_velocity_power);
    if (rotation_vector == k_zero_vector) continue;
    const Vec3<Real> angle = {angle_of(rotation_vector.x, exponent, clamped),
                              angle_of(rotation_vector.y, exponent, clamped),
                              angle_of(rotation_vector.z, exponent, clamped)};
    work.rotation = normalise(multiply(rotation_from_vector(angle), work.rotation));
  }
  return clamped ? 1 : 0;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
