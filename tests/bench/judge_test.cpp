#include "tests/bench/judge.h"

#include <gtest/gtest.h>

#include "tests/common/queries/solids.h"

namespace detent_bench {

namespace {

using detent_queries::Query;

/// Two unit spheres, 3 m apart; B comes towards A and passes its centre `beside` m off. Their size is 2.
Query spheres(double beside) {
  Query query;
  query.a = query.b = detent_queries::sphere(1);
  query.path_b.position = {5, beside, 0};
  query.path_b.displacement = {-8, 0, 0};
  return query;
}

constexpr double k_touch = 0.375;  // of spheres(0): the centres are 2 m apart

Truth head_on() {
  Truth truth;
  truth.size = 2;
  truth.start_gap = 3;
  truth.hit = true;
  truth.time = k_touch;
  truth.gap_min = -2;
  return truth;
}

Truth clear(double gap) {
  Truth truth;
  truth.size = 2;
  truth.start_gap = 3;
  truth.gap_min = gap;
  return truth;
}

Engine engine(const char* method, const char* config) { return {Task::toi, method, config, 0, 0, nullptr}; }

/// The row of one engine that gave one answer to one query.
Row row_of(const Query& query, const Truth& truth, const Answer& answer) {
  const EngineList engines = {engine("any", "any")};
  const std::vector<Query> queries = {query};
  const std::vector<Truth> truths = {truth};
  Measured measured;
  measured.asked = true;
  measured.answer = answer;
  measured.ns = 1;
  const Findings findings = {"x", &engines, {&queries}, {&truths}, {{measured}}};
  const std::vector<Row> rows = rows_of(findings, Part::all);
  EXPECT_EQ(rows.size(), 1u);
  return rows.front();
}

Answer hit_at(double time) {
  Answer answer;
  answer.outcome = Outcome::hit;
  answer.time = time;
  return answer;
}

Answer no_hit(Outcome outcome) {
  Answer answer;
  answer.outcome = outcome;
  return answer;
}

}  // namespace

TEST(judge, a_hit_in_time_is_right) {
  const Row row = row_of(spheres(0), head_on(), hit_at(k_touch));
  EXPECT_EQ(row.hits, 1u);
  EXPECT_EQ(row.fn + row.fp + row.undecided, 0u);
  EXPECT_EQ(row.late_max, 0);
  EXPECT_LT(row.early_max, 1e-12);
}

TEST(judge, an_early_hit_has_its_gap_in_units_of_size) {
  const Row row = row_of(spheres(0), head_on(), hit_at(k_touch - 0.001));
  EXPECT_EQ(row.fn + row.fp, 0u);
  EXPECT_NEAR(row.early_max, 0.004, 1e-9);
  EXPECT_NEAR(row.early_p99, 0.004, 1e-9);
  EXPECT_EQ(row.late_max, 0);
}

TEST(judge, a_late_hit_has_its_depth_in_units_of_size) {
  const Row row = row_of(spheres(0), head_on(), hit_at(k_touch + 0.001));
  EXPECT_EQ(row.fn + row.fp, 0u);
  EXPECT_NEAR(row.late_max, 0.004, 1e-4);
}

TEST(judge, a_hit_reported_after_they_have_passed_is_late_and_not_early) {
  const Row row = row_of(spheres(0), head_on(), hit_at(1));  // the centres are 3 m apart again
  EXPECT_GT(row.late_max, 0.9);
  EXPECT_EQ(row.early_max, 0);
}

TEST(judge, overlap_at_the_start_is_not_late) {
  Query query = spheres(0);
  query.path_b.position = {1.5, 0, 0};
  Truth truth = head_on();
  truth.start_gap = -0.5;
  truth.time = 0;
  EXPECT_EQ(row_of(query, truth, hit_at(0)).late_max, 0);
  EXPECT_GT(row_of(query, truth, hit_at(0.01)).late_max, 0);
}

TEST(judge, a_hit_called_clear_or_undecided_is_a_false_negative) {
  for (const Outcome outcome : {Outcome::clear, Outcome::undecided}) {
    const Row row = row_of(spheres(0), head_on(), no_hit(outcome));
    EXPECT_EQ(row.fn, 1u);
    EXPECT_EQ(row.fn_deep, 1u);
    EXPECT_EQ(row.fp, 0u);
    EXPECT_EQ(row.undecided, outcome == Outcome::undecided ? 1u : 0u);
  }
  Truth shallow = head_on();
  shallow.gap_min = -0.001;
  EXPECT_EQ(row_of(spheres(0), shallow, no_hit(Outcome::clear)).fn_deep, 0u);
}

TEST(judge, a_hit_beyond_the_tolerance_or_undecided_is_a_false_positive_where_the_truth_is_clear) {
  const double within = 1e-6, beyond = 1e-5;  // m, of a size of 2
  EXPECT_EQ(row_of(spheres(2 + beyond), clear(beyond), hit_at(0.625)).fp, 1u);
  EXPECT_EQ(row_of(spheres(2 + beyond), clear(beyond), no_hit(Outcome::undecided)).fp, 1u);
  EXPECT_EQ(row_of(spheres(2 + beyond), clear(beyond), no_hit(Outcome::clear)).fp, 0u);
  const Row row = row_of(spheres(2 + within), clear(within), hit_at(0.625));
  EXPECT_EQ(row.fp, 0u);
  EXPECT_NEAR(row.early_max, within / 2, 1e-9);
}

TEST(judge, an_error_of_distance_is_in_units_of_size) {
  const EngineList engines = {{Task::distance, "any", "any", 0, 0, nullptr}};
  const std::vector<Query> queries = {spheres(0)};
  const std::vector<Truth> truths = {head_on()};
  Measured measured;
  measured.asked = true;
  measured.answer.distance = 3.5;
  const Findings findings = {"x", &engines, {&queries}, {&truths}, {{measured}}};
  EXPECT_DOUBLE_EQ(rows_of(findings, Part::all).front().error_max, 0.25);
}

TEST(judge, times_are_compared_over_the_queries_that_both_answered) {
  const EngineList engines = {engine("default", "any"), engine("any", "any"),
                              engine("btSubsimplexConvexCast", "bullet-double")};
  const std::vector<Query> queries(3, spheres(0));
  const std::vector<Truth> truths(3, head_on());
  const auto measured = [](bool asked, double ns) { return Measured{asked, hit_at(k_touch), ns}; };
  const Findings findings = {"x",
                             &engines,
                             {&queries, &queries, &queries},
                             {&truths, &truths, &truths},
                             {{measured(true, 1), measured(true, 1), measured(false, 0)},
                              {measured(true, 1), measured(true, 3), measured(true, 100)},
                              {measured(true, 4), measured(true, 4), measured(false, 0)}}};
  const std::vector<Row> rows = rows_of(findings, Part::all);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].queries, 3u);
  EXPECT_EQ(rows[2].queries, 2u);
  EXPECT_DOUBLE_EQ(rows[1].ratio_mean, 0.5);
  EXPECT_DOUBLE_EQ(rows[1].ratio_p99, 0.75);
  EXPECT_DOUBLE_EQ(rows[1].ns_max, 100);
}

namespace {

/// A query that turns or not, of polytopes or not.
Query query_of(bool turns, bool polytopes) {
  Query query = spheres(0);
  if (polytopes) query.a = query.b = detent_queries::box({1, 1, 1});
  if (turns) query.path_a.rotation_vector = {0, 0, 1};
  return query;
}

const std::vector<Query> k_four = {query_of(true, false), query_of(true, true), query_of(false, false),
                                   query_of(false, true)};

/// The rows of engines that have an answer to these of the queries.
std::vector<Row> rows_of(const EngineList& engines, const std::vector<Query>& queries,
                         const std::vector<std::vector<bool>>& asked, Part part) {
  const std::vector<Truth> truths(queries.size(), head_on());
  Findings findings;
  findings.set = "x";
  findings.engines = &engines;
  for (const std::vector<bool>& of_engine : asked) {
    findings.queries.push_back(&queries);
    findings.truths.push_back(&truths);
    findings.measured.emplace_back();
    for (const bool one : of_engine) findings.measured.back().push_back({one, hit_at(k_touch), 1});
  }
  return rows_of(findings, part);
}

/// "method queries" of each row.
std::vector<std::string> summary(const std::vector<Row>& rows) {
  std::vector<std::string> lines;
  for (const Row& row : rows) lines.push_back(row.method + " " + std::to_string(row.queries));
  return lines;
}

using Lines = std::vector<std::string>;

}  // namespace

TEST(judge, the_parts_of_a_mixed_set_hold_their_queries_alone) {
  const std::vector<std::pair<const char*, uint32_t>> expected = {
      {"x", 4}, {"x rotating", 2}, {"x linear", 2}, {"x rotating polytopes", 1}, {"x linear polytopes", 1}};
  size_t i = 0;
  for (const Part part : k_parts) {
    const std::vector<Row> rows = rows_of({engine("default", "any")}, k_four, {{true, true, true, true}}, part);
    ASSERT_EQ(rows.size(), 1u) << i;
    EXPECT_EQ(rows[0].set, expected[i].first);
    EXPECT_EQ(rows[0].queries, expected[i].second);
    ++i;
  }
}

TEST(judge, a_part_that_is_the_whole_of_what_it_is_part_of_has_no_rows) {
  const auto parts_of = [](const std::vector<Query>& queries) {
    Lines names;
    for (const Part part : k_parts) {
      for (const Row& row : rows_of({engine("default", "any")}, queries, {{true, true}}, part))
        names.push_back(row.set);
    }
    return names;
  };
  EXPECT_EQ(parts_of({query_of(true, true), query_of(true, true)}), (Lines{"x"}));
  EXPECT_EQ(parts_of({query_of(true, true), query_of(false, true)}), (Lines{"x", "x rotating", "x linear"}));
  EXPECT_EQ(parts_of({query_of(false, false), query_of(false, false)}), (Lines{"x"}));
  EXPECT_EQ(parts_of({query_of(false, true), query_of(false, false)}), (Lines{"x", "x linear polytopes"}));
}

TEST(judge, an_engine_has_rows_where_it_answers_what_the_default_does) {
  const EngineList engines = {engine("default", "fx64"), engine("polytopes", "fx64"), engine("cast", "peer")};
  const std::vector<std::vector<bool>> asked = {
      {true, true, true, true}, {false, true, false, true}, {false, false, true, true}};
  EXPECT_EQ(summary(rows_of(engines, k_four, asked, Part::all)), (Lines{"default 4"}));
  EXPECT_EQ(summary(rows_of(engines, k_four, asked, Part::rotating)), (Lines{"default 2"}));
  EXPECT_EQ(summary(rows_of(engines, k_four, asked, Part::linear)), (Lines{"default 2", "cast 2"}));
  EXPECT_EQ(summary(rows_of(engines, k_four, asked, Part::rotating_polytopes)), (Lines{"default 1", "polytopes 1"}));
  EXPECT_EQ(summary(rows_of(engines, k_four, asked, Part::linear_polytopes)),
            (Lines{"default 1", "polytopes 1", "cast 1"}));
}

TEST(judge, what_the_default_of_any_configuration_answers_is_asked_of_all) {
  const EngineList engines = {engine("default", "fx32"), engine("default", "fx64"), engine("peer", "peer"),
                              engine("far peer", "peer")};
  const std::vector<std::vector<bool>> asked = {
      {false, false, false, true}, {false, true, true, true}, {true, true, true, true}, {true, true, true, false}};
  EXPECT_EQ(summary(rows_of(engines, k_four, asked, Part::all)), (Lines{"default 3", "peer 4"}));
}

TEST(judge, without_the_default_what_any_engine_answers_is_asked_of_all) {
  const EngineList engines = {engine("polytopes", "fx64"), engine("peer", "peer")};
  const std::vector<std::vector<bool>> asked = {{false, true, false, true}, {true, true, true, false}};
  EXPECT_EQ(summary(rows_of(engines, k_four, asked, Part::all)), (Lines{}));
  EXPECT_EQ(summary(rows_of(engines, k_four, asked, Part::rotating)), (Lines{"peer 2"}));
  EXPECT_EQ(summary(rows_of({engines[0]}, k_four, {asked[0]}, Part::all)), (Lines{"polytopes 2"}));
}

}  // namespace detent_bench
