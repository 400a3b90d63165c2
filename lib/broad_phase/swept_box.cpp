#include "broad_phase/swept_box.h"

#include "base/unroll.h"
#include "distance/pair.h"
#include "math/bits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A *grain* is four units of integer_from(), so that the difference of two coordinates in grains fits in 64 bits.
constexpr int k_grain_steps_bits = 2;
/// A grain is 2^k_grain_bits units of 2^-46 m.
constexpr int k_grain_bits = k_metre_bits - (k_coord_bits - k_grain_steps_bits);
constexpr int k_cells_bits = 29;
constexpr int64_t k_place_limit = int64_t{1} << 30;
/// The bounds of each shape are enlarged by 2^-k_tolerance_bits of their longest side. This is enough: the tolerance of
/// time_of_impact() is below 2^-18.7 of the sum of the longest sides of both shapes, and the rounding errors of bounds
/// and of closest_points() are far smaller.
constexpr int k_tolerance_bits = 18;

int64_t grains_of(Coord x) { return integer_from(x) >> k_grain_steps_bits; }

/// Clamps a coordinate of a Place, in cells, to +-k_place_limit, so that its products fit 64 bits. This changes no
/// result, because the path is less than 2^29 cells long and so ends before the limit.
int64_t clamped_place(int64_t value) {
  return value < -k_place_limit ? -k_place_limit : value > k_place_limit ? k_place_limit : value;
}

int64_t rounded_up(int64_t raw, int bits) { return (raw + (int64_t{1} << bits) - 1) >> bits; }

}  // namespace

SweptBox::SweptBox(const Position& centre, const Vec64& half, const Vec64& displacement, int64_t distance_max) {
  const uint64_t largest = magnitudes(half) | magnitudes(displacement) | static_cast<uint64_t>(distance_max);
  const int length = bit_length_64(largest) + 1;  // + 1, because a sum of two lengths must fit
  cell_bits_ = length - k_cells_bits > k_grain_bits ? length - k_cells_bits : k_grain_bits;
  grain_shift_ = cell_bits_ - k_grain_bits;
  const int64_t displacements[3] = {displacement.x, displacement.y, displacement.z},
                halves[3] = {half.x, half.y, half.z};
  int widest = 0;
  int64_t tolerance = 0;  // 2^-k_tolerance_bits of the longest side of the box
  for (const int64_t side : halves)
    tolerance = side >> (k_tolerance_bits - 1) > tolerance ? side >> (k_tolerance_bits - 1) : tolerance;
  for (int i = 0; i < 3; ++i) {
    centre_[i] = grains_of(centre.*k_axes[i]);
    displacement_[i] = static_cast<int32_t>(displacements[i] >> cell_bits_);
    // the + 1 covers the rounding of displacement_
    half_[i] = static_cast<int32_t>(rounded_up(halves[i] + tolerance, cell_bits_) + 1);
    if (magnitude_64(displacements[i]) > magnitude_64(displacements[widest])) widest = i;
  }
  axis_ = k_axes[widest];
  forward_ = displacements[widest] > 0;
  shorten(1.0);
}

void SweptBox::shorten(Fraction end) {
  const int64_t part = (end.raw + (int64_t{1} << 32) - 1) >> 32;  // in units of 2^-30, rounded up
  for (int i = 0; i < 3; ++i) {
    const int64_t displacement = displacement_[i] * part;
    from_[i] = displacement < 0 ? displacement >> 30 : 0;
    to_[i] = displacement > 0 ? (displacement + (int64_t{1} << 30) - 1) >> 30 : 0;
  }
}

SweptBox::Place SweptBox::place_of(const Bounds& bounds) const {
  int64_t low[3], high[3], longest = 0;
  DETENT_UNROLL
  for (int i = 0; i < 3; ++i) {
    // A margin of two grains (8 units of integer_from()) covers the rounding of the centre, the bounds and the
    // positions.
    low[i] = (grains_of(bounds.lower.*k_axes[i]) - centre_[i] - 2) >> grain_shift_;
    high[i] = ((grains_of(bounds.upper.*k_axes[i]) - centre_[i] + 3) >> grain_shift_) + 1;
    const int64_t side = high[i] - low[i];
    longest = side > longest ? side : longest;
  }
  const int64_t margin = (longest >> k_tolerance_bits) + 1;
  Place place;
  DETENT_UNROLL
  for (int i = 0; i < 3; ++i) {
    place.low[i] = low[i] - margin - half_[i];
    place.high[i] = high[i] + margin + half_[i];
  }
  return place;
}

bool SweptBox::meets(const Place& place) const {
  DETENT_UNROLL
  for (int i = 0; i < 3; ++i) {
    if (to_[i] < place.low[i] || place.high[i] < from_[i]) return false;
  }
  // Separating-axis test of the path, as an infinite line, on the cross products of the path and each coordinate axis.
  // `across` is the distance of the line from the middle of the bounds along such a cross product, in half cells, times
  // the length of the cross product.
  int64_t sum[3], side[3];
  DETENT_UNROLL
  for (int i = 0; i < 3; ++i) {
    const int64_t low = clamped_place(place.low[i]), high = clamped_place(place.high[i]);
    sum[i] = low + high;
    side[i] = high - low;
  }
  DETENT_UNROLL
  for (int i = 0; i < 3; ++i) {
    const int y = i == 2 ? 0 : i + 1, z = 3 - i - y;
    const uint64_t across = magnitude_64(displacement_[y] * sum[z] - displacement_[z] * sum[y]);
    if (across > magnitude_64(displacement_[y] * side[z]) + magnitude_64(displacement_[z] * side[y])) return false;
  }
  return true;
}

Fraction SweptBox::entry(const Place& place) const {
  constexpr int k_bits = 33;
  uint64_t latest = 0;
  for (int i = 0; i < 3; ++i) {
    const int64_t ahead = clamped_place(displacement_[i] > 0 ? place.low[i] : -place.high[i]);
    if (displacement_[i] == 0 || ahead <= 0) continue;
    const uint64_t part = (static_cast<uint64_t>(ahead) << k_bits) / magnitude_64(displacement_[i]);
    latest = part > latest ? part : latest;
  }
  constexpr uint64_t k_tick_end = uint64_t{1} << k_bits;
  return Fraction::from_raw(
      static_cast<int64_t>((latest < k_tick_end ? latest : k_tick_end) << (Fraction::k_frac - k_bits)));
}

bool SweptBox::is_near(const Place& place, int64_t distance_max) const {
  // The error of a distance has a part that is proportional to the distance of the centres. The term distance_max 2^-22
  // covers this part.
  const int64_t cells = rounded_up(distance_max + (distance_max >> 22), cell_bits_) + 1;
  for (int i = 0; i < 3; ++i) {
    if (place.low[i] > cells || place.high[i] < -cells) return false;
  }
  return true;
}

int64_t SweptBox::gap(const Place& place) const {
  int64_t widest = 0;
  for (int i = 0; i < 3; ++i) {
    const int64_t apart = place.low[i] > -place.high[i] ? place.low[i] : -place.high[i];
    widest = apart > widest ? apart : widest;
  }
  constexpr int64_t k_far = int64_t{1} << k_cells_bits;
  return (widest < k_far ? widest : k_far) << cell_bits_;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
