#include <detent/recording.h>
#include <string.h>

#include "replay/query_command.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

const QueryCode* const k_queries[] = {&k_query_code<RayCommand>, &k_query_code<CastCommand>,
                                      &k_query_code<OverlapCommand>, &k_query_code<BoundsCommand>,
                                      &k_query_code<ClosestCommand>};

constexpr uint32_t k_command_bytes = sizeof(CastCommand);
static_assert(sizeof(RayCommand) <= k_command_bytes && sizeof(OverlapCommand) <= k_command_bytes &&
              sizeof(BoundsCommand) <= k_command_bytes && sizeof(ClosestCommand) <= k_command_bytes);

Status repeat(const QueryCode& code, const World& world, Reader& reader, uint64_t& recorded, uint64_t& replayed) {
  alignas(8) uint8_t command[k_command_bytes] = {};
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
  for (const QueryCode* code : k_queries) {
    if (static_cast<uint64_t>(code->kind) == kind) return repeat(*code, world, reader, recorded, replayed);
  }
  reader.require("query kind", false, Status::corrupt);
  return Status::ok;
}

}  // namespace

const QueryRepeater k_query_repeater = {repeat_query};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
