#include <detent/recording.h>

#include "replay/query_command.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

template <class Command>
Status repeat(const World& world, Reader& reader, uint64_t& recorded, uint64_t& replayed) {
  Command command;
  visit_question(reader, command);
  if (reader.failed != nullptr) return Status::ok;
  recorded = command.digest;
  QueryReport report;
  const Status status = Command::k_call(world, command.query, {}, report);
  replayed = report.digest;
  return status;
}

Status repeat_query(const World& world, Reader& reader, uint64_t& recorded, uint64_t& replayed) {
  uint64_t kind = 0;
  reader.bits("query kind", kind, 1);
  switch (static_cast<QueryKind>(kind)) {
    case QueryKind::ray:
      return repeat<RayCommand>(world, reader, recorded, replayed);
    case QueryKind::cast:
      return repeat<CastCommand>(world, reader, recorded, replayed);
    case QueryKind::overlap:
      return repeat<OverlapCommand>(world, reader, recorded, replayed);
    case QueryKind::bounds:
      return repeat<BoundsCommand>(world, reader, recorded, replayed);
    case QueryKind::closest:
      return repeat<ClosestCommand>(world, reader, recorded, replayed);
    default:
      reader.require("query kind", false, Status::corrupt);
      return Status::ok;
  }
}

}  // namespace

const QueryRepeater k_query_repeater = {repeat_query};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
