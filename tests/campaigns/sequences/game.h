#pragma once
#include <detent/contact.h>
#include <detent/mover.h>
#include <detent/query.h>
#include <detent/sensor.h>
#include <detent/world.h>
#include <string.h>

#include <type_traits>

#include "base/digest.h"
#include "examples/scenes/scene.h"
#include "tests/campaigns/sequences/draw.h"
#include "tests/campaigns/sequences/model.h"
#include "tests/unit/replay/match.h"

/// Random calls, good and bad, against a model of what their documentation says: statuses, what getters return, that a
/// call that fails changes nothing, that every state can be loaded, and that a recording of the calls replays.
namespace detent {
inline namespace DETENT_NAMESPACE {

enum class QueryKind : uint32_t { ray, cast, overlap, bounds, closest };

/// One sequence of calls.
class Game {
 public:
  explicit Game(const Draw& draw);
  /// Calls in segments: each is recorded, and replayed at its end; between them the world may go back. Returns a digest
  /// over the state before each call, and all statuses and answers.
  uint64_t play();

  /// What the last segment left.
  const Bytes& recording() const { return recording_; }
  std::vector<uint64_t> save_all();
  static AssetTable assets();
  static FilterRuleTable rules();
  const Capacity& capacity() const { return settings_.capacity; }

 private:
  static constexpr uint32_t k_bodies = 10, k_assets = 6, k_joints = 6, k_sensed = 6, k_events = 12;
  static WorldDef settings(Draw& draw);
  static bool failed() { return testing::Test::HasFailure(); }
  World& world() { return owned_.world; }

  // game.cpp: a segment, its replay, a call.
  void play_recorded();
  void replay_recorded();
  void load_damaged(World& other);
  void go_back(std::vector<uint64_t>& snapshot, const Model& before);
  void call();
  void change_world();
  void bind();
  /// Judges a call: an id that names nothing gives bad_id; `wrong` arguments give no ok; `may_fail` says that a right
  /// one may be refused as out_of_range. True if it was made.
  bool judge(const char* name, Status status, bool there, bool wrong, bool may_fail = false);
  void expect_unchanged() { EXPECT_EQ(digest(world()), before_); }

  // bodies.cpp
  BodyId pick();
  bool lacks_asset(const Shape& shape) const;
  void create();
  void destroy(BodyId id);
  void change(BodyId id, uint32_t which);
  void change_shape(BodyId id);
  void change_filter(BodyId id);
  void move(BodyId id);
  void push(BodyId id);
  void read(BodyId id);
  void read_parts(BodyId id, const Known& body);
  void read_triangles(BodyId id);
  void read_sensor(BodyId id);
  void check(BodyId id, const Known& known);
  void check_bodies();

  // joints.cpp
  JointId pick_joint();
  void create_joint_anyhow();
  bool is_far(BodyId id, const Position& point);
  void place(JointDef& def, bool& wrong);
  void change_joint();
  void check_joints();

  // steps.cpp
  void step_once();
  void check_broken(uint32_t count);
  void check_contacts(bool woken_late);
  void check_events(const StepReport& report);
  void check_sensors(const StepReport& report);
  void check_lost(const StepReport& report);
  bool may_touch(BodyId a, BodyId b);

  // queries.cpp
  void query();
  void check_hits(QueryHits hits, const QueryReport& report, const QueryFilter& filter, bool all, QueryKind kind);
  void move_character();

  // What becomes part of the sequence's digest.
  void note(uint64_t word) { heard_ = digest_step(heard_, word); }
  template <class Number>  // Real or Scaled, which are one type in f32 and f64
  void note_number(Number value) {
    double host;
    if constexpr (std::is_same_v<Number, Real>) {
      host = real_to_host(value);
    } else {
      host = scaled_to_host(value);
    }
    uint64_t bits;
    memcpy(&bits, &host, sizeof bits);
    note(bits);
  }
  template <class Number>
  void note(const Vec3<Number>& value) {
    note_number(value.x);
    note_number(value.y);
    note_number(value.z);
  }
  void note(BodyId id) { note(uint64_t{id.slot} << 32 | id.generation); }

  Draw draw_;
  const WorldDef settings_;
  OwnedWorld owned_;
  Recorder* recorder_ = nullptr;
  Bytes recording_;
  Model model_;
  Mover mover_;
  uint64_t before_ = 0;  ///< the world's digest before the call
  uint64_t heard_ = 0;
  JointEvent broken_[k_joints];
  CapacityEvent lost_[k_events];
  ContactEvent events_[k_events];
  SensorEvent sensor_events_[k_events];
  BodyEvent body_events_[k_events];
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
