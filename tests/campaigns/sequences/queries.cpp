#include "tests/campaigns/sequences/game.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A question of any kind: whom it finds may be found, in order, and the world stays.
void Game::query() {
  bool wrong = false, size_wrong = false;
  QueryHit hit[4];
  QueryReport report;
  QueryFilter filter;
  filter.mask = draw_.chance(0.5) ? ~0u : draw_.below(8);
  filter.ignore = pick();
  const QueryHits hits = {hit, 4};
  const Position from = draw_.place();
  const bool all = draw_.chance(0.5);
  const QueryKind kind = static_cast<QueryKind>(draw_.below(5));
  const bool shaped = kind == QueryKind::cast || kind == QueryKind::overlap || kind == QueryKind::closest;
  const Shape shape = shaped ? draw_.asked_shape(size_wrong) : Shape();
  const Quat turned = shaped ? draw_.rotation(wrong) : Quat{0.0, 0.0, 0.0, 1.0};
  wrong = wrong || shape.type == ShapeType::half_space || shape.type == ShapeType::terrain ||
          shape.type == ShapeType::compound || lacks_asset(shape);
  Status status = Status::ok;
  switch (kind) {
    case QueryKind::ray:
      status = recorder_->query_ray({from, draw_.vector(8, wrong), filter, all}, hits, report);
      break;
    case QueryKind::cast: {
      const Vec3<Real> displacement = draw_.vector(8, wrong), rotation_vector = draw_.vector(3, wrong);
      status = recorder_->query_cast({shape, from, turned, displacement, rotation_vector, filter, all}, hits, report);
      break;
    }
    case QueryKind::overlap:
      status = recorder_->query_overlap({shape, from, turned, filter, all}, hits, report);
      break;
    case QueryKind::bounds: {
      const Position to = draw_.place();
      wrong = !(from.x <= to.x && from.y <= to.y && from.z <= to.z);
      status = recorder_->query_bounds({from, to, filter, all}, hits, report);
      break;
    }
    default: {
      const Real distance_max = draw_.number(0, 8, wrong);
      status = recorder_->query_closest({shape, from, turned, distance_max, filter, all}, hits, report);
      break;
    }
  }
  expect_unchanged();
  note(static_cast<uint64_t>(status));
  if (wrong) {
    EXPECT_NE(status, Status::ok);
  } else if (!size_wrong && !(draw_.wide() && status == Status::out_of_range)) {
    EXPECT_OK(status);
  }
  if (status == Status::ok) check_hits(hits, report, filter, all, kind);
}

void Game::check_hits(QueryHits hits, const QueryReport& report, const QueryFilter& filter, bool all, QueryKind kind) {
  const bool sorted = kind != QueryKind::overlap && kind != QueryKind::bounds;  // by fraction and distance, not by slot
  note(report.digest);
  ASSERT_LE(report.hits, all ? hits.capacity : 1u);
  EXPECT_LE(report.hits + report.dropped, model_.bodies.size());
  for (uint32_t i = 0; i < report.hits; ++i) {
    const QueryHit& hit = hits.data[i];
    const Known* body = model_.find(hit.body);
    ASSERT_NE(body, nullptr);
    EXPECT_TRUE((body->filter.category & filter.mask) != 0 && (body->filter.mask & filter.category) != 0);
    EXPECT_FALSE(body->sensor || hit.body == filter.ignore);
    const bool names_triangle = body->shape.type == ShapeType::terrain && kind != QueryKind::bounds;
    EXPECT_TRUE((hit.triangle != UINT32_MAX) == names_triangle || hit.undecided);
    note(hit.body);
    note(uint64_t{hit.triangle});
    if (i == 0) continue;
    const QueryHit& last = hits.data[i - 1];
    EXPECT_TRUE(sorted ? !(hit.fraction < last.fraction) && !(hit.distance < last.distance)
                       : last.body.slot < hit.body.slot);
  }
}

/// A mover goes its way, and the world stays.
void Game::move_character() {
  bool wrong = false;
  if (draw_.chance(0.2)) {
    mover_ = {};
    mover_.position = draw_.place();
  }
  MoverSettings settings;
  settings.filter.mask = draw_.chance(0.7) ? ~0u : draw_.below(8);
  settings.filter.ignore = pick();
  MoverReport report;
  const Vec3<Real> displacement = draw_.vector(0.5, wrong);
  uint8_t before[k_mover_bytes], after[k_mover_bytes];
  save_mover(mover_, before);
  const Status status = move_mover(world(), settings, displacement, mover_, report);
  save_mover(mover_, after);
  judge("move_mover", status, true, wrong);
  expect_unchanged();
  if (status != Status::ok) {
    EXPECT_EQ(memcmp(before, after, sizeof before), 0);
    return;
  }
  EXPECT_EQ(report.on_ground, !(mover_.ground == BodyId{}));
  ASSERT_LE(report.contact_count, k_mover_contacts_max);
  for (uint32_t i = 0; i < report.contact_count; ++i) {
    const Known* body = model_.find(report.contacts[i].body);
    ASSERT_NE(body, nullptr);
    EXPECT_NE(body->filter.category & settings.filter.mask, 0u);
    EXPECT_FALSE(body->sensor || report.contacts[i].body == settings.filter.ignore);
    note(report.contacts[i].body);
    note(report.contacts[i].impulse);
  }
  note(digest_bytes(after, sizeof after, 0));
  note(uint64_t{report.queries});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
