#include "tests/campaigns/sequences/game.h"

#include "tests/common/support/usable.h"
#include "tests/unit/shape/hull_bytes.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_calls = 40, k_segments = 3;

alignas(8) constexpr uint8_t k_no_asset[16] = {1, 2, 3};

}  // namespace

/// A mesh, a height field, two hulls, a compound, and what is none of these.
AssetTable Game::assets() {
  static const Asset table[k_assets] = {
      scene_assets().assets[k_asset_valley],   scene_assets().assets[k_asset_hills],
      scene_assets().assets[k_asset_round],    {detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron},
      scene_assets().assets[k_asset_dumbbell], {k_no_asset, sizeof k_no_asset}};
  return {table, k_assets};
}

/// One rule, which only the bodies' data decide.
FilterRuleTable Game::rules() {
  static constexpr FilterRule table[] = {may_meet};
  return {table, 1};
}

/// With room for all, for little, or for no sensors.
WorldDef Game::settings(Draw& draw) {
  WorldDef def;
  switch (draw.below(4)) {
    case 0:
      def.capacity = {k_bodies, 3, k_assets, false, 2, 1};
      break;
    case 1:
      def.capacity = {k_bodies, 24, k_assets, true, k_joints, 0};
      break;
    default:
      def.capacity = {k_bodies, 24, k_assets, true, k_joints, k_sensed};
      break;
  }
  return def;
}

Game::Game(const Draw& draw) : draw_(draw), settings_(settings(draw_)), owned_(settings_, assets()) {
  const uint32_t events = draw_.chance(0.2) ? 2 : k_events;
  world().hooks.joint_events = {broken_, k_joints};
  world().hooks.contact_events = {events_, events};
  world().hooks.sensor_events = {sensor_events_, events};
  world().hooks.body_events = {body_events_, events};
  world().hooks.capacity_events = {lost_, events};
  world().hooks.filter_rules = rules();
}

uint64_t Game::play() {
  for (uint32_t segment = 0; segment < k_segments && !failed() && !draw_.ended(); ++segment) {
    const Model before = model_;
    std::vector<uint64_t> snapshot = save_all();
    play_recorded();
    if (draw_.chance(0.3)) go_back(snapshot, before);
  }
  note(digest(world()));
  return digest_finish(heard_);
}

std::vector<uint64_t> Game::save_all() {
  std::vector<uint64_t> bytes(snapshot_bytes(capacity()) / 8);
  EXPECT_OK(save(world(), bytes_of(bytes), byte_count(bytes)));
  return bytes;
}

void Game::go_back(std::vector<uint64_t>& snapshot, const Model& before) {
  const bool quick = draw_.chance(0.5);
  EXPECT_OK(quick ? restore(world(), bytes_of(snapshot), byte_count(snapshot))
                  : load(world(), bytes_of(snapshot), byte_count(snapshot)));
  model_ = before;
  check_bodies();
  check_joints();
}

void Game::play_recorded() {
  MemorySink memory;
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder(world(), memory.sink(), buffer, sizeof buffer);
  RecordingDef recorded;
  recorded.digest_interval = draw_.below(4);
  EXPECT_OK(recorder.begin(recorded));
  recorder_ = &recorder;
  for (uint32_t i = 0; i < k_calls && !failed() && !draw_.ended(); ++i) {
    call();
    check_bodies();
    check_joints();
  }
  EXPECT_OK(recorder.end());
  recording_ = memory.bytes;
  replay_recorded();
}

void Game::replay_recorded() {
  MemorySource memory{&recording_};
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(memory.source(), buffer, sizeof buffer);
  player.repeat_queries();
  OwnedWorld other(settings_, assets());
  other.world.hooks.filter_rules = rules();
  ASSERT_OK(player.open());
  ASSERT_OK(player.start(other.world));
  TickResult result;
  while (!result.finished) {
    ASSERT_EQ(player.next_tick(other.world, result), Status::ok)
        << player.error().field << ": " << status_text(player.error().status);
  }
  EXPECT_EQ(result.digest, digest(world()));
  std::vector<uint64_t> saved = save_all();
  ASSERT_OK(load(other.world, bytes_of(saved), byte_count(saved)));
  EXPECT_EQ(digest(other.world), digest(world()));
  load_damaged(other.world);
}

/// What is refused changes nothing, and what is let in can be used. Which it is depends on the machine's byte order, so
/// nothing of it is noted.
void Game::load_damaged(World& other) {
  std::vector<uint64_t> bytes = save_all();
  for (uint32_t i = 1 + draw_.below(3); i != 0; --i) {
    const uint32_t at = draw_.below(byte_count(bytes));
    bytes_of(bytes)[at] = static_cast<uint8_t>(bytes_of(bytes)[at] ^ (1u << draw_.below(8)));
  }
  const uint64_t before = digest(other);
  if (load(other, bytes_of(bytes), byte_count(bytes)) != Status::ok) {
    EXPECT_EQ(digest(other), before);
    return;
  }
  expect_usable(other);
}

bool Game::judge(const char* name, Status status, bool there, bool wrong, bool may_fail) {
  note(static_cast<uint64_t>(status));
  const bool refused = status == Status::out_of_range || status == Status::bad_argument ||
                       status == Status::not_normalised || status == Status::asset_missing;
  if (!there) {  // the recorder looks at the arguments first
    EXPECT_TRUE(status == Status::bad_id || (wrong && refused)) << name << ": " << status_text(status);
  } else if (wrong) {
    EXPECT_TRUE(refused) << name << ": " << status_text(status);
  } else if (!((may_fail || draw_.wide()) && status == Status::out_of_range)) {
    EXPECT_STREQ(status_text(status), "ok") << name;
  }
  if (status != Status::ok) expect_unchanged();
  return status == Status::ok;
}

void Game::call() {
  before_ = digest(world());
  note(before_);
  const BodyId id = pick();
  const uint32_t which = draw_.below(16);
  switch (which) {
    case 0:
    case 1:
      return create();
    case 2:
      return draw_.chance(0.4) ? destroy(id) : change_world();
    case 3:
    case 4:
      return change(id, draw_.below(12));
    case 5:
      return move(id);
    case 6:
      return push(id);
    case 7:
      return create_joint_anyhow();
    case 8:
      return change_joint();
    case 9:
      return query();
    case 10:
      return move_character();
    case 11:
      read_sensor(id);
      read_triangles(id);
      return read(id);
    case 12:
      return bind();
    default:
      for (uint32_t ticks = 1 + draw_.below(4); ticks != 0 && !failed(); --ticks) step_once();
  }
}

void Game::change_world() {
  bool wrong = false;
  switch (draw_.below(3)) {
    case 0: {
      const Vec3<Real> gravity = draw_.vector(10, wrong);
      if (!judge("set_gravity", recorder_->set_gravity(gravity), true, wrong)) break;
      EXPECT_TRUE(get_settings(world()).gravity == gravity);
      break;
    }
    case 1: {
      Explosion explosion;
      explosion.centre = draw_.place();
      explosion.radius = draw_.number(0.5, 5, wrong);
      explosion.impulse = scaled(draw_.uniform(-10, 10));
      judge("explode", recorder_->explode(explosion), true, wrong, true);
      break;
    }
    default: {
      const WorldDef def = draw_.settings(get_settings(world()), wrong);
      if (!judge("set_settings", recorder_->set_settings(def), true, wrong)) break;
      const WorldDef now = get_settings(world());
      EXPECT_TRUE(now.tick == def.tick && now.gravity == def.gravity);
      EXPECT_TRUE(now.substeps == def.substeps && now.substeps_max == def.substeps_max &&
                  now.resting_penetration == def.resting_penetration);
      EXPECT_TRUE(now.iterations == def.iterations && now.convergence == def.convergence);
      EXPECT_TRUE(now.relaxation == def.relaxation && now.damping_ratio == def.damping_ratio);
      EXPECT_TRUE(now.contact_recycle_distance == (capacity().manifolds ? def.contact_recycle_distance : Real(0.0)) &&
                  now.stabilisation == def.stabilisation && now.reduction == def.reduction);
      EXPECT_TRUE(now.continuous == def.continuous && now.sleeping == def.sleeping);
      break;
    }
  }
}

void Game::bind() {
  const uint32_t index = draw_.below(k_assets + 1);
  if (judge("bind_asset", recorder_->bind_asset(index), true, index >= k_assets)) model_.bound |= 1u << index;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
