#pragma once
#include <detent/config.h>

#include "base/check.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Refers to `count` elements that begin at `data`. The span does not own them.
template <class T>
struct Span {
  T* data = nullptr;
  uint32_t count = 0;

  Span() = default;
  Span(T* first, uint32_t element_count) : data(first), count(element_count) {}
  // NOLINTNEXTLINE(google-explicit-constructor): a mutable span converts to a const span
  operator Span<const T>() const { return {data, count}; }

  T& operator[](uint32_t index) const {
    DETENT_VERIFY_RANGE(index < count);
    return data[index];
  }
  T* begin() const { return data; }
  T* end() const { return data + count; }
  Span first(uint32_t element_count) const {
    DETENT_VERIFY_RANGE(element_count <= count);
    return {data, element_count};
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
