#include "scene_player.h"
#include "text.h"

// Prints the results of a run: hits of queries, events, poses of bodies.

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr uint32_t k_hits_max = 256;

std::vector<double> numbers(const Position& point) {
  return {coord_to_host(point.x), coord_to_host(point.y), coord_to_host(point.z)};
}
std::vector<double> reals(const Vec3<Real>& vector) {
  return {real_to_host(vector.x), real_to_host(vector.y), real_to_host(vector.z)};
}
std::vector<double> units(const Vec3<Unit>& vector) {
  return {unit_to_host(vector.x), unit_to_host(vector.y), unit_to_host(vector.z)};
}
std::vector<double> units(const Quat& rotation) {
  return {unit_to_host(rotation.x), unit_to_host(rotation.y), unit_to_host(rotation.z), unit_to_host(rotation.w)};
}
std::vector<double> scaleds(const Vec3<Scaled>& vector) {
  return {scaled_to_host(vector.x), scaled_to_host(vector.y), scaled_to_host(vector.z)};
}

const char* event_name(ContactEventType type) {
  switch (type) {
    case ContactEventType::begin:
      return "begin";
    case ContactEventType::touch:
      return "touch";
    case ContactEventType::end:
      return "end";
    default:
      return "hit";
  }
}

}  // namespace

Status ScenePlayer::ask(const SceneAction& action) {
  QueryFilter filter = action.asked.filter;
  filter.ignore = bodies_.find(action.asked.ignore);
  std::vector<QueryHit> room(action.flag ? k_hits_max : 1);
  const QueryHits hits = {room.data(), static_cast<uint32_t>(room.size())};
  QueryReport report;
  Status status = Status::ok;
  switch (action.call) {
    case Call::query_ray:
      status = recorder_.query_ray({action.position, action.displacement, filter, action.flag}, hits, report);
      break;
    case Call::query_cast:
      status = recorder_.query_cast({action.shape, action.position, action.rotation, action.displacement,
                                     action.rotation_vector, filter, action.flag},
                                    hits, report);
      break;
    case Call::query_overlap:
      status =
          recorder_.query_overlap({action.shape, action.position, action.rotation, filter, action.flag}, hits, report);
      break;
    case Call::query_bounds:
      status = recorder_.query_bounds({action.position, action.upper, filter, action.flag}, hits, report);
      break;
    default:
      status = recorder_.query_closest(
          {action.shape, action.position, action.rotation, action.first, filter, action.flag}, hits, report);
      break;
  }
  if (status != Status::ok || !prints_.queries) return status;
  RunLine line = {get_info(recorder_.world()).tick, call_name(action.call), {}};
  if (!action.name.empty()) line.add("name", action.name);
  line.add("hits", report.hits);
  if (report.dropped != 0) line.add("dropped", report.dropped);
  print_(line);
  for (uint32_t i = 0; i < report.hits; ++i) {
    const QueryHit& hit = room[i];
    RunLine found = {line.tick, "found", {}};
    if (!action.name.empty()) found.add("name", action.name);
    found.add("body", bodies_.of(hit.body));
    if (hit.undecided) found.add("undecided", 1);
    if (action.call == Call::query_ray || action.call == Call::query_cast) {
      found.add("fraction", fraction_to_host(hit.fraction));
    }
    if (action.call == Call::query_closest) found.add("distance", real_to_host(hit.distance));
    if (action.call != Call::query_bounds) {
      found.add("point", numbers(hit.point));
      found.add("normal", units(hit.normal));
    }
    if (hit.triangle != UINT32_MAX) {
      found.add("triangle", hit.triangle);
      found.add("material", hit.material);
    }
    print_(found);
  }
  return Status::ok;
}

void ScenePlayer::print_events(const World& world, const StepReport& report) const {
  for (uint32_t i = 0; i < report.events.contact; ++i) {
    const ContactEvent& event = world.hooks.contact_events.data[i];
    if (event.type == ContactEventType::touch) continue;  // one for each pair and tick: too many to read
    RunLine line = {report.tick, event_name(event.type), {}};
    line.add("a", bodies_.of(event.a));
    line.add("b", bodies_.of(event.b));
    if (event.type != ContactEventType::end) {
      line.add("point", numbers(event.point));
      line.add("normal", units(event.normal));
    }
    if (event.type == ContactEventType::hit) line.add("speed", real_to_host(event.approach_speed));
    print_(line);
  }
  for (uint32_t i = 0; i < report.events.sensor; ++i) {
    const SensorEvent& event = world.hooks.sensor_events.data[i];
    RunLine line = {report.tick, event.type == SensorEventType::enter ? "enter" : "leave", {}};
    line.add("sensor", bodies_.of(event.sensor));
    line.add("body", bodies_.of(event.body));
    print_(line);
  }
  for (uint32_t i = 0; i < report.events.joint; ++i) {
    const JointEvent& event = world.hooks.joint_events.data[i];
    RunLine line = {report.tick, "break", {}};
    line.add("joint", joints_.of(event.joint));
    line.add("a", bodies_.of(event.a));
    line.add("b", bodies_.of(event.b));
    line.add("force", scaleds(event.reaction.force));
    line.add("torque", scaleds(event.reaction.torque));
    print_(line);
  }
  for (uint32_t i = 0; i < report.events.body; ++i) {
    const BodyEvent& event = world.hooks.body_events.data[i];
    RunLine line = {report.tick, event.type == BodyEventType::woke ? "wake" : "sleep", {}};
    line.add("body", bodies_.of(event.body));
    print_(line);
  }
}

void ScenePlayer::print_bodies(const World& world, uint64_t tick) const {
  for (BodyId id = next_body(world, {}); id.slot != 0; id = next_body(world, id)) {
    Pose pose;
    Vec3<Real> linear_velocity, angular_velocity;
    if (get_pose(world, id, pose) != Status::ok ||
        get_velocity(world, id, linear_velocity, angular_velocity) != Status::ok)
      continue;
    RunLine line = {tick, "at", {}};
    line.add("body", bodies_.of(id));
    line.add("position", numbers(pose.position));
    line.add("rotation", units(pose.rotation));
    line.add("linear_velocity", reals(linear_velocity));
    line.add("angular_velocity", reals(angular_velocity));
    print_(line);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
