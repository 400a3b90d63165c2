#pragma once
#include <detent/config.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Which other bodies a body touches. Two bodies of the same group, other than 0, touch if it is positive and do not if
/// it is negative. Any others touch if the category of each has a bit in the mask of the other. The rules of both, if
/// they have one, are asked last, and may forbid what is allowed so far.
/// Source: the filter of Box2D (Catto).
struct Filter {
  uint32_t category = 1;  ///< bits: what the body is
  uint32_t mask = ~0u;    ///< bits: the categories that it touches
  int32_t group = 0;      ///< 0: none
  uint32_t rule = 0;      ///< 0: none; else the number, from 1 on, of a rule in World::filter_rules
  /// Equal in everything.
  friend constexpr bool operator==(const Filter& a, const Filter& b) {
    return a.category == b.category && a.mask == b.mask && a.group == b.group && a.rule == b.rule;
  }
};

/// What a rule may know of a body.
struct FilterBody {
  uint32_t user_data = 0;  ///< BodyDef::user_data
  Filter filter = {};      ///< its filter
};

/// Whether `own`, whose rule it is, may touch `other`. A function of its arguments alone: it may be asked at any time,
/// and must give the same answer on every machine that replays the world.
using FilterRule = bool (*)(const FilterBody& own, const FilterBody& other);

/// The rules of a world, in an order of the caller's choice that is the same on every machine: rule n is rules[n - 1].
/// The state holds the numbers alone.
struct FilterRuleTable {
  const FilterRule* rules = nullptr;  ///< the first rule
  uint32_t count = 0;                 ///< rules
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
