#include "tests/tool/shrink/match.h"

/// What `detent shrink` leaves of calls: those that are refused, those that other machines answer differently, and
/// those whose bodies get other ids.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_TEST(shrink, a_refused_call_is_left_with_its_body) {
  Match match;
  match.add_bystanders(12);
  const BodyId first = match.add({0.0, 0.0, 0.0});
  match.begin();
  match.step(3);
  EXPECT_OK(match.recorder->destroy_body(first));
  const BodyId second = match.add({0.0, 0.0, 0.0});  // in the slot of the first
  EXPECT_EQ(second.generation, 2u);
  match.step(3);
  const std::string path = match.end_with(record_of(SetMass{second, Scaled(-1.0)}));
  const ShrinkResult result = shrink_of(path, FaultKind::status);
  expect_sound(result, FaultKind::status);
  EXPECT_EQ(result.shrunk.fault, "the call set_mass is refused: out of range");
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{0, 1, 0, 1}));
  EXPECT_EQ(result.shrunk.tick, 6u);
}

DETENT_TEST(shrink, a_call_that_only_a_candidate_refuses_is_not_the_fault) {
  Match match;
  const BodyId heavy = match.add({0.0, 0.0, 0.0});
  match.begin();
  EXPECT_OK(match.recorder->set_mass(heavy, Scaled(1e12)));
  // Without the call before it is out of range, as the refused call is here.
  EXPECT_OK(match.recorder->apply_impulse(heavy, {Scaled(1e9), Scaled(0.0), Scaled(0.0)}));
  match.step(2);
  const std::string path = match.end_with(record_of(SetInertia{heavy, {Scaled(50.0), Scaled(50.0), Scaled(50.0)}}));
  const ShrinkResult result = shrink_of(path, FaultKind::status, {.lead_ticks = 100});
  expect_sound(result, FaultKind::status, {.lead_ticks = 100});
  EXPECT_EQ(result.shrunk.fault, "the call set_inertia is refused: out of range");
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{2, 1, 0, 2}));
}

DETENT_TEST(shrink, a_call_that_is_refused_for_another_reason_is_not_the_fault) {
  Match match;
  const BodyId body = match.add({0.0, 0.0, 0.0}, BodyType::fixed);
  match.begin();
  EXPECT_OK(match.recorder->set_type(body, BodyType::dynamic));  // without this call it is a bad argument
  match.step(2);
  const std::string path = match.end_with(record_of(ApplyImpulse{body, {Scaled(1e20), Scaled(0.0), Scaled(0.0)}}));
  const ShrinkResult result = shrink_of(path, FaultKind::status, {.lead_ticks = 100});
  expect_sound(result, FaultKind::status, {.lead_ticks = 100});
  EXPECT_EQ(result.shrunk.fault, "the call apply_impulse is refused: out of range");
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{2, 1, 0, 2}));
  EXPECT_EQ(shrink_of(path, FaultKind::status, {.reading = {.path = "", .from = 3}}).outcome.problem,
            "shows no call that is refused up to tick 2");
}

DETENT_TEST(shrink, a_refused_call_stays_the_same_call) {
  Match match({3, 8, 0, true, 2, 0});
  const BodyId a = match.add({0.0, 0.0, 0.0});
  const BodyId b = match.add({5.0, 0.0, 0.0});
  match.begin();
  match.step(2);
  EXPECT_OK(match.recorder->destroy_body(b));
  match.step(2);
  EXPECT_OK(match.recorder->set_user_data(a, 1));
  // It is of no body any more. Without the body's creation the call would be refused, too.
  const std::string path = match.end_with(record_of(WakeBody{b}));
  const ShrinkResult result = shrink_of(path, FaultKind::status);
  expect_sound(result, FaultKind::status);
  EXPECT_EQ(result.shrunk.fault, "the call wake_body is refused: no such id");
  EXPECT_EQ(result.shrunk.after.calls, 1u);
}

/// A recording of which the digest of one tick is wrong.
std::string other_digest(uint32_t interval, uint64_t wrong_tick) {
  Match match;
  match.add_bystanders(10);
  const BodyId a = match.add({0.0, 0.0, 0.0});
  match.begin({.digest_interval = interval});
  Recorder unrecorded(match.owned.world, {}, nullptr, 0);
  for (uint64_t tick = 0; tick < 40; ++tick) {
    const SetUserData call = {a, static_cast<uint32_t>(tick)};
    const std::vector<uint8_t> record = record_of(call);
    match.bytes.add(record.data(), static_cast<uint32_t>(record.size()), tick);
    EXPECT_OK(unrecorded.set_user_data(a, call.value));
    unrecorded.step();
    const uint64_t digest_here = digest(match.owned.world) ^ (tick + 1 == wrong_tick ? 1 : 0);
    match.bytes.add_tick(tick, is_due(interval, tick + 1) ? &digest_here : nullptr);
  }
  match.bytes.end(40, {40, digest(match.owned.world) ^ (wrong_tick == 41 ? 1 : 0)});
  return match.write();
}

DETENT_TEST(shrink, a_recording_that_does_not_verify_leaves_the_ticks_that_differ) {
  const ShrinkResult result = shrink_of(other_digest(1, 17), FaultKind::differs);
  expect_sound(result, FaultKind::differs);
  EXPECT_EQ(result.shrunk.tick, 17u);
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{1, 11, 0, 1}));
  EXPECT_EQ(result.shrunk.before.ticks, 17u);
  EXPECT_EQ(result.shrunk.replays, 2u);
  const ShrinkResult sparse = shrink_of(other_digest(10, 30), FaultKind::differs);
  expect_sound(sparse, FaultKind::differs);
  EXPECT_EQ(sparse.sizes(), (std::vector<uint64_t>{10, 11, 0, 10}));
  const ShrinkResult final_one = shrink_of(other_digest(0, 41), FaultKind::differs);
  expect_sound(final_one, FaultKind::differs);
  EXPECT_EQ(final_one.sizes(), (std::vector<uint64_t>{40, 11, 0, 40}));
  EXPECT_EQ(shrink_of(other_digest(1, 50), FaultKind::differs).outcome.problem,
            "verifies; no tick differs up to tick 40");
}

/// Bodies that come and go: what is left gets other ids than in the recording.
DETENT_TEST(shrink, calls_follow_their_bodies_to_other_ids) {
  Match match;
  match.begin();
  const BodyId gone = match.add({50.0, 0.0, 0.0});
  const BodyId other = match.add({60.0, 0.0, 0.0});
  match.step(1);
  EXPECT_OK(match.recorder->destroy_body(gone));
  const BodyId a = match.add({0.0, 0.0, 0.0});
  EXPECT_EQ(a, (BodyId{1, 2}));
  const BodyId b = match.add({5.0, 0.0, 0.0});
  const JointId loose = match.join(a, other, {30.0, 0.0, 0.0});
  match.step(1);
  EXPECT_OK(match.recorder->destroy_joint(loose));
  const JointId joint = match.join(a, b, {2.5, 0.0, 0.0});
  EXPECT_EQ(joint, (JointId{1, 2}));
  match.step(1);
  match.move(b, {9.0, 0.0, 0.0});
  match.step(3);
  // From the start of the match on, so that all is made by calls.
  const std::string path = match.end();
  const ShrinkResult result = shrink_of(path, FaultKind::opens, {.lead_ticks = 100});
  expect_sound(result, FaultKind::opens, {.lead_ticks = 100});
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{4, 2, 1, 4}));
  EXPECT_EQ(result.shrunk.fault.substr(0, 29), "joint 1 of body 1 and body 2 ");
  const ShrinkResult of_body = shrink_of(path, FaultKind::opens, {.body = b.slot, .lead_ticks = 100});
  EXPECT_EQ(b.slot, 3u);
  EXPECT_EQ(of_body.outcome.problem, "");
  EXPECT_EQ(of_body.sizes(), result.sizes());
  EXPECT_FALSE(shrink_of(path, FaultKind::opens, {.body = other.slot}).good());
}

DETENT_TEST(shrink, calls_follow_their_joints_to_other_ids) {
  Match match;
  match.begin();
  const BodyId a = match.add({0.0, 0.0, 0.0}), b = match.add({5.0, 0.0, 0.0}), other = match.add({10.0, 0.0, 0.0});
  const JointId loose = match.join(a, other, {30.0, 0.0, 0.0});
  match.step(1);
  EXPECT_OK(match.recorder->destroy_joint(loose));
  const JointId joint = match.join(a, b, {2.5, 0.0, 0.0});
  EXPECT_EQ(joint, (JointId{1, 2}));
  match.step(1);
  JointDef def;
  EXPECT_OK(get_joint(match.owned.world, joint, def));
  def.anchor_b = {9.0, 0.0, 0.0};
  EXPECT_OK(match.recorder->set_joint(joint, def));
  match.step(2);
  const ShrinkResult result = shrink_of(match.end(), FaultKind::opens, {.lead_ticks = 100});
  expect_sound(result, FaultKind::opens, {.lead_ticks = 100});
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{3, 2, 1, 4}));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
