#include <detent/contact.h>
#include <detent/query.h>

#include <algorithm>
#include <vector>

#include "broad_phase/pair_filter.h"
#include "fault.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr uint32_t k_passed_max = 64;
/// A recording starts only from states in which no dynamic body is deeper in a fixed body than this fraction of its own
/// thickness.
constexpr double k_sunk_start = 0.25;

bool is_of_type(const World& world, BodyId id, BodyType wanted) {
  BodyType type = BodyType::fixed;
  return get_type(world, id, type) == Status::ok && type == wanted;
}

/// Whether filters and joints let the two bodies touch.
bool may_touch(const World& world, BodyId a, BodyId b) {
  Filter of_a, of_b;
  if (get_filter(world, a, of_a) != Status::ok || get_filter(world, b, of_b) != Status::ok) return false;
  const bool grouped = of_a.group != 0 && of_a.group == of_b.group;
  if (grouped ? of_a.group < 0 : !masks_meet(of_a.category, of_a.mask, of_b.category, of_b.mask)) return false;
  for (JointId id = next_joint(world, {}); !is_null(id); id = next_joint(world, id)) {
    JointDef def;
    if (get_joint(world, id, def) != Status::ok || (def.collide && def.type != JointType::filter)) continue;
    if ((def.a == a && def.b == b) || (def.a == b && def.b == a)) return false;
  }
  return true;
}

/// Whether the body's centre is within the body's own shape. The centre of a ring, for example, is not.
bool contains_own_centre(const World& world, BodyId id, const Position& centre) {
  QueryHit hits[k_passed_max];
  QueryReport report;
  OverlapQuery query;
  query.shape = sphere(0.0);
  query.position = centre;
  query.filter = {~0u, ~0u, {}};
  query.all = true;
  if (query_overlap(world, query, {hits, k_passed_max}, report) != Status::ok) return false;
  return std::any_of(hits, hits + report.hits, [id](const QueryHit& hit) { return hit.body == id && !hit.undecided; });
}

/// The fault that the centre of a dynamic body passes the surface of a fixed body, from the outside, within a step.
class TunnelsFault : public Fault {
 public:
  void before_step(const World& world) override {
    centres_.clear();
    for (BodyId id = next_body(world, {}); !is_null(id); id = next_body(world, id)) {
      Pose pose;
      bool sensor = false;
      if (!concerns(id) || !is_of_type(world, id, BodyType::dynamic) || get_sensor(world, id, sensor) != Status::ok ||
          sensor || get_pose(world, id, pose) != Status::ok) {
        continue;
      }
      centres_.push_back({id, pose.position});
    }
  }

  std::string after_step(const World& world, const StepReport& report, bool& clean) override {
    clean = !any_sunk(world);
    if (report.tick <= from) return {};
    for (const Centre& before : centres_) {
      const BodyId passed = passed_by(world, before);
      if (is_null(passed)) continue;
      return "the centre of " + fault_body_text(before.id) + " passes the surface of " + fault_body_text(passed) +
             ", which is fixed";
    }
    return {};
  }
  std::string name() const override { return "body whose centre passes the surface of a fixed body"; }

 private:
  struct Centre {
    BodyId id;
    Position position;
  };

  /// The first fixed body whose surface the centre has passed in the step; null if none.
  static BodyId passed_by(const World& world, const Centre& before) {
    Pose now;
    if (get_pose(world, before.id, now) != Status::ok || now.position == before.position) return {};
    RayQuery query;
    query.origin = before.position;
    if (real_from_host(coord_to_host(now.position.x - before.position.x), query.displacement.x) != Status::ok ||
        real_from_host(coord_to_host(now.position.y - before.position.y), query.displacement.y) != Status::ok ||
        real_from_host(coord_to_host(now.position.z - before.position.z), query.displacement.z) != Status::ok) {
      return {};
    }
    query.filter = {~0u, ~0u, before.id};
    query.all = true;
    QueryHit hits[k_passed_max];
    QueryReport report;
    if (query_ray(world, query, {hits, k_passed_max}, report) != Status::ok) return {};
    for (uint32_t i = 0; i < report.hits; ++i) {
      const QueryHit& hit = hits[i];
      // At fraction 0 the ray starts within the fixed body: its surface was passed before.
      if (hit.undecided || hit.fraction == Fraction(0.0) || !is_of_type(world, hit.body, BodyType::fixed)) continue;
      if (may_touch(world, before.id, hit.body) && contains_own_centre(world, before.id, now.position)) return hit.body;
    }
    return {};
  }

  bool any_sunk(const World& world) const {
    const uint32_t count = get_info(world).contacts;
    for (uint32_t i = 0; i < count; ++i) {
      Contact contact;
      if (get_contact(world, i, contact) != Status::ok || !(concerns(contact.a) || concerns(contact.b))) continue;
      const bool of_fixed =
          is_of_type(world, contact.a, BodyType::fixed) || is_of_type(world, contact.b, BodyType::fixed);
      // Of the two bodies, only the dynamic one has a thickness; that of the fixed body is 0.
      const double thickness = fault_body_thickness(world, contact.a) + fault_body_thickness(world, contact.b);
      if (of_fixed && thickness > 0 && fault_depth_of(contact) > k_sunk_start * thickness) return true;
    }
    return false;
  }

  std::vector<Centre> centres_;
};

}  // namespace

std::unique_ptr<Fault> make_tunnels_fault() { return std::make_unique<TunnelsFault>(); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
