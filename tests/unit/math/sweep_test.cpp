#include <math.h>

#include <algorithm>
#include <vector>

#include "math/root.h"
#include "math/trig.h"
#include "oracle.h"
#include "tests/common/support/test.h"
#if !defined(DETENT_F64)
#include "math/float_bits.h"
#include "math/trig_integer.h"
#endif

/// Kernels of one 32-bit argument, over all of them under DETENT_FULL=1 and strided otherwise.
///
/// MPFR is too slow for 2^32 points. The sines come from two tables of 2^16 nodes each, computed by MPFR and rounded to
/// the 64 bits of long double, and the addition theorem: error below 2^-61, so below 2^-30 of the unit in the table.
/// The roots come from long double's own correctly rounded root. Each stated bound has room for the error of this
/// reference.
namespace detent {
inline namespace DETENT_NAMESPACE {

namespace oracle = detent_oracle;
using oracle::Line;

static_assert(__LDBL_MANT_DIG__ == 64, "the sweeps run on hosts with x87 long double");

const char* how() { return oracle::is_full() ? "exhaustive" : "strided"; }
/// Odd, so that all values of the low bits occur.
[[maybe_unused]] uint64_t stride() { return oracle::is_full() ? 1 : 4099; }
[[maybe_unused]] std::string show_integer(int64_t a) { return oracle::format("%lld", static_cast<long long>(a)); }

#if !defined(DETENT_F64)
struct SineTable {
  struct Node {
    long double sine;
    long double cosine;
  };
  std::vector<Node> coarse;
  std::vector<Node> fine;

  /// The sine of t 2^-34 turns is found from two tables: coarse steps of 2^-18 turns around zero, fine steps of 2^-34.
  SineTable() {
    for (int i = 0; i < 0x10000; ++i) {
      coarse.push_back(node(i - 0x8000, -18));
      fine.push_back(node(i, -34));
    }
  }
  static Node node(int64_t turns, int exponent) {
    const Big angle = Big::scaled(turns, exponent + 1) * Big::pi();
    return {mpfr_get_ld(oracle::sine(angle).value, MPFR_RNDN), mpfr_get_ld(oracle::cosine(angle).value, MPFR_RNDN)};
  }
  Node at(int32_t t) const {
    const Node& a = coarse[static_cast<size_t>((t >> 16) + 0x8000)];
    const Node& b = fine[static_cast<size_t>(t & 0xffff)];
    return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
  }
};

DETENT_TEST(sweep, the_table_of_sines_is_as_precise_as_the_sweep_needs) {
  const SineTable table;
  for (int64_t t = INT32_MIN; t <= INT32_MAX; t += 1000003) {
    const Big angle = Big::scaled(t, -33) * Big::pi();
    const SineTable::Node node = table.at(static_cast<int32_t>(t));
    EXPECT_LE(fabsl(node.sine - mpfr_get_ld(oracle::sine(angle).value, MPFR_RNDN)), 0x1p-61L) << t;
    EXPECT_LE(fabsl(node.cosine - mpfr_get_ld(oracle::cosine(angle).value, MPFR_RNDN)), 0x1p-61L) << t;
  }
}

// The kernel reduces every angle exactly to the nearest quarter turn. Its result depends on t alone, and all t cover
// all angles, which are multiples of 2^-34 turns.
DETENT_TEST(sweep, sines_and_cosines_of_all_angles_are_within_their_bound) {
  if (k_config == Config::fx32) GTEST_SKIP() << "the kernel and its bits are those of fx64";
  Line line{k_config_name,
            50,
            "sine_cosine, all three forms",
            "all multiples of 2^-34 turns",
            "to nearest, plus the kernel's",
            "step"};
  const SineTable table;
  const auto take = [&](int64_t t) {
    const SineTable::Node truth = table.at(static_cast<int32_t>(t));
    const SineCosineRaw raw = sine_cosine_raw(t);
#if DETENT_FIXED
    const long double sine = raw.sine;
    const long double cosine = raw.cosine;
    constexpr long double k_scale = 0x1p30L;
#else
    const long double sine = float_from_integer<float>(raw.sine, -30) * 0x1p24f;
    const long double cosine = float_from_integer<float>(raw.cosine, -30) * 0x1p24f;
    constexpr long double k_scale = 0x1p24L;
#endif
    const long double error = std::max(fabsl(sine - truth.sine * k_scale), fabsl(cosine - truth.cosine * k_scale));
    line.take(static_cast<double>(error), [&] { return show_integer(t); });
  };
  // f32 rounds the raw numbers that the sweep in fx64 tests: a part of the arguments is enough.
  const uint64_t step = DETENT_FIXED ? stride() : 4099;
  for (int64_t t = INT32_MIN; t <= INT32_MAX; t += static_cast<int64_t>(step)) take(t);
  // The worst cases of the exhaustive sweep.
  for (const int64_t t : {2136614942, -1982753036, -2100746850}) take(t);
  line.finish(k_sine_error, DETENT_FIXED ? how() : "strided");
}
#endif

#if DETENT_FIXED
DETENT_TEST(sweep, unit_roots_are_nearest_for_all_arguments) {
  if (k_config == Config::fx32) GTEST_SKIP() << "the kernel and its bits are those of fx64";
  Line line{k_config_name, 29, "square_root(Unit)", "all a >= 0", "to nearest", "2^-30"};
  for (uint64_t a = 0; a < uint64_t{1} << 31; a += stride()) {
    const uint64_t square = a << 30;
    const uint64_t root = static_cast<uint64_t>(square_root(Unit::from_raw(static_cast<int32_t>(a))).raw);
    // Exact: (root - 1/2)^2 < square < (root + 1/2)^2.
    ASSERT_LE(square, root * root + root) << a;
    ASSERT_GE(square + root, root * root + (root != 0 ? 1 : 0)) << a;
    line.take(static_cast<double>(fabsl(sqrtl(static_cast<long double>(square)) - static_cast<long double>(root))),
              [&] { return show_integer(static_cast<int64_t>(a)); });
  }
  line.finish(0.5, how());
}

DETENT_TEST(sweep, reciprocal_roots_of_all_arguments_are_within_their_bound) {
  if (k_config == Config::fx32) GTEST_SKIP() << "the kernel and its bits are those of fx64";
  Line line{k_config_name, 28, "reciprocal_root", "all of [1/4, 1), Q32", "the kernel's", "2^-31"};
  const auto take = [&line](uint64_t a) {
    const long double truth = 0x1p47L / sqrtl(static_cast<long double>(a));
    line.take(static_cast<double>(fabsl(static_cast<long double>(reciprocal_root(static_cast<uint32_t>(a))) - truth)),
              [&] { return show_integer(static_cast<int64_t>(a)); });
  };
  for (uint64_t a = uint64_t{1} << 30; a < uint64_t{1} << 32; a += stride()) take(a);
  for (const uint64_t a : {uint64_t{1} << 30, uint64_t{UINT32_MAX}}) take(a);
  line.finish(k_reciprocal_root_error, how());
}
#else
DETENT_TEST(sweep, portable_roots_of_all_floats_are_correctly_rounded) {
#if defined(DETENT_F32)
  Line line{k_config_name, 28, "square_root_portable", "all positive floats", "to nearest, ties to even", "ulp"};
  for (uint64_t bits = 1; bits < 0x7f800000; bits += stride()) {
    const float a = __builtin_bit_cast(float, static_cast<uint32_t>(bits));
    const float root = square_root_portable(a);
    ASSERT_EQ(root, sqrtf(a)) << a;  // the host's instruction, IEEE 754
    const long double ulp =
        static_cast<long double>(__builtin_bit_cast(float, __builtin_bit_cast(uint32_t, root) + 1) - root);
    line.take(static_cast<double>(fabsl(sqrtl(static_cast<long double>(a)) - static_cast<long double>(root)) / ulp),
              [&] { return show(a); });
  }
#else
  Line line{k_config_name, 28, "square_root_portable", "positive normal doubles", "to nearest, ties to even", "ulp"};
  uint64_t bits = 0x10000000000000;
  const uint64_t step = oracle::is_full() ? 0x7ffffffffffff / 5000 : 0x7fffffffffffff / 100;
  for (; bits < 0x7ff0000000000000; bits += step) {
    const double a = __builtin_bit_cast(double, bits);
    const double root = square_root_portable(a);
    ASSERT_EQ(root, sqrt(a)) << a;
    const double ulp = __builtin_bit_cast(double, __builtin_bit_cast(uint64_t, root) + 1) - root;
    line.take(oracle::distance(big(root) / big(ulp), oracle::root(big(a)) / big(ulp), 0), [&] { return show(a); });
  }
#endif
  line.finish(0.5, k_config == Config::f64 ? "strided" : how());
}
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
