#pragma once
#include <detent/detail/state.h>
#include <detent/filter.h>

#include "base/span.h"
#include "broad_phase/pair_key.h"
#include "shape/body.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Of Filter and of QueryFilter.
constexpr bool masks_meet(uint32_t category_a, uint32_t mask_a, uint32_t category_b, uint32_t mask_b) {
  return (category_a & mask_b) != 0 && (category_b & mask_a) != 0;
}

/// Whether there is nobody that the body may touch or sense, whatever the others' filters are.
inline bool is_non_colliding(const BodyTraits& traits) {
  return traits.group <= 0 && (traits.category == 0 || traits.mask == 0);
}

inline bool has_rule(const FilterRuleTable& table, uint32_t rule) {
  return rule == 0 || (rule <= table.count && table.rules[rule - 1] != nullptr);
}

/// Whether two bodies may touch, which sensors never do: all that finds pairs asks here.
struct PairFilter {
  Span<const BodyTraits> traits;
  FilterRuleTable rules;
  Span<const uint64_t> apart = {};  ///< pairs that joints keep apart, ascending

  bool allows(uint32_t slot_a, uint32_t slot_b) const {
    return (traits[slot_a].sensor | traits[slot_b].sensor) == 0 && lets_through(slot_a, slot_b);
  }
  /// Whether filters and joints let the two know of each other, one of which may be a sensor.
  bool lets_through(uint32_t slot_a, uint32_t slot_b) const {
    const BodyTraits &a = traits[slot_a], &b = traits[slot_b];
    const bool grouped = a.group != 0 && a.group == b.group;
    if (grouped ? a.group < 0 : !masks_meet(a.category, a.mask, b.category, b.mask)) return false;
    if (apart.count != 0 && has_pair(apart, key_of_pair(slot_a, slot_b))) return false;
    return (a.rule | b.rule) == 0 || (rule_allows(a, b) && rule_allows(b, a));
  }

 private:
  /// A rule that the table lacks forbids nothing: create_body(), set_filter() and load() let none in.
  bool rule_allows(const BodyTraits& own, const BodyTraits& other) const {
    if (own.rule == 0 || !has_rule(rules, own.rule)) return true;
    return rules.rules[own.rule - 1]({own.user_data, filter_of(own)}, {other.user_data, filter_of(other)});
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
