#pragma once
#include <detent/recording.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

struct RepeatedCall {
  Status status = Status::corrupt;
  bool same_id = true;  ///< the call gives the recorded id, or gives no id
};
/// Repeats a call or query through a recorder. `record`, `count`: the arguments of ReplayWatch::called.
RepeatedCall repeat_call(Recorder& recorder, const uint8_t* record, uint32_t count);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
