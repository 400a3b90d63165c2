#pragma once
#include <detent/config.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Selects the bodies with which a body can collide. Two bodies of the same nonzero group can collide if the group is
/// positive, and cannot if it is negative. Any other two bodies can collide if the category of each shares a bit with
/// the mask of the other. Finally the filter rules of both bodies, if any, are called: a rule can forbid a pair that
/// these tests allow.
/// Source: the filter of Box2D (Catto).
struct Filter {
  uint32_t category = 1;  ///< bits: the categories of the body
  uint32_t mask = ~0u;    ///< bits: the categories with which the body can collide
  int32_t group = 0;      ///< 0: no group
  uint32_t rule = 0;      ///< 0: no rule; else the number, from 1 on, of a rule in WorldHooks::filter_rules
  /// Whether all fields are equal.
  friend constexpr bool operator==(const Filter& a, const Filter& b) {
    return a.category == b.category && a.mask == b.mask && a.group == b.group && a.rule == b.rule;
  }
};

/// The properties of a body that a rule can read.
struct FilterBody {
  uint32_t user_data = 0;  ///< BodyDef::user_data
  Filter filter = {};      ///< BodyDef::filter
};

/// Returns whether `own`, the body that has the rule, can collide with `other`. The result must depend only on the
/// arguments: the rule may be called at any time, and must return the same on every machine that replays the world.
using FilterRule = bool (*)(const FilterBody& own, const FilterBody& other);

/// The filter rules of a world. Rule n is rules[n - 1]. The caller chooses the order, which must be the same on every
/// machine: the state stores only the numbers.
struct FilterRuleTable {
  const FilterRule* rules = nullptr;  ///< the first rule
  uint32_t count = 0;                 ///< number of rules
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
