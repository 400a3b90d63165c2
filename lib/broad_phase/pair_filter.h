#pragma once
#include <detent/body.h>
#include <detent/detail/state.h>

#include "base/span.h"
#include "broad_phase/pair_key.h"
#include "shape/body.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The mask test of Filter and of QueryFilter: whether the category of each of the two shares a bit with the mask of
/// the other.
constexpr bool masks_meet(uint32_t category_a, uint32_t mask_a, uint32_t category_b, uint32_t mask_b) {
  return (category_a & mask_b) != 0 && (category_b & mask_a) != 0;
}

/// Whether the body's own filter keeps it from touching or sensing any other body.
inline bool is_non_colliding(const BodyProperties& properties) {
  return properties.group <= 0 && (properties.category == 0 || properties.mask == 0);
}

inline bool has_rule(const FilterRuleTable& table, uint32_t rule) {
  return rule == 0 || (rule <= table.count && table.rules[rule - 1] != nullptr);
}

/// Decides by filters, filter rules and joints whether two bodies may touch. Sensors never touch. All code that finds
/// pairs uses this test.
struct PairFilter {
  Span<const BodyProperties> properties;
  FilterRuleTable rules;
  Span<const uint64_t> disabled_pairs = {};  ///< pairs whose collision is disabled by joints, ascending

  bool allows(uint32_t slot_a, uint32_t slot_b) const {
    return (properties[slot_a].sensor | properties[slot_b].sensor) == 0 && lets_through(slot_a, slot_b);
  }
  /// Whether filters and joints allow the two bodies to interact. One of them may be a sensor.
  bool lets_through(uint32_t slot_a, uint32_t slot_b) const {
    const BodyProperties &a = properties[slot_a], &b = properties[slot_b];
    const bool grouped = a.group != 0 && a.group == b.group;
    if (grouped ? a.group < 0 : !masks_meet(a.category, a.mask, b.category, b.mask)) return false;
    if (disabled_pairs.count != 0 && has_pair(disabled_pairs, key_of_pair(slot_a, slot_b))) return false;
    return (a.rule | b.rule) == 0 || (rule_allows(a, b) && rule_allows(b, a));
  }

 private:
  /// Whether the filter rule of `own` allows the other body. A rule number that is not in the table allows all bodies;
  /// create_body(), set_filter() and load() reject such numbers.
  bool rule_allows(const BodyProperties& own, const BodyProperties& other) const {
    if (own.rule == 0 || !has_rule(rules, own.rule)) return true;
    return rules.rules[own.rule - 1]({own.user_data, filter_of(own)}, {other.user_data, filter_of(other)});
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
