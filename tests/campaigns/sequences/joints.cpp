#include <math.h>

#include "tests/campaigns/sequences/game.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

bool is_same(const JointAxis& a, const JointAxis& b) {
  return a.limited == b.limited && a.lower == b.lower && a.upper == b.upper && a.frequency == b.frequency &&
         a.damping_ratio == b.damping_ratio && a.target == b.target && a.speed == b.speed && a.force_max == b.force_max;
}

}  // namespace

/// A joint, or an id that names none.
JointId Game::pick_joint() {
  if (model_.joints.empty() || draw_.bad()) {
    if (!model_.joints_gone.empty() && draw_.chance(0.5))
      return model_.joints_gone[draw_.below(static_cast<uint32_t>(model_.joints_gone.size()))];
    if (draw_.chance(0.5)) return {};
    const uint32_t slot = draw_.below(12), generation = 1000 + draw_.below(3);
    return {slot, generation};
  }
  auto joint = model_.joints.begin();
  std::advance(joint, draw_.below(static_cast<uint32_t>(model_.joints.size())));
  return joint->second.first;
}

/// Whether a body is too far from a point for a joint there, or nearly.
bool Game::is_far(BodyId id, const Position& point) {
  Pose pose;
  EXPECT_OK(get_pose(world(), id, pose));
  const double x = coord_to_host(point.x) - coord_to_host(pose.position.x);
  const double y = coord_to_host(point.y) - coord_to_host(pose.position.y);
  const double z = coord_to_host(point.z) - coord_to_host(pose.position.z);
  return sqrt(x * x + y * y + z * z) > 4095;
}

/// Where its bodies are now.
void Game::place(JointDef& def, bool& wrong) {
  const Position point = draw_.place();
  bool frame_wrong = false;
  const Quat frame = draw_.rotation(frame_wrong);
  const Status status = place_joint(world(), point, frame, def);
  note(static_cast<uint64_t>(status));
  if (model_.find(def.a) == nullptr || model_.find(def.b) == nullptr) {
    EXPECT_EQ(status, Status::bad_id);
  } else if (frame_wrong) {
    EXPECT_EQ(status, Status::not_normalised);
  } else {
    EXPECT_TRUE(status == Status::ok || draw_.wide() || is_far(def.a, point) || is_far(def.b, point))
        << status_text(status);
  }
  if (status != Status::ok) draw_.joint_place(def, wrong);
}

void Game::create_joint_anyhow() {
  bool wrong = false;
  JointDef def = draw_.joint(wrong);
  def.a = pick();
  def.b = pick();
  if (draw_.chance(0.7)) {
    place(def, wrong);
  } else {
    draw_.joint_place(def, wrong);
  }
  const Known *a = model_.find(def.a), *b = model_.find(def.b);
  const bool there = a != nullptr && b != nullptr;
  if (there) wrong = wrong || def.a == def.b || (a->type != BodyType::dynamic && b->type != BodyType::dynamic);
  JointId id = {99, 99};
  const Status status = recorder_->create_joint(def, id);
  if (!wrong && there && status == Status::pool_full) {
    note(static_cast<uint64_t>(status));
    EXPECT_EQ(model_.joints.size(), capacity().joints);
  } else {
    judge("create_joint", status, there, wrong, true);
  }
  if (status != Status::ok) {
    expect_unchanged();
    EXPECT_TRUE((id == JointId{99, 99}));
    return;
  }
  EXPECT_EQ(model_.joints.count(id.slot), 0u);
  for (uint32_t slot = 1; slot < id.slot; ++slot) EXPECT_EQ(model_.joints.count(slot), 1u) << "the lowest free slot";
  model_.joints[id.slot] = {id, def};
}

void Game::change_joint() {
  const JointId id = pick_joint();
  JointDef* known = model_.find(id);
  if (draw_.chance(0.3)) {
    if (judge("destroy_joint", recorder_->destroy_joint(id), known != nullptr, false)) model_.forget(id);
    return;
  }
  bool wrong = false;
  JointDef def = draw_.joint(wrong);
  draw_.joint_place(def, wrong);
  if (!judge("set_joint", recorder_->set_joint(id, def), known != nullptr, wrong, true)) return;
  def.a = known->a;
  def.b = known->b;
  *known = def;
}

void Game::check_joints() {
  EXPECT_EQ(get_info(world()).joints, model_.joints.size());
  JointId id = next_joint(world(), {});
  for (const auto& [slot, joint] : model_.joints) {
    EXPECT_TRUE(joint.first == id) << "joints come in the order of their slots";
    JointDef def;
    ASSERT_OK(get_joint(world(), joint.first, def));
    const JointDef& known = joint.second;
    EXPECT_TRUE(def.type == known.type && def.a == known.a && def.b == known.b);
    EXPECT_TRUE(def.anchor_a == known.anchor_a && def.anchor_b == known.anchor_b);
    EXPECT_TRUE(is_same(def.axis, known.axis) && is_same(def.second, known.second));
    EXPECT_TRUE(def.collide == known.collide && def.user_data == known.user_data);
    EXPECT_TRUE(def.friction_force == known.friction_force && def.friction_torque == known.friction_torque);
    EXPECT_TRUE(def.break_force == known.break_force && def.break_torque == known.break_torque);
    JointReaction reaction;
    EXPECT_OK(get_joint_reaction(world(), joint.first, reaction));
    id = next_joint(world(), id);
  }
  EXPECT_TRUE(id == JointId{});
  for (const JointId gone : model_.joints_gone) EXPECT_FALSE(is_valid(world(), gone));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
