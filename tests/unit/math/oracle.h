#pragma once
#include <detent/numbers.h>
#include <gtest/gtest.h>
#include <ports/config_text.h>
#include <stdint.h>
#include <stdlib.h>

#include <fstream>
#include <map>
#include <string>

#include <mpfr.h>

/// Error bounds of the kernels, checked against MPFR, and the table of the errors found.
namespace detent_oracle {

/// A real number to 300 bits.
struct Big {
  mpfr_t value;
  Big() { mpfr_init2(value, k_bits); }
  Big(double number) : Big() { mpfr_set_d(value, number, MPFR_RNDN); }
  Big(const Big& other) : Big() { mpfr_set(value, other.value, MPFR_RNDN); }
  Big& operator=(const Big& other) {
    mpfr_set(value, other.value, MPFR_RNDN);
    return *this;
  }
  ~Big() { mpfr_clear(value); }
  /// integer 2^exponent.
  static Big scaled(int64_t integer, int exponent) {
    Big result;
    mpfr_set_si_2exp(result.value, integer, exponent, MPFR_RNDN);
    return result;
  }
  static Big pi() {
    Big result;
    mpfr_const_pi(result.value, MPFR_RNDN);
    return result;
  }
  double number() const { return mpfr_get_d(value, MPFR_RNDN); }

 private:
  static constexpr int k_bits = 300;
};

template <int (*function)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t)>
Big apply(const Big& a, const Big& b) {
  Big result;
  function(result.value, a.value, b.value, MPFR_RNDN);
  return result;
}
template <int (*function)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t)>
Big apply(const Big& a) {
  Big result;
  function(result.value, a.value, MPFR_RNDN);
  return result;
}
inline Big operator+(const Big& a, const Big& b) { return apply<mpfr_add>(a, b); }
inline Big operator-(const Big& a, const Big& b) { return apply<mpfr_sub>(a, b); }
inline Big operator*(const Big& a, const Big& b) { return apply<mpfr_mul>(a, b); }
inline Big operator/(const Big& a, const Big& b) { return apply<mpfr_div>(a, b); }
inline Big operator-(const Big& a) { return apply<mpfr_neg>(a); }
inline Big root(const Big& a) { return apply<mpfr_sqrt>(a); }
inline Big sine(const Big& a) { return apply<mpfr_sin>(a); }
inline Big cosine(const Big& a) { return apply<mpfr_cos>(a); }
inline Big arc_tangent(const Big& y, const Big& x) { return apply<mpfr_atan2>(y, x); }
/// |a - b| 2^-unit.
inline double distance(const Big& a, const Big& b, int unit) {
  Big difference = a - b;
  mpfr_abs(difference.value, difference.value, MPFR_RNDN);
  mpfr_mul_2si(difference.value, difference.value, -unit, MPFR_RNDN);
  return difference.number();
}

template <class T>
struct BigVector {
  T x, y, z;
};
using Big3 = BigVector<Big>;
inline Big dot(const Big3& a, const Big3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Big length(const Big3& a) { return root(dot(a, a)); }
inline Big3 cross(const Big3& a, const Big3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The largest component of |a - b| 2^-unit.
inline double distance(const Big3& a, const Big3& b, int unit) {
  return std::max({distance(a.x, b.x, unit), distance(a.y, b.y, unit), distance(a.z, b.z, unit)});
}

inline bool is_full() { return getenv("DETENT_FULL") != nullptr; }

/// The lines of all configurations, written to the file DETENT_NUMBERS_TABLE when the program ends.
struct Table {
  std::map<std::string, std::string> lines;
  ~Table() {
    const char* path = getenv("DETENT_NUMBERS_TABLE");
    if (path == nullptr) return;
    std::ofstream file(path);
    file << "# Errors of the number layer\n\n"
            "The tests in tests/unit/math (`numbers_test`) write this page; they compare with MPFR. `fx32` gives the "
            "bits of `fx64`\nin every line. \"exhaustive\": every argument of the domain was tested. \"strided\": only "
            "a fixed sequence of arguments was\ntested, so the largest error over the domain may be greater.\n\n"
            "| configuration | kernel | domain | rounding | max error | unit | bound | at | arguments |\n"
            "|---|---|---|---|---|---|---|---|---|\n";
    for (const auto& line : lines) file << line.second << "\n";
  }
};
inline Table& table() {
  static Table instance;
  return instance;
}

/// One line of the table: the worst error of a kernel, and the proof that it is within its bound.
struct Line {
  const char* config;
  int order;
  const char* kernel;
  const char* domain;
  const char* rounding;
  const char* unit;
  double worst = -1;
  std::string at = {};
  uint64_t count = 0;

  template <class Where>
  void take(double error, const Where& where) {
    ++count;
    if (error > worst) {
      worst = error;
      at = where();
    }
  }
  void finish(double bound, const char* how) {
    EXPECT_GE(worst, 0) << kernel << ": nothing was measured";
    EXPECT_LE(worst, bound) << kernel << " at " << at;
    char text[600];
    snprintf(text, sizeof text, "| %s | %s | %s | %s | %.4f | %s | %.4g | %s | %s, %.3g |", config, kernel, domain,
             rounding, worst, unit, bound, at.c_str(), how, static_cast<double>(count));
    char key[32];
    snprintf(key, sizeof key, "%s %03d", config[1] == 'x' ? "0" : config, order);
    if (std::string(config) != "fx32") table().lines[key] = text;
  }
};

template <class... Args>
std::string format(const char* pattern, Args... args) {
  char text[200];
  snprintf(text, sizeof text, pattern, args...);
  return text;
}

}  // namespace detent_oracle

namespace detent {
inline namespace DETENT_NAMESPACE {

using detent_oracle::Big;
using detent_oracle::Big3;

inline constexpr const char* k_config_name = config_text(k_config);

template <class Int, int frac>
Big big(Fixed<Int, frac> a) {
  return Big::scaled(a.raw, -frac);
}
inline Big big(float a) { return Big(a); }
inline Big big(double a) { return Big(a); }
#if DETENT_FIXED
inline Big big(Scaled a) { return Big::scaled(a.mantissa, a.exponent); }
#endif
template <class T>
Big3 big(const Vec3<T>& v) {
  return {big(v.x), big(v.y), big(v.z)};
}

/// An argument for the table: the raw integer, or the float exactly.
template <class Int, int frac>
std::string show(Fixed<Int, frac> a) {
  return detent_oracle::format("%lld", static_cast<long long>(a.raw));
}
inline std::string show(double a) { return detent_oracle::format("%a", a); }
template <class T>
std::string show(const Vec3<T>& v) {
  return show(v.x) + " " + show(v.y) + " " + show(v.z);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
