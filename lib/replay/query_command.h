#pragma once
#include <detent/query.h>

#include "replay/command.h"

/// Every query of query.h as a value, like the calls of command.h. Its record has a length, so that a reader which does
/// not repeat queries passes over it.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The first byte after the length. Stored: a value is never reused.
enum class QueryKind : uint8_t {
  ray = 1,
  cast = 2,
  overlap = 3,
  bounds = 4,
  closest = 5,
};

template <QueryKind kind, class Asked, Status (*call)(const World&, const Asked&, QueryHits, QueryReport&)>
struct QueryCommand {
  using Query = Asked;
  static constexpr RecordTag k_tag = RecordTag::query;
  static constexpr QueryKind k_kind = kind;
  static constexpr auto k_call = call;
  Query query = {};
  uint64_t digest = 0;  ///< QueryReport::digest
};
using RayCommand = QueryCommand<QueryKind::ray, RayQuery, query_ray>;
using CastCommand = QueryCommand<QueryKind::cast, CastQuery, query_cast>;
using OverlapCommand = QueryCommand<QueryKind::overlap, OverlapQuery, query_overlap>;
using BoundsCommand = QueryCommand<QueryKind::bounds, BoundsQuery, query_bounds>;
using ClosestCommand = QueryCommand<QueryKind::closest, ClosestQuery, query_closest>;

template <class Archive>
void visit(Archive& archive, QueryFilter& filter) {
  visit_word(archive, "category", filter.category);
  visit_word(archive, "mask", filter.mask);
  visit(archive, filter.ignore);
}

/// What all queries end with.
template <class Archive, class Query>
void visit_choice_of_bodies(Archive& archive, Query& query) {
  visit(archive, query.filter);
  visit_choice(archive, "all", query.all, false, true);
}

template <class Archive>
void visit(Archive& archive, RayQuery& query) {
  visit_number(archive, "origin", query.origin);
  visit_number(archive, "way", query.way);
  visit_choice_of_bodies(archive, query);
}
template <class Archive>
void visit(Archive& archive, CastQuery& query) {
  visit(archive, query.shape);
  visit_number(archive, "position", query.position);
  visit_number(archive, "rotation", query.rotation);
  visit_number(archive, "way", query.way);
  visit_number(archive, "turn", query.turn);
  visit_choice_of_bodies(archive, query);
}
template <class Archive>
void visit(Archive& archive, OverlapQuery& query) {
  visit(archive, query.shape);
  visit_number(archive, "position", query.position);
  visit_number(archive, "rotation", query.rotation);
  visit_choice_of_bodies(archive, query);
}
template <class Archive>
void visit(Archive& archive, BoundsQuery& query) {
  visit_number(archive, "lower", query.lower);
  visit_number(archive, "upper", query.upper);
  visit_choice_of_bodies(archive, query);
}
template <class Archive>
void visit(Archive& archive, ClosestQuery& query) {
  visit(archive, query.shape);
  visit_number(archive, "position", query.position);
  visit_number(archive, "rotation", query.rotation);
  visit_number(archive, "reach", query.reach);
  visit_choice_of_bodies(archive, query);
}

/// Counts the bytes of fields.
struct Counter {
  static constexpr bool k_normalises = false;
  uint32_t count = 0;

  void bits(const char*, uint64_t&, uint32_t byte_count) { count += byte_count; }
  void require(const char*, bool, Status) {}
};

/// What follows the kind.
template <class Archive, QueryKind kind, class Query,
          Status (*call)(const World&, const Query&, QueryHits, QueryReport&)>
void visit_question(Archive& archive, QueryCommand<kind, Query, call>& command) {
  visit(archive, command.query);
  archive.bits("query digest", command.digest, 8);
}

template <class Archive, QueryKind kind, class Query,
          Status (*call)(const World&, const Query&, QueryHits, QueryReport&)>
void visit(Archive& archive, QueryCommand<kind, Query, call>& command) {
  Counter counter;
  visit_question(counter, command);
  uint64_t length = counter.count + 1, kind_there = static_cast<uint64_t>(kind);
  archive.bits("query length", length, 2);
  archive.bits("query kind", kind_there, 1);
  visit_question(archive, command);
}

/// The way into the code that repeats queries, for a player.
struct QueryRepeater {
  /// Reads a query from its kind on, asks it, and gives the digests of both answers. What cannot be read the reader
  /// tells of.
  Status (*repeat)(const World& world, Reader& reader, uint64_t& recorded, uint64_t& replayed);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
