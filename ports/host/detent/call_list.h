#pragma once
#include <map>
#include <set>

#include "reading.h"
#include "recorded.h"

/// The calls of a recording as a list. Any part of the list can be played (call_player.h).
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Maps the ids of bodies and joints in a recording to their ids in another world.
struct IdMap {
  std::map<BodyId, BodyId> bodies;
  std::map<JointId, JointId> joints;
};

/// The ids of all bodies and joints that exist in a recording at some time.
struct RecordedIds {
  std::set<BodyId> bodies;
  std::set<JointId> joints;
};

/// A call. Its bytes are a record as passed to ReplayWatch::called.
struct ListedCall {
  uint64_t tick = 0;  ///< ticks completed before the call
  size_t at = 0;      ///< index of the first byte in CallList::records
  uint32_t count = 0;
};

enum class UnitKind : uint32_t { body, joint, call };

/// A state, and the calls and ticks that follow it. The list consists of units that can be left out. They are numbered:
/// first the bodies of the state, then its joints, then the calls. A call that creates a body or joint counts as a unit
/// of that kind (kind_of()). Queries are not in the list, because they change nothing.
struct CallList {
  std::vector<uint64_t> seed;  ///< the state: a snapshot
  uint32_t seed_bytes = 0;
  uint64_t first = 0, last = 0;  ///< ticks completed at the start and at the end
  IdMap ids;                     ///< from the recording to the snapshot, for the state's bodies and joints
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
  std::string problem;        ///< why there is no list; empty: there is one
  std::string damage;         ///< why the list ends before the recording does; empty: it does not
  bool other_config = false;  ///< the problem is another configuration
  Capacity capacity = {};
  CallList list;
  ReplayWorld world;  ///< a world in which the list can be played
};
/// Reads a recording up to its end or to its first damage.
void read_calls(const detent_tool::Recorded& recorded, const detent_tool::Assets& assets, CallReading& reading);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
