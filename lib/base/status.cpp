#include <detent/status.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

const char* status_text(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::bad_id:
      return "no such id";
    case Status::bad_argument:
      return "not one of the allowed values";
    case Status::out_of_range:
      return "out of range";
    case Status::not_normalised:
      return "not of unit length";
    case Status::pool_full:
      return "the capacity is used up";
    case Status::buffer_too_small:
      return "buffer too small";
    case Status::buffer_misaligned:
      return "buffer not aligned to 8 bytes";
    case Status::asset_missing:
      return "asset missing";
    case Status::asset_mismatch:
      return "asset content differs";
    case Status::not_detent:
      return "not a detent file";
    case Status::format_unknown:
      return "unknown format version";
    case Status::simulation_differs:
      return "made by another simulation version";
    case Status::config_differs:
      return "made by another math configuration";
    case Status::capacity_differs:
      return "made for another capacity";
    case Status::corrupt:
      return "corrupt";
    case Status::truncated:
      return "truncated";
    case Status::digest_differs:
      return "digest differs";
    case Status::feature_missing:
      return "feature not linked";
    case Status::rule_missing:
      return "filter rule missing";
    case Status::waiting:
      return "waits for other players' inputs";
    case Status::sink_failed:
      return "reading or writing failed";
  }
  return "unknown status";
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
