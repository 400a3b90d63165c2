#pragma once
#include <detent/config.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The name of a configuration; "unknown" for an invalid one.
constexpr const char* config_text(Config config) {
  switch (config) {
    case Config::fx64:
      return "fx64";
    case Config::fx32:
      return "fx32";
    case Config::f32:
      return "f32";
    case Config::f64:
      return "f64";
    default:
      return "unknown";
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
