#include "call_list.h"

#include <string.h>

#include "replay/command.h"
#include "replay/replay_watch.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

namespace {

constexpr size_t k_records_bytes_max = size_t{1} << 28, k_calls_max = size_t{1} << 24;

/// Collects the calls that a player reads.
struct CallCollector {
  CallList& list;
  std::shared_ptr<std::vector<uint8_t>> records = std::make_shared<std::vector<uint8_t>>();
  std::shared_ptr<RecordedIds> ids = std::make_shared<RecordedIds>();

  bool full() const { return records->size() > k_records_bytes_max || list.calls.size() > k_calls_max; }

  void take(const uint8_t* record, uint32_t count) {
    const RecordTag tag = static_cast<RecordTag>(record[0]);
    const CommandCode* const code = find_command(tag);
    if (code == nullptr || full()) return;  // a query
    Reader reader{record, count, 1};
    if (tag == RecordTag::create_body) {
      CreateBody command;
      code->visit(reader, &command);
      ids->bodies.insert(command.id);
    } else if (tag == RecordTag::create_joint) {
      CreateJoint command;
      code->visit(reader, &command);
      ids->joints.insert(command.id);
    }
    list.calls.push_back({list.last, records->size(), count});
    records->insert(records->end(), record, record + count);
  }
};

/// Reads the ticks. Returns why the reading stopped before the end of the recording; empty if it reached the end.
std::string collect_calls(Player& player, Input& input, CallCollector& collector) {
  const ReplayWatch watch = {
      &collector,
      [](void* to, const uint8_t* record, uint32_t count) { static_cast<CallCollector*>(to)->take(record, count); },
      [](void*, ChunkType, const uint8_t*, uint32_t) {}};
  player.watch(&watch);
  Status status = Status::ok;
  for (TickResult result; status == Status::ok && !result.finished && !collector.full();) {
    status = player.skip_tick(result);
    if (status == Status::ok) collector.list.last = result.tick;
  }
  player.watch(nullptr);
  if (status != Status::ok) return problem_text(player.error(), input);
  if (!collector.full()) return "";
  return "has more than " + std::to_string(k_calls_max) + " calls, or " + std::to_string(k_records_bytes_max) +
         " bytes of calls";
}

}  // namespace

UnitKind CallList::kind_of(uint32_t unit) const {
  if (unit < first_joint()) return UnitKind::body;
  if (unit < first_call()) return UnitKind::joint;
  const RecordTag tag = static_cast<RecordTag>(*record(calls[unit - first_call()]));
  return tag == RecordTag::create_body    ? UnitKind::body
         : tag == RecordTag::create_joint ? UnitKind::joint
                                          : UnitKind::call;
}

Status save_seed(const World& world, CallList& list) {
  list.seed_bytes = snapshot_bytes(get_info(world).capacity);
  list.seed.resize((list.seed_bytes + 7) / 8);
  return save(world, reinterpret_cast<uint8_t*>(list.seed.data()), list.seed_bytes);
}

void read_calls(const Recorded& recorded, const Assets& assets, CallReading& reading) {
  const std::unique_ptr<Input> input = recorded.open(reading.problem);
  if (input == nullptr) return;
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(source_of(*input), buffer, sizeof buffer);
  Status status = player.open();
  reading.other_config = status == Status::config_differs;
  if (status == Status::ok) {
    const Status created = reading.world.create(player.info(), *input, assets);
    if (created != Status::ok) {
      reading.problem = created == Status::truncated ? "truncated: the file is too small for its seed snapshot"
                                                     : "not enough memory for its world";
      return;
    }
    status = player.start(reading.world.owned.world);
  }
  if (status != Status::ok) {
    reading.problem = problem_text(player.error(), *input);
    return;
  }
  const World& world = reading.world.owned.world;
  CallList& list = reading.list;
  status = save_seed(world, list);
  reading.capacity = player.info().capacity;
  list.first = list.last = player.info().tick;
  CallCollector collector{list};
  for (BodyId id = next_body(world, {}); !is_null(id); id = next_body(world, id)) {
    list.ids.bodies[id] = id;
    collector.ids->bodies.insert(id);
  }
  for (JointId id = next_joint(world, {}); !is_null(id); id = next_joint(world, id)) {
    list.ids.joints[id] = id;
    collector.ids->joints.insert(id);
  }
  reading.damage = status == Status::ok ? collect_calls(player, *input, collector) : status_text(status);
  list.records = collector.records;
  list.recorded = collector.ids;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
