#include "replay/archive.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

void Writer::write(Archive& archive, const char*, uint64_t& value, uint32_t byte_count) {
  Writer& to = static_cast<Writer&>(archive);
  to.full = to.full || byte_count > to.capacity - to.count;
  if (to.full) return;
  for (uint32_t i = 0; i < byte_count; ++i) to.bytes[to.count++] = static_cast<uint8_t>(value >> (8 * i));
}

void Reader::read(Archive& archive, const char* name, uint64_t& value, uint32_t byte_count) {
  Reader& from = static_cast<Reader&>(archive);
  value = 0;
  from.field_at = from.at;
  from.require(name, byte_count <= from.count - from.at, Status::corrupt);
  if (from.failed != nullptr) return;
  for (uint32_t i = 0; i < byte_count; ++i) value |= static_cast<uint64_t>(from.bytes[from.at++]) << (8 * i);
}

void Reader::check(Archive& archive, const char* name, bool condition, Status) {
  Reader& from = static_cast<Reader&>(archive);
  if (condition || from.failed != nullptr) return;
  from.failed = name;
  from.failed_at = from.field_at;
}

void Normaliser::check(Archive& archive, const char*, bool condition, Status otherwise) {
  Normaliser& normaliser = static_cast<Normaliser&>(archive);
  if (!condition && normaliser.status == Status::ok) normaliser.status = otherwise;
}

const Archive::Operations Writer::k_operations = {write, nullptr, false};
const Archive::Operations Reader::k_operations = {read, check, false};
const Archive::Operations Normaliser::k_operations = {nullptr, check, true};

void visit_word(Archive& archive, const char* name, uint32_t& value) {
  uint64_t bits = value;
  archive.bits(name, bits, 4);
  value = static_cast<uint32_t>(bits);
}

void visit_byte(Archive& archive, const char* name, uint32_t& value, uint32_t first, uint32_t last) {
  uint64_t bits = value;
  archive.bits(name, bits, 1);
  archive.require(name, bits >= first && bits <= last, Status::bad_argument);
  value = static_cast<uint32_t>(bits);
}

void visit_flag(Archive& archive, const char* name, bool& value) {
  uint32_t number = value ? 1 : 0;
  visit_byte(archive, name, number, 0, 1);
  value = number == 1;
}

void visit_bits(Archive& archive, const char* name, int32_t& value) {
  uint64_t bits = static_cast<uint64_t>(int64_t{value});
  archive.bits(name, bits, 4);
  archive.kind = WordKind::unsigned_integer;
  value = static_cast<int32_t>(bits);
}

void visit_bits(Archive& archive, const char* name, int64_t& value) {
  uint64_t bits = static_cast<uint64_t>(value);
  archive.bits(name, bits, 8);
  archive.kind = WordKind::unsigned_integer;
  value = static_cast<int64_t>(bits);
}

namespace {

template <class Float, class Bits>
void visit_float(Archive& archive, const char* name, Float& value, Bits exponent_mask) {
  Bits own = __builtin_bit_cast(Bits, value);
  constexpr Bits k_negative_zero = Bits{1} << (sizeof(Bits) * 8 - 1);
  if (archive.normalises() && own == k_negative_zero) own = 0;
  uint64_t bits = own;
  archive.kind = WordKind::real;
  archive.bits(name, bits, sizeof(Bits));
  archive.kind = WordKind::unsigned_integer;
  own = static_cast<Bits>(bits);
  archive.require(name, own != k_negative_zero && (own & exponent_mask) != exponent_mask, Status::out_of_range);
  value = __builtin_bit_cast(Float, own);
}

}  // namespace

void visit_number(Archive& archive, const char* name, float& value) {
  visit_float<float, uint32_t>(archive, name, value, 0x7f800000u);
}
void visit_number(Archive& archive, const char* name, double& value) {
  visit_float<double, uint64_t>(archive, name, value, uint64_t{0x7ff} << 52);
}

#if DETENT_FIXED
void visit_number(Archive& archive, const char* name, Scaled& value) {
  archive.kind = WordKind::scaled;
  visit_bits(archive, name, value.mantissa);
  archive.kind = WordKind::scaled;
  visit_bits(archive, name, value.exponent);
  const int64_t signed_mantissa = value.mantissa;
  const int64_t magnitude = signed_mantissa < 0 ? -signed_mantissa : signed_mantissa;
  const bool canonical = magnitude == 0 ? value.exponent == 0
                                        : magnitude >= (int64_t{1} << 30) && magnitude < (int64_t{1} << 31) &&
                                              value.exponent >= -256 && value.exponent <= 256;
  archive.require(name, canonical, Status::out_of_range);
}
#endif

void visit_number(Archive& archive, const char* name, Quat& value) {
  visit_number(archive, name, value.x);
  visit_number(archive, name, value.y);
  visit_number(archive, name, value.z);
  visit_number(archive, name, value.w);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
