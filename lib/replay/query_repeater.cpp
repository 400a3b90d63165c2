#include <detent/recording.h>
#include <string.h>

#include "replay/query_command.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

const QueryCode* const k_queries[] = {&k_query_code<RayCommand>, &k_query_code<CastCommand>,
                                      &k_query_code<OverlapCommand>, &k_query_code<BoundsCommand>,
                                      &k_query_code<ClosestCommand>};

static_assert(sizeof(RayCommand) <= k_query_command_bytes && sizeof(OverlapCommand) <= k_query_command_bytes &&
              sizeof(BoundsCommand) <= k_query_command_bytes && sizeof(ClosestCommand) <= k_query_command_bytes);

Status repeat(const QueryCode& code, const World& world, Reader& reader, uint64_t& recorded, uint64_t& replayed) {
  alignas(8) uint8_t command[k_query_command_bytes] = {};
  code.visit(reader, command);
  if (reader.failed != nullptr) return Status::ok;
  memcpy(&recorded, command + code.digest_at, sizeof recorded);
  QueryReport report;
  const Status status = code.ask(world, command, {}, report);
  replayed = report.digest;
  return status;
}

Status repeat_query(const World& world, Reader& reader, uint64_t& recorded, uint64_t& replayed) {
  uint64_t kind = 0;
  reader.bits("query kind", kind, 1);
  const QueryCode* const code = find_query(kind);
  reader.require("query kind", code != nullptr, Status::corrupt);
  return code == nullptr ? Status::ok : repeat(*code, world, reader, recorded, replayed);
}

}  // namespace

const QueryCode* find_query(uint64_t kind) {
  for (const QueryCode* code : k_queries) {
    if (static_cast<uint64_t>(code->kind) == kind) return code;
  }
  return nullptr;
}

const QueryRepeater k_query_repeater = {repeat_query};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
