#include "repeat_call.h"

#include <string.h>

#include "replay/format.h"
#include "replay/query_command.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

RepeatedCall repeat_call(Recorder& recorder, const uint8_t* record, uint32_t count) {
  RepeatedCall made;
  Reader reader{record, count, 1};
  const RecordTag tag = static_cast<RecordTag>(record[0]);
  if (tag == RecordTag::query) {
    uint64_t length = 0, kind = 0;
    reader.bits("query length", length, 2);
    reader.bits("query kind", kind, 1);
    alignas(8) uint8_t command[k_query_command_bytes] = {};
    const QueryCode* const code = find_query(kind);
    made.status = Status::ok;  // a reader that does not know a kind skips it
    if (code == nullptr) return made;
    code->visit(reader, command);
    made.status = recorder.make(*code, command);
  } else if (const CommandCode* const code = find_command(tag)) {
    alignas(8) uint8_t command[k_command_bytes_max] = {};
    code->visit(reader, command);
    BodyId recorded, given;  // or joint ids
    memcpy(&recorded, command, sizeof recorded);
    made.status = recorder.make(*code, command);
    memcpy(&given, command, sizeof given);
    made.same_id = given == recorded;
  }
  return made;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
