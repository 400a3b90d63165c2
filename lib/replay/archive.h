#pragma once
#include <detent/numbers.h>
#include <detent/status.h>

#include "state/fields.h"

/// Operations on the fields of a type. A type lists its fields once, in a function `visit(archive, value)`. The class
/// of the archive determines the operation: Writer writes the fields as canonical bytes, Reader reads them from
/// canonical bytes, and Normaliser checks the values and changes them to a form that Writer can write.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The base class of all archives. The field lists are compiled once, for this type, which keeps the code small.
class Archive {
 public:
  /// The operations of a class of archives. If a pointer is null, this operation does nothing.
  struct Operations {
    void (*bits)(Archive& archive, const char* name, uint64_t& value, uint32_t byte_count);
    void (*require)(Archive& archive, const char* name, bool condition, Status otherwise);
    bool normalises;
  };

  /// Visits a field: an integer of `byte_count` bytes.
  void bits(const char* name, uint64_t& value, uint32_t byte_count) {
    if (operations_.bits != nullptr) operations_.bits(*this, name, value, byte_count);
  }
  /// States a condition that the field just visited must satisfy. If the condition is false for the first time, Reader
  /// records the field as failed, and Normaliser records the status `otherwise`. Writer ignores the condition.
  void require(const char* name, bool condition, Status otherwise) {
    if (operations_.require != nullptr) operations_.require(*this, name, condition, otherwise);
  }
  bool normalises() const { return operations_.normalises; }

  WordKind kind = WordKind::unsigned_integer;  ///< number format of the next field, for programs that display fields

 protected:
  explicit Archive(const Operations& operations) : operations_(operations) {}

 private:
  const Operations& operations_;
};

class Writer final : public Archive {
 public:
  Writer(uint8_t* to, uint32_t byte_capacity) : Archive(k_operations), bytes(to), capacity(byte_capacity) {}

  uint8_t* bytes;
  uint32_t capacity;
  uint32_t count = 0;
  bool full = false;  ///< a field did not fit: `bytes` holds only the fields before it

 private:
  static void write(Archive& archive, const char* name, uint64_t& value, uint32_t byte_count);
  static const Operations k_operations;
};

class Reader final : public Archive {
 public:
  Reader(const uint8_t* from, uint32_t byte_count, uint32_t first = 0)
      : Archive(k_operations), bytes(from), count(byte_count), at(first) {}

  const uint8_t* bytes;
  uint32_t count;
  uint32_t at;                   ///< index of the next byte to read
  const char* failed = nullptr;  ///< the first field that is missing or wrong
  uint32_t failed_at = 0;        ///< the index of the first byte of this field
  uint32_t field_at = 0;         ///< the index of the first byte of the last field visited

 private:
  static void read(Archive& archive, const char* name, uint64_t& value, uint32_t byte_count);
  static void check(Archive& archive, const char* name, bool condition, Status otherwise);
  static const Operations k_operations;
};

class Normaliser final : public Archive {
 public:
  Normaliser() : Archive(k_operations) {}

  Status status = Status::ok;  ///< why the first field that is out of range cannot be written; ok if there is none

 private:
  static void check(Archive& archive, const char* name, bool condition, Status otherwise);
  static const Operations k_operations;
};

void visit_word(Archive& archive, const char* name, uint32_t& value);
/// Visits a flag as one byte, 0 or 1.
void visit_flag(Archive& archive, const char* name, bool& value);
/// Visits a number as one byte. The number must be from `first` to `last`.
void visit_byte(Archive& archive, const char* name, uint32_t& value, uint32_t first, uint32_t last);
/// Visits a signed integer in two's complement, as a field of the kind that Archive::kind has at the call. Afterwards
/// Archive::kind is unsigned_integer.
void visit_bits(Archive& archive, const char* name, int32_t& value);
void visit_bits(Archive& archive, const char* name, int64_t& value);

/// Visits an enumeration value as one byte. The value must be from `first` to `last`.
template <class Enum>
void visit_choice(Archive& archive, const char* name, Enum& value, Enum first, Enum last) {
  uint32_t number = static_cast<uint32_t>(value);
  visit_byte(archive, name, number, static_cast<uint32_t>(first), static_cast<uint32_t>(last));
  value = static_cast<Enum>(number);
}

/// Visits a fixed-point number as its raw integer.
template <class Int, int frac>
void visit_number(Archive& archive, const char* name, Fixed<Int, frac>& value) {
  archive.kind = WordsOf<Fixed<Int, frac>>::k_kind;
  visit_bits(archive, name, value.raw);
}
/// Visits a floating-point number as its IEEE bits. The code uses only integer arithmetic, so the caller's
/// floating-point modes do not matter. Negative zero, infinities and NaN are rejected (Archive::require()); machines
/// differ in the sign of zeros and the bits of NaN. Normaliser replaces negative zero by zero instead of rejecting it.
void visit_number(Archive& archive, const char* name, float& value);
void visit_number(Archive& archive, const char* name, double& value);
#if DETENT_FIXED
/// Visits the mantissa and the exponent of a Scaled. The Scaled must have the canonical form of numbers.h.
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
