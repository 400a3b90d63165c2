#pragma once
#include <detent/numbers.h>
#include <detent/status.h>
#include <stdint.h>

/// The interface between the module and JavaScript. Numbers are passed on the *desk*: an array of doubles, in which a
/// call finds its arguments and leaves its results. Every number in a definition is converted to a double. Only
/// digests, which have 64 bits, are passed as integers.
#define DETENT_WEB(name) extern "C" __attribute__((export_name(#name), used))

namespace detent_web {

using namespace detent;

/// Returns the desk, with room for `count` doubles; null if there is no memory. The call may move the desk.
double* desk_room(uint32_t count);

/// Takes arguments from the desk. `status` is the status of the first wrong argument.
class Taker {
 public:
  explicit Taker(uint32_t count) : at_(desk_room(count)), left_(at_ == nullptr ? 0 : count) {}

  Status status = Status::ok;

  void real(Real& to) { take(real_from_host(next(), to)); }
  void unit(Unit& to) { take(unit_from_host(next(), to)); }
  void coord(Coord& to) { take(coord_from_host(next(), to)); }
  void scaled(Scaled& to) { take(scaled_from_host(next(), to)); }
  void word(uint32_t& to) {
    const double value = next();
    if (!(value >= 0 && value <= 4294967295.0)) return take(Status::out_of_range);
    to = static_cast<uint32_t>(value);
    if (static_cast<double>(to) != value) take(Status::out_of_range);
  }
  void integer(int32_t& to) {
    const double value = next();
    if (!(value >= -2147483648.0 && value <= 2147483647.0)) return take(Status::out_of_range);
    to = static_cast<int32_t>(value);
  }
  void flag(bool& to) { to = next() != 0; }
  template <class Enum>
  void choice(Enum& to) {
    uint32_t value = 0;
    word(value);
    to = static_cast<Enum>(value);  // the library refuses a value outside its list
  }

 private:
  double next() {
    if (left_ == 0) {
      take(Status::bad_argument);
      return 0;
    }
    --left_;
    return *at_++;
  }
  void take(Status given) {
    if (status == Status::ok) status = given;
  }

  const double* at_;
  uint32_t left_;
};

/// Puts results on the desk, from its start.
class Giver {
 public:
  uint32_t count = 0;

  void real(const Real& value) { put(real_to_host(value)); }
  void unit(const Unit& value) { put(unit_to_host(value)); }
  void coord(const Coord& value) { put(coord_to_host(value)); }
  void scaled(const Scaled& value) { put(scaled_to_host(value)); }
  void word(uint32_t value) { put(value); }
  template <class... Words>
  void words(Words... values) {
    (put(static_cast<uint32_t>(values)), ...);
  }
  void integer(int32_t value) { put(value); }
  void flag(bool value) { put(value ? 1 : 0); }
  /// Puts a 64-bit integer as a double. Exact up to 2^53.
  void count64(uint64_t value) { put(static_cast<double>(value)); }
  template <class Enum>
  void choice(Enum value) {
    put(static_cast<uint32_t>(value));
  }
  void put(double value) {
    double* desk = desk_room(count + 1);
    if (desk != nullptr) desk[count++] = value;
  }
};

}  // namespace detent_web
