#pragma once
#include <detent/math.h>
#include <detent/scaled.h>
#include <detent/status.h>

#include "state/fields.h"

/// Three ways to go through a list of fields. A type lists its fields once, in a `visit(archive, value)`; the archive
/// decides what happens: Writer makes canonical bytes of them, Reader takes them from bytes, Normaliser makes them fit
/// to be written.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The lists are compiled once, for this type: so they are small.
class Archive {
 public:
  /// What an archive does; null: nothing.
  struct Ways {
    void (*bits)(Archive& archive, const char* name, uint64_t& value, uint32_t byte_count);
    void (*require)(Archive& archive, const char* name, bool condition, Status otherwise);
    bool normalises;
  };

  /// One little-endian integer.
  void bits(const char* name, uint64_t& value, uint32_t byte_count) {
    if (ways_.bits != nullptr) ways_.bits(*this, name, value, byte_count);
  }
  /// A condition on the field just visited.
  void require(const char* name, bool condition, Status otherwise) {
    if (ways_.require != nullptr) ways_.require(*this, name, condition, otherwise);
  }
  bool normalises() const { return ways_.normalises; }

  WordKind kind = WordKind::unsigned_integer;  ///< what the bits are that come next, for who shows them

 protected:
  explicit Archive(const Ways& ways) : ways_(ways) {}

 private:
  const Ways& ways_;
};

class Writer final : public Archive {
 public:
  Writer(uint8_t* to, uint32_t byte_capacity) : Archive(k_ways), bytes(to), capacity(byte_capacity) {}

  uint8_t* bytes;
  uint32_t capacity;
  uint32_t count = 0;
  bool full = false;  ///< a field did not fit: `bytes` holds a part only

 private:
  static void write(Archive& archive, const char* name, uint64_t& value, uint32_t byte_count);
  static const Ways k_ways;
};

class Reader final : public Archive {
 public:
  Reader(const uint8_t* from, uint32_t byte_count, uint32_t first = 0)
      : Archive(k_ways), bytes(from), count(byte_count), at(first) {}

  const uint8_t* bytes;
  uint32_t count;
  uint32_t at;
  const char* failed = nullptr;  ///< the first field that is missing or wrong
  uint32_t failed_at = 0;        ///< where it starts
  uint32_t field_at = 0;

 private:
  static void read(Archive& archive, const char* name, uint64_t& value, uint32_t byte_count);
  static void check(Archive& archive, const char* name, bool condition, Status otherwise);
  static const Ways k_ways;
};

class Normaliser final : public Archive {
 public:
  Normaliser() : Archive(k_ways) {}

  Status status = Status::ok;  ///< of the first field that cannot be written

 private:
  static void check(Archive& archive, const char* name, bool condition, Status otherwise);
  static const Ways k_ways;
};

void visit_word(Archive& archive, const char* name, uint32_t& value);
/// One byte, 0 or 1.
void visit_flag(Archive& archive, const char* name, bool& value);
/// One byte of `first` to `last`.
void visit_byte(Archive& archive, const char* name, uint32_t& value, uint32_t first, uint32_t last);
/// Two's complement; of Archive::kind, which is unsigned integers afterwards.
void visit_bits(Archive& archive, const char* name, int32_t& value);
void visit_bits(Archive& archive, const char* name, int64_t& value);

/// One byte; the enumeration's values are `first` to `last`.
template <class Enum>
void visit_choice(Archive& archive, const char* name, Enum& value, Enum first, Enum last) {
  uint32_t number = static_cast<uint32_t>(value);
  visit_byte(archive, name, number, static_cast<uint32_t>(first), static_cast<uint32_t>(last));
  value = static_cast<Enum>(number);
}

/// The raw integer.
template <class Int, int frac>
void visit_number(Archive& archive, const char* name, Fixed<Int, frac>& value) {
  archive.kind = WordsOf<Fixed<Int, frac>>::k_kind;
  visit_bits(archive, name, value.raw);
}
/// The IEEE bits. Only integer arithmetic, so the caller's floating-point modes don't matter. One zero, and no NaN:
/// their bits differ between machines.
void visit_number(Archive& archive, const char* name, float& value);
void visit_number(Archive& archive, const char* name, double& value);
#if DETENT_FIXED
/// Mantissa, exponent; canonical as scaled.h states it.
void visit_number(Archive& archive, const char* name, Scaled& value);
#endif
template <class T>
void visit_number(Archive& archive, const char* name, Vec3<T>& value) {
  visit_number(archive, name, value.x);
  visit_number(archive, name, value.y);
  visit_number(archive, name, value.z);
}
void visit_number(Archive& archive, const char* name, Quat& value);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
