#include "math/trig.h"

#if defined(DETENT_F64)

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

// pi/2 as the sum of three parts. The first two have at most 33 bits, so the product of n and each of them is exact for
// |n| < 2^20.
constexpr double k_half_pi_high = 0x1.921fb544p+0;
constexpr double k_half_pi_middle = 0x1.0b4611a6p-34;
constexpr double k_half_pi_low = 0x1.3198a2e037073p-69;
constexpr double k_two_over_pi = 0x1.45f306dc9c883p-1;
constexpr double k_pi = 0x1.921fb54442d18p+1;

/// The integer nearest to value (ties away from zero). Range: |value| < 2^31.
int32_t nearest_integer(double value) { return static_cast<int32_t>(value + (value < 0 ? -0.5 : 0.5)); }

/// atan(z), as z + z^3 P(z^2) with a polynomial P of degree 11. Range: |z| <= tan(pi/8). Error: below 2^-57, and the
/// rounding of the operations.
double arc_tangent_near_zero(double z) {
  constexpr double k_coefficients[] = {
      -0.3333333333333332758084002, 0.1999999999999769059501022,   -0.1428571428539070722007244,
      0.1111111108834626802235823,  -0.09090908150616313300923461, 0.07692282896534730782931211,
      -0.0666622879684013755552683, 0.05877041805275249576886364,  -0.05218533421841028618272849,
      0.04504075123371850009029289, -0.03348672012724280089157127, 0.01520763345773660315532875};
  const double s = z * z;
  double sum = k_coefficients[11];
  for (int i = 10; i >= 0; --i) sum = sum * s + k_coefficients[i];
  return z + z * (s * sum);
}

}  // namespace

void sine_cosine(Angle angle, Unit& sine, Unit& cosine) {
  const int32_t n = nearest_integer(angle.radians * k_two_over_pi);
  const double x = ((angle.radians - n * k_half_pi_high) - n * k_half_pi_middle) - n * k_half_pi_low;
  const double s = x * x;
  // Minimax polynomials for the sine and for the cosine. Before the rounding of their coefficients, their errors are
  // 2^-58 and 2^-64.
  const double a =
      x + x * (s * (-0.1666666666666663202567856 +
                    s * (0.008333333333322413545897017 +
                         s * (-0.000198412698298077782717843 +
                              s * (0.000002755731369191554310595251 +
                                   s * (-2.505075811569731874203652e-8 + s * 1.589679571344541751290299e-10))))));
  const double rest = s * s *
                      (0.04166666666666659947795544 +
                       s * (-0.001388888888887412422405876 +
                            s * (0.00002480158728948233934724466 +
                                 s * (-0.000000275573143523721727687973 +
                                      s * (2.08757232781319945135107e-9 - s * 1.135964804225986135483053e-11)))));
  // The cosine, 1 - s/2 + rest, corrected by the rounding error of 1 - s/2.
  const double half = 0.5 * s;
  const double head = 1.0 - half;
  const double b = head + (((1.0 - head) - half) + rest);
  const uint32_t quarter = static_cast<uint32_t>(n) & 3;
  const bool odd = (quarter & 1) != 0;
  const double u = odd ? b : a;
  const double v = odd ? a : b;
  sine = quarter >= 2 ? -u : u;
  cosine = quarter == 1 || quarter == 2 ? -v : v;
}

void sine_cosine_of_half(Angle angle, Unit& sine, Unit& cosine) { sine_cosine({0.5 * angle.radians}, sine, cosine); }

void sine_cosine_of_half_radians(Real angle, Unit& sine, Unit& cosine) { sine_cosine({0.5 * angle}, sine, cosine); }

Angle angle_from_radians(Real angle) { return {angle}; }

Real radians(Angle angle) {
  if (-k_pi <= angle.radians && angle.radians < k_pi) return angle.radians;
  const int32_t n = 4 * nearest_integer(angle.radians * (0.25 * k_two_over_pi));
  const double wrapped = ((angle.radians - n * k_half_pi_high) - n * k_half_pi_middle) - n * k_half_pi_low;
  return wrapped < k_pi ? wrapped : -k_pi;
}

Angle arc_tangent(Unit y, Unit x) {
  const double y_size = abs(y);
  const double x_size = abs(x);
  const bool steep = y_size > x_size;
  const double large = steep ? y_size : x_size;
  const double small = steep ? x_size : y_size;
  if (large == 0) return {0.0};
  constexpr double k_tangent_of_eighth_pi = 0.41421356237309503;
  double angle = small > k_tangent_of_eighth_pi * large
                     ? 0.25 * k_pi + arc_tangent_near_zero((small - large) / (small + large))
                     : arc_tangent_near_zero(small / large);
  if (steep) angle = 0.5 * k_pi - angle;
  if (x < 0) angle = k_pi - angle;
  return {y < 0 ? -angle : angle};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
