#include <string.h>

#include <string>

#include "desk.h"
#include "examples/scenes/scene.h"
#include "ports/host/detent/difference.h"
#include "ports/host/detent/reading.h"

/// Compares two recordings as `detent diff` does, with the same sources, but from memory instead of files.
namespace detent_tool {

std::unique_ptr<Input> Input::open(const std::string&, std::string& problem) {
  problem = "a page opens no files";
  return nullptr;
}

}  // namespace detent_tool

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A page gives the assets of each recording.
AssetTable scene_assets() { return {}; }

}  // namespace DETENT_NAMESPACE
}  // namespace detent

namespace detent_web {
namespace {

using namespace detent_tool;

struct Bytes {
  const uint8_t* at;
  uint32_t count;
};

Recorded recorded_of(const Bytes& name, const Bytes& bytes) {
  Recorded recorded;
  recorded.name.assign(reinterpret_cast<const char*>(name.at), name.count);
  recorded.path = recorded.name;
  recorded.bytes = std::make_shared<std::vector<uint8_t>>(bytes.at, bytes.at + bytes.count);
  return recorded;
}

AssetBytes asset_of(const Bytes& bytes) {
  AssetBytes asset;
  asset.words.resize((bytes.count + 7) / 8);
  if (bytes.count != 0) memcpy(asset.words.data(), bytes.at, bytes.count);
  asset.byte_count = bytes.count;
  return asset;
}

/// Gives what the page marks for a field: pairs of 1 and the slot of a body, or of 2 and the slot of a joint. A contact
/// marks both of its bodies.
void give(Giver& out, const FieldDifference& field) {
  const bool joint = field.element.kind == "joint";
  if (!joint && field.element.kind != "body" && field.element.kind != "contact" && field.element.kind != "sensor")
    return;
  for (const uint32_t slot : field.element.slots) out.words(joint ? 2u : 1u, slot);
}

/// The texts of the last comparison. Never destroyed, because a module has no end.
struct Said {
  std::string text, stage;
};
Said* said = nullptr;

}  // namespace

/// Compares two recordings. `given` has pairs of an address and a number of bytes: the first recording's name, its
/// bytes, the second recording's name, its bytes, and `asset_count` assets. Gives four flags: whether the recordings
/// cannot be compared, whether they differ, whether one of them is damaged, whether only what follows the last tick
/// differs. Then four ticks: the first and the last tick that both have, the last tick up to which they are equal, the
/// tick that differs. Then the address and the length of the text that `detent diff` prints, and those of the stage's
/// name. Then pairs of what to mark. Returns the number of these pairs.
DETENT_WEB(compare_recordings) uint32_t compare_recordings(const Bytes* given, uint32_t asset_count) {
  const Recorded a = recorded_of(given[0], given[1]), b = recorded_of(given[2], given[3]);
  Assets assets;
  for (uint32_t i = 0; i < asset_count; ++i) assets.push_back(asset_of(given[4 + i]));
  const Difference difference = diff(a, b, assets);
  delete said;
  said = new Said{difference_text(difference, a.name, b.name), difference.stage};
  Giver out;
  out.flag(!difference.problem.empty());
  out.flag(difference.different);
  out.flag(difference.damaged);
  out.flag(difference.after_last_tick);
  out.count64(difference.first);
  out.count64(difference.last);
  out.count64(difference.equal_to);
  out.count64(difference.tick);
  for (const std::string* each : {&said->text, &said->stage})
    out.words(reinterpret_cast<uint32_t>(each->data()), static_cast<uint32_t>(each->size()));
  const uint32_t before = out.count;
  for (const FieldDifference& field : difference.fields) give(out, field);
  return (out.count - before) / 2;
}

}  // namespace detent_web
