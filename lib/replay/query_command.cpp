#include "replay/query_command.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// An archive that only counts the bytes of the visited fields.
class Counter final : public Archive {
 public:
  Counter() : Archive(k_operations) {}
  uint32_t count = 0;

 private:
  static void add(Archive& archive, const char*, uint64_t&, uint32_t byte_count) {
    static_cast<Counter&>(archive).count += byte_count;
  }
  static constexpr Operations k_operations = {add, nullptr, false};
};

}  // namespace

void visit_query(Archive& archive, const QueryCode& code, void* command) {
  Counter counter;
  code.visit(counter, command);
  uint64_t length = counter.count + 1, kind = static_cast<uint64_t>(code.kind);
  archive.bits("query length", length, 2);
  archive.bits("query kind", kind, 1);
  code.visit(archive, command);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
