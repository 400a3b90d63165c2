#include <detent/contact.h>
#include <detent/joint.h>
#include <math.h>

#include <algorithm>
#include <limits>

#include "fault.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

/// A recording starts only from states in which the fault has at most this share of its bound.
constexpr double k_clean_share = 0.5;

struct BodyInertia {
  double mass = 0, least = 0, middle = 0, most = 0;
};

/// All 0 if the body is not dynamic.
BodyInertia inertia_of_body(const World& world, BodyId id) {
  BodyType type = BodyType::fixed;
  Scaled mass = 0.0;
  Vec3<Scaled> inertia = {};
  if (get_type(world, id, type) != Status::ok || type != BodyType::dynamic || get_mass(world, id, mass) != Status::ok ||
      get_inertia(world, id, inertia) != Status::ok) {
    return {};
  }
  double moments[] = {scaled_to_host(inertia.x), scaled_to_host(inertia.y), scaled_to_host(inertia.z)};
  std::sort(std::begin(moments), std::end(moments));
  return {scaled_to_host(mass), moments[0], moments[1], moments[2]};
}

/// The fault that two bodies overlap by more than a fraction of the thickness of the thinner dynamic body.
class DepthFault : public Fault {
 public:
  explicit DepthFault(double bound) : bound_(bound) {}

  std::string after_step(const World& world, const StepReport& report, bool& clean) override {
    double worst = 0, depth = 0;
    Contact deepest;
    const uint32_t count = get_info(world).contacts;
    for (uint32_t i = 0; i < count; ++i) {
      Contact contact;
      if (get_contact(world, i, contact) != Status::ok || !(concerns(contact.a) || concerns(contact.b))) continue;
      double thickness = std::numeric_limits<double>::infinity();
      for (const BodyId id : {contact.a, contact.b}) {
        const double own = fault_body_thickness(world, id);
        if (own > 0) thickness = std::min(thickness, own);
      }
      const double part = fault_depth_of(contact) / thickness;
      if (part <= worst) continue;
      worst = part;
      depth = fault_depth_of(contact);
      deepest = contact;
    }
    clean = worst <= k_clean_share * bound_;
    if (worst <= bound_ || report.tick <= from) return {};
    return fault_body_text(deepest.a) + " and " + fault_body_text(deepest.b) + " overlap by " + fault_figure(depth) +
           " m, " + fault_figure(worst) + " of the thickness of the thinner";
  }
  std::string name() const override {
    return "overlap of more than " + fault_figure(bound_) + " of a body's thickness";
  }

 private:
  double bound_;
};

struct HostVector {
  double x, y, z;
};
double dot_of(const HostVector& a, const HostVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HostVector host_vector(const Vec3<Real>& v) { return {real_to_host(v.x), real_to_host(v.y), real_to_host(v.z)}; }

/// The distance of the joint's anchors that its type does not permit, m: without the part along a sliding axis; for a
/// distance joint, only the part beyond its limits.
double gap_of_joint(const World& world, const JointDef& def) {
  Pose a, b;
  if (get_pose(world, def.a, a) != Status::ok || get_pose(world, def.b, b) != Status::ok) return 0;
  if (def.type == JointType::parallel || def.type == JointType::filter) return 0;
  const HostVector arm_a = host_vector(vector_to_world(a.rotation, def.anchor_a));
  const HostVector arm_b = host_vector(vector_to_world(b.rotation, def.anchor_b));
  HostVector gap = {coord_to_host(b.position.x - a.position.x) + arm_b.x - arm_a.x,
                    coord_to_host(b.position.y - a.position.y) + arm_b.y - arm_a.y,
                    coord_to_host(b.position.z - a.position.z) + arm_b.z - arm_a.z};
  if (def.type == JointType::slider || def.type == JointType::wheel) {
    const HostVector x =
        host_vector(vector_to_world(a.rotation, vector_to_world(def.frame_a, Vec3<Real>{1.0, 0.0, 0.0})));
    const double along = dot_of(gap, x);
    gap = {gap.x - along * x.x, gap.y - along * x.y, gap.z - along * x.z};
  }
  const double apart = sqrt(dot_of(gap, gap));
  if (def.type != JointType::distance) return apart;
  if (!def.axis.limited) return 0;
  return std::max({0.0, real_to_host(def.axis.lower) - apart, apart - real_to_host(def.axis.upper)});
}

/// The fault that the anchors of a joint are apart by more than a fraction of the size of the smaller dynamic body.
class GapFault : public Fault {
 public:
  explicit GapFault(double bound) : bound_(bound) {}

  std::string after_step(const World& world, const StepReport& report, bool& clean) override {
    double worst = 0, gap = 0;
    JointDef widest;
    JointId widest_id;
    for (JointId id = next_joint(world, {}); !is_null(id); id = next_joint(world, id)) {
      JointDef def;
      if (get_joint(world, id, def) != Status::ok || !(concerns(def.a) || concerns(def.b))) continue;
      double size = std::numeric_limits<double>::infinity();
      for (const BodyId body_id : {def.a, def.b}) {
        const double own = fault_body_size(world, body_id);
        if (own > 0) size = std::min(size, own);
      }
      const double own_gap = gap_of_joint(world, def);
      if (own_gap / size <= worst) continue;
      worst = own_gap / size;
      gap = own_gap;
      widest = def;
      widest_id = id;
    }
    clean = worst <= k_clean_share * bound_;
    if (worst <= bound_ || report.tick <= from) return {};
    return "joint " + std::to_string(widest_id.slot) + " of " + fault_body_text(widest.a) + " and " +
           fault_body_text(widest.b) + " is open by " + fault_figure(gap) + " m, " + fault_figure(worst) +
           " of the size of the smaller";
  }
  std::string name() const override {
    return "joint that is open by more than " + fault_figure(bound_) + " of a body's size";
  }

 private:
  double bound_;
};

}  // namespace

double fault_body_size(const World& world, BodyId id) {
  const BodyInertia inertia = inertia_of_body(world, id);
  return inertia.mass > 0 ? sqrt(12 * inertia.most / inertia.mass) : 0;
}

double fault_body_thickness(const World& world, BodyId id) {
  const BodyInertia inertia = inertia_of_body(world, id);
  if (inertia.mass <= 0 || inertia.least <= 0) return 0;
  return sqrt(std::max(0.0, 6 * (inertia.least + inertia.middle - inertia.most) / inertia.mass));
}

double fault_depth_of(const Contact& contact) {
  double depth = -std::numeric_limits<double>::infinity();
  for (uint32_t i = 0; i < contact.point_count; ++i)
    depth = std::max(depth, -real_to_host(contact.point[i].separation));
  return depth;
}

std::unique_ptr<Fault> make_depth_fault(double bound) { return std::make_unique<DepthFault>(bound); }
std::unique_ptr<Fault> make_gap_fault(double bound) { return std::make_unique<GapFault>(bound); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
