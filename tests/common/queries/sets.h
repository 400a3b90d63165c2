#pragma once
#include <stdint.h>

#include <string>
#include <vector>

#include "tests/common/queries/random.h"

/// The query sets of tests and benchmarks. A query is a function of set, seed and index alone: a longer run begins with
/// the queries of a shorter one. Every number is a float; the step is 1. Unless its text says otherwise a set draws
/// spheres, capsules, boxes and hulls of 0.1 to 1.2 m, and alternates queries that turn with queries that do not.
namespace detent_queries {

/// What a set needs from outside.
struct Sources {
  std::vector<Solid> game_hulls;  ///< empty: the set "game" cannot be made
};

struct Set {
  const char* name;
  const char* text;
  bool moves;  ///< else for distance alone; a set that moves serves distance too, at its start
  Query (*make)(Random& random, uint32_t index, const Sources& sources);
};

/// All sets, in the order of their names' numbers.
const std::vector<Set>& all_sets();
/// Null if there is none of that name.
const Set* find_set(const std::string& name);

Query make_query(const Set& set, uint64_t seed, uint32_t index, const Sources& sources);
std::vector<Query> make_queries(const Set& set, uint64_t seed, uint32_t count, const Sources& sources);

/// Whether a body of the query turns.
bool turns(const Query& query);

/// Reads point clouds (a little-endian count, then x, y, z as floats; again to the end of the file), each moved so that
/// the middle of its bounds is at the origin, its extreme points alone; those of more than 255 points are left out.
/// False if the file cannot be read.
bool read_game_hulls(const std::string& path, std::vector<Solid>& hulls);

}  // namespace detent_queries
