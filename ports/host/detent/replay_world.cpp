#include <string.h>

#include "examples/scenes/scene.h"
#include "reading.h"
#include "replay/format.h"
#include "shape/compound.h"
#include "shape/height_field.h"
#include "shape/hull.h"
#include "shape/mesh.h"
#include "state/view.h"
#include "text.h"

/// What every replay needs, including the replays of a page (ports/web). Therefore no file is opened here.
namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

namespace {

Status read_input(void* input, uint8_t* bytes, uint32_t count, uint32_t& got) {
  return static_cast<Input*>(input)->read(bytes, count, got) ? Status::ok : Status::sink_failed;
}
Status seek_input(void* input, uint64_t offset) {
  return static_cast<Input*>(input)->seek(offset) ? Status::ok : Status::sink_failed;
}

}  // namespace

Source source_of(Input& input) { return {read_input, &input, seek_input}; }

FileKind kind_of(const uint8_t* bytes, uint32_t count) {
  uint8_t snapshot[4];
  for (uint32_t i = 0; i < 4; ++i) snapshot[i] = static_cast<uint8_t>(k_snapshot_magic >> (8 * i));
  const struct {
    const uint8_t* magic;
    uint32_t bytes;
    FileKind kind;
  } kinds[] = {{k_recording_magic, sizeof k_recording_magic, FileKind::recording},
               {k_hull_magic, sizeof k_hull_magic, FileKind::hull},
               {k_compound_magic, sizeof k_compound_magic, FileKind::compound},
               {k_mesh_magic, sizeof k_mesh_magic, FileKind::mesh},
               {k_height_field_magic, sizeof k_height_field_magic, FileKind::height_field},
               {snapshot, sizeof snapshot, FileKind::snapshot}};
  for (const auto& each : kinds) {
    if (count >= each.bytes && memcmp(bytes, each.magic, each.bytes) == 0) return each.kind;
  }
  return FileKind::other;
}

std::string problem_text(const ReplayError& error, Input& input) {
  uint8_t start[k_file_kind_bytes];
  uint32_t got = 0;
  if (error.field == std::string("magic") && error.status != Status::sink_failed && input.seek(0) &&
      input.read(start, sizeof start, got) && (got != 0 || input.file_bytes == 0)) {
    const FileKind kind = kind_of(start, got);
    const std::string text = got == 0 ? "is empty, not a recording" : is_not(kind, "a recording");
    return kind == FileKind::other ? text + " (no magic number)" : text;
  }
  std::string text = status_text(error.status);
  text += " at byte " + std::to_string(error.offset) + ", tick " + std::to_string(error.tick) + ": " + error.field;
  if (!input.problem.empty()) text += " (" + input.problem + ")";
  if (error.digest_recorded != error.digest_replayed) {
    text += " (recorded " + hexadecimal(error.digest_recorded) + ", here " + hexadecimal(error.digest_replayed) + ")";
  }
  return text;
}

Status ReplayWorld::create(const RecordingInfo& info, const Input& input, const Assets& assets) {
  // Prevents a hostile header from reserving gigabytes: the seed's size follows from the capacity, so a small file
  // cannot contain a large one.
  if (info.snapshot_bytes > input.snapshot_bytes_max) return Status::truncated;
  WorldDef def;
  def.capacity = info.capacity;
  for (const AssetBytes& asset : assets)
    table.push_back({reinterpret_cast<const uint8_t*>(asset.words.data()), asset.byte_count});
  const AssetTable given = {table.data(), static_cast<uint32_t>(table.size())};
  return owned.create(def, table.empty() ? scene_assets() : given);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
