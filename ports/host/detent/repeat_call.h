#pragma once
#include <detent/recording.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

struct RepeatedCall {
  Status status = Status::corrupt;
  bool same_id = true;  ///< it gives the recorded id, or none
};
/// Makes a call or query again, through a recorder; `record` is what a ReplayWatch gets.
RepeatedCall repeat_call(Recorder& recorder, const uint8_t* record, uint32_t count);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
