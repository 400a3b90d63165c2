#pragma once
#include <detent/math.h>
#include <detent/scaled.h>
#include <detent/status.h>

/// Three ways to go through a list of fields. A type lists its fields once, in a `visit(archive, value)`; the archive
/// decides what happens: Writer makes canonical bytes of them, Reader takes them from bytes, Normaliser makes them fit
/// to be written.
///
/// An archive has `bits` (one little-endian integer) and `require` (a condition on the field just visited).
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Writer {
  static constexpr bool k_normalises = false;
  uint8_t* bytes;
  uint32_t capacity;
  uint32_t count = 0;
  bool full = false;  ///< a field did not fit: `bytes` holds a part only

  void bits(const char*, uint64_t& value, uint32_t byte_count) {
    full = full || byte_count > capacity - count;
    if (full) return;
    for (uint32_t i = 0; i < byte_count; ++i) bytes[count++] = static_cast<uint8_t>(value >> (8 * i));
  }
  void require(const char*, bool, Status) {}
};

struct Reader {
  static constexpr bool k_normalises = false;
  const uint8_t* bytes;
  uint32_t count;
  uint32_t at = 0;
  const char* failed = nullptr;  ///< the first field that is missing or wrong
  uint32_t failed_at = 0;        ///< where it starts
  uint32_t field_at = 0;

  void bits(const char* name, uint64_t& value, uint32_t byte_count) {
    value = 0;
    field_at = at;
    require(name, byte_count <= count - at, Status::corrupt);
    if (failed != nullptr) return;
    for (uint32_t i = 0; i < byte_count; ++i) value |= static_cast<uint64_t>(bytes[at++]) << (8 * i);
  }
  void require(const char* name, bool condition, Status) {
    if (condition || failed != nullptr) return;
    failed = name;
    failed_at = field_at;
  }
};

struct Normaliser {
  static constexpr bool k_normalises = true;
  Status status = Status::ok;  ///< of the first field that cannot be written

  void bits(const char*, uint64_t&, uint32_t) {}
  void require(const char*, bool condition, Status otherwise) {
    if (!condition && status == Status::ok) status = otherwise;
  }
};

template <class Archive>
void visit_word(Archive& archive, const char* name, uint32_t& value) {
  uint64_t bits = value;
  archive.bits(name, bits, 4);
  value = static_cast<uint32_t>(bits);
}

/// One byte, 0 or 1.
template <class Archive>
void visit_flag(Archive& archive, const char* name, bool& value) {
  uint64_t bits = value ? 1 : 0;
  archive.bits(name, bits, 1);
  archive.require(name, bits <= 1, Status::bad_argument);
  value = bits == 1;
}

/// One byte; the enumeration's values are `first` to `last`.
template <class Archive, class Enum>
void visit_choice(Archive& archive, const char* name, Enum& value, Enum first, Enum last) {
  uint64_t bits = static_cast<uint64_t>(value);
  archive.bits(name, bits, 1);
  archive.require(name, bits >= static_cast<uint64_t>(first) && bits <= static_cast<uint64_t>(last),
                  Status::bad_argument);
  value = static_cast<Enum>(bits);
}

/// The raw integer, two's complement.
template <class Archive, class Int, int frac>
void visit_number(Archive& archive, const char* name, Fixed<Int, frac>& value) {
  uint64_t bits = static_cast<uint64_t>(static_cast<int64_t>(value.raw));
  archive.bits(name, bits, sizeof(Int));
  value.raw = static_cast<Int>(bits);
}

/// The IEEE bits. Only integer arithmetic, so the caller's floating-point modes don't matter. One zero, and no NaN:
/// their bits differ between machines.
template <class Archive, class Float, class Bits>
void visit_float(Archive& archive, const char* name, Float& value, Bits exponent_mask) {
  Bits own = __builtin_bit_cast(Bits, value);
  constexpr Bits k_negative_zero = Bits{1} << (sizeof(Bits) * 8 - 1);
  if constexpr (Archive::k_normalises) {
    if (own == k_negative_zero) own = 0;
  }
  uint64_t bits = own;
  archive.bits(name, bits, sizeof(Bits));
  own = static_cast<Bits>(bits);
  archive.require(name, own != k_negative_zero && (own & exponent_mask) != exponent_mask, Status::out_of_range);
  value = __builtin_bit_cast(Float, own);
}
template <class Archive>
void visit_number(Archive& archive, const char* name, float& value) {
  visit_float<Archive, float, uint32_t>(archive, name, value, 0x7f800000u);
}
template <class Archive>
void visit_number(Archive& archive, const char* name, double& value) {
  visit_float<Archive, double, uint64_t>(archive, name, value, uint64_t{0x7ff} << 52);
}

#if DETENT_FIXED
/// Mantissa, exponent; canonical as scaled.h states it.
template <class Archive>
void visit_number(Archive& archive, const char* name, Scaled& value) {
  uint64_t mantissa = static_cast<uint64_t>(static_cast<int64_t>(value.mantissa));
  uint64_t exponent = static_cast<uint64_t>(static_cast<int64_t>(value.exponent));
  archive.bits(name, mantissa, 4);
  archive.bits(name, exponent, 4);
  value.mantissa = static_cast<int32_t>(mantissa);
  value.exponent = static_cast<int32_t>(exponent);
  const int64_t signed_mantissa = value.mantissa;
  const int64_t magnitude = signed_mantissa < 0 ? -signed_mantissa : signed_mantissa;
  const bool canonical = magnitude == 0 ? value.exponent == 0
                                        : magnitude >= (int64_t{1} << 30) && magnitude < (int64_t{1} << 31) &&
                                              value.exponent >= -256 && value.exponent <= 256;
  archive.require(name, canonical, Status::out_of_range);
}
#endif

template <class Archive, class T>
void visit_number(Archive& archive, const char* name, Vec3<T>& value) {
  visit_number(archive, name, value.x);
  visit_number(archive, name, value.y);
  visit_number(archive, name, value.z);
}

template <class Archive>
void visit_number(Archive& archive, const char* name, Quat& value) {
  visit_number(archive, name, value.x);
  visit_number(archive, name, value.y);
  visit_number(archive, name, value.z);
  visit_number(archive, name, value.w);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
