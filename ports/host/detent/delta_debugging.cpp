#include "delta_debugging.h"

#include <algorithm>
#include <iterator>

namespace detent_tool {

namespace {

/// FNV-1a.
uint64_t hash_of_units(const Units& units) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const uint32_t unit : units) {
    for (int shift = 0; shift < 32; shift += 8) hash = (hash ^ (unit >> shift & 0xff)) * 0x100000001b3u;
  }
  return hash;
}

}  // namespace

bool Trials::take() {
  if (made_ == limit_) {
    limit_reached_ = true;
    return false;
  }
  ++made_;
  return true;
}

bool Trials::shows(const Units& units, const ShowsFault& predicate) {
  const uint64_t hash = hash_of_units(units);
  if (failed_.count(hash) != 0 || !take()) return false;
  if (predicate(units)) return true;
  failed_.insert(hash);
  return false;
}

Units minimise(Units units, const Units& others, Trials& trials, const ShowsFault& shows) {
  for (size_t chunk = units.size(); chunk != 0 && !trials.limit_reached();) {
    const size_t before = units.size();
    for (size_t at = 0; at < units.size() && !trials.limit_reached();) {
      const size_t count = std::min(chunk, units.size() - at);
      const auto chunk_start = units.begin() + static_cast<Units::difference_type>(at);
      Units rest(units.begin(), chunk_start);
      rest.insert(rest.end(), chunk_start + static_cast<Units::difference_type>(count), units.end());
      Units all;
      std::merge(rest.begin(), rest.end(), others.begin(), others.end(), std::back_inserter(all));
      if (trials.shows(all, shows))
        units = rest;
      else
        at += count;
    }
    chunk = std::min(chunk, units.size());
    if (chunk > 1)
      chunk = (chunk + 1) / 2;
    else if (units.size() == before)
      chunk = 0;
  }
  return units;
}

}  // namespace detent_tool
