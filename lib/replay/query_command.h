#pragma once
#include <detent/query.h>
#include <detent/recording.h>

#include "replay/command.h"

/// Every query of query.h as a value, like the commands of command.h. The record of a query has its tag, the length of
/// the rest, its kind, its fields and the digest of its answer. The length allows a reader that does not repeat queries
/// to skip the record.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The byte after the length in the record of a query: which query it is. The values are stored in files, so a value
/// that is no longer used is never given to another kind.
enum class QueryKind : uint8_t {
  ray = 1,
  cast = 2,
  overlap = 3,
  bounds = 4,
  closest = 5,
};

/// A query and the digest of its answer.
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

inline void visit(Archive& archive, QueryFilter& filter) {
  visit_word(archive, "category", filter.category);
  visit_word(archive, "mask", filter.mask);
  visit(archive, filter.ignore);
}

/// Visits the fields with which every query ends.
template <class Query>
void visit_choice_of_bodies(Archive& archive, Query& query) {
  visit(archive, query.filter);
  visit_choice(archive, "all", query.all, false, true);
}

inline void visit(Archive& archive, RayQuery& query) {
  visit_number(archive, "origin", query.origin);
  visit_number(archive, "displacement", query.displacement);
  visit_choice_of_bodies(archive, query);
}
inline void visit(Archive& archive, CastQuery& query) {
  visit(archive, query.shape);
  visit_number(archive, "position", query.position);
  visit_number(archive, "rotation", query.rotation);
  visit_number(archive, "displacement", query.displacement);
  visit_number(archive, "rotation_vector", query.rotation_vector);
  visit_choice_of_bodies(archive, query);
}
inline void visit(Archive& archive, OverlapQuery& query) {
  visit(archive, query.shape);
  visit_number(archive, "position", query.position);
  visit_number(archive, "rotation", query.rotation);
  visit_choice_of_bodies(archive, query);
}
inline void visit(Archive& archive, BoundsQuery& query) {
  visit_number(archive, "lower", query.lower);
  visit_number(archive, "upper", query.upper);
  visit_choice_of_bodies(archive, query);
}
inline void visit(Archive& archive, ClosestQuery& query) {
  visit(archive, query.shape);
  visit_number(archive, "position", query.position);
  visit_number(archive, "rotation", query.rotation);
  visit_number(archive, "distance_max", query.distance_max);
  visit_choice_of_bodies(archive, query);
}

/// The functions for one kind of query: `visit` reads or writes it, `ask` runs it.
struct QueryCode {
  QueryKind kind;
  /// Visits the fields after the kind. `command` points to a command of this kind.
  void (*visit)(Archive& archive, void* command);
  /// Runs the query, and sets the digest in `command` to that of the new answer.
  Status (*ask)(const World& world, void* command, QueryHits hits, QueryReport& report);
  uint32_t digest_at;  ///< offset of the digest in the command, bytes
};
template <class Command>
inline constexpr QueryCode k_query_code = {Command::k_kind,
                                           [](Archive& archive, void* command) {
                                             visit(archive, static_cast<Command*>(command)->query);
                                             archive.bits("query digest", static_cast<Command*>(command)->digest, 8);
                                           },
                                           [](const World& world, void* command, QueryHits hits, QueryReport& report) {
                                             const Status status = Command::k_call(
                                                 world, static_cast<Command*>(command)->query, hits, report);
                                             static_cast<Command*>(command)->digest = report.digest;
                                             return status;
                                           },
                                           __builtin_offsetof(Command, digest)};

/// The size of the largest query command, bytes.
inline constexpr uint32_t k_query_command_bytes = sizeof(CastCommand);
/// Returns the functions for this kind of query; null if the kind is unknown.
const QueryCode* find_query(uint64_t kind);

/// Visits the record of a query after its tag: the length of the rest, the kind, the fields and the digest.
void visit_query(Archive& archive, const QueryCode& code, void* command);
template <QueryKind kind, class Query, Status (*call)(const World&, const Query&, QueryHits, QueryReport&)>
void visit(Archive& archive, QueryCommand<kind, Query, call>& command) {
  visit_query(archive, k_query_code<QueryCommand<kind, Query, call>>, &command);
}

/// The table through which a player repeats queries. The code for this is linked only if a program uses the table
/// (k_query_repeater).
struct QueryRepeater {
  /// Reads a query, beginning with its kind, and runs it. Sets `recorded` and `replayed` to the digests of the recorded
  /// and of the new answer. Returns the status of the query. If the query cannot be read, returns ok, and
  /// Reader::failed is set.
  Status (*repeat)(const World& world, Reader& reader, uint64_t& recorded, uint64_t& replayed);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
