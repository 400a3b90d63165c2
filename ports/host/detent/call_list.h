#pragma once
#include <map>
#include <set>

#include "reading.h"
#include "recorded.h"

/// The calls of a recording as a list, of which any part can be played (call_player.h).
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The bodies and joints that a recording names, as their ids in the recording, and each one's id in another world.
struct IdMap {
  std::map<BodyId, BodyId> bodies;
  std::map<JointId, JointId> joints;
};

/// The bodies and joints that a recording has at any time.
struct RecordedIds {
  std::set<BodyId> bodies;
  std::set<JointId> joints;
};

/// A call, as the record that a ReplayWatch gets.
struct ListedCall {
  uint64_t tick = 0;  ///< ticks completed before the call
  size_t at = 0;      ///< into CallList::records
  uint32_t count = 0;
};

enum class UnitKind : uint32_t { body, joint, call };

/// What happens after a state: calls and ticks. Its units, which can be left out, are numbered: the bodies of the
/// state, its joints, then the calls. A call that creates a body or joint is a unit of that kind. Queries change
/// nothing: they are not in the list.
struct CallList {
  std::vector<uint64_t> seed;  ///< the state: a snapshot
  uint32_t seed_bytes = 0;
  uint64_t first = 0, last = 0;  ///< ticks completed at the start and at the end
  IdMap ids;                     ///< of the state's bodies and joints, in the snapshot
  std::vector<ListedCall> calls;
  std::shared_ptr<const std::vector<uint8_t>> records;
  std::shared_ptr<const RecordedIds> recorded;

  uint32_t first_joint() const { return static_cast<uint32_t>(ids.bodies.size()); }
  uint32_t first_call() const { return first_joint() + static_cast<uint32_t>(ids.joints.size()); }
  uint32_t unit_count() const { return first_call() + static_cast<uint32_t>(calls.size()); }
  const uint8_t* record(const ListedCall& call) const { return records->data() + call.at; }
  UnitKind kind_of(uint32_t unit) const;
};

/// Saves the world as the list's state.
Status save_seed(const World& world, CallList& list);

struct CallReading {
  std::string problem;        ///< there is no list; empty: none
  std::string damage;         ///< why the list ends before the recording does; empty: it does not
  bool other_config = false;  ///< the problem is another configuration
  Capacity capacity = {};
  CallList list;
  ReplayWorld world;  ///< for the list
};
/// Reads a recording, up to its end or its first damage.
void read_calls(const detent_tool::Recorded& recorded, const detent_tool::Assets& assets, CallReading& reading);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
