#pragma once
#include "base/unroll.h"
#include "joint/joint.h"

/// The rows of a joint side by side, in two registers of four floats: rows 0 to 3 (low), rows 4 and 5 (high). The high
/// register is used only if the joint has more than four rows. Every sum adds its terms in the same order as the code
/// that loops over single rows, so the results have the same bits.
#if DETENT_JOINT_LANES
namespace detent {
inline namespace DETENT_NAMESPACE {

typedef Real RowFour __attribute__((vector_size(16)));
typedef Real StoredRowFour __attribute__((vector_size(16), aligned(4)));

inline constexpr uint32_t k_rows_of_four = 4;
inline constexpr uint32_t k_row_room = 2 * k_rows_of_four;  ///< numbers of a row or column in JointLanes

inline bool is_wide(const JointWork& work) { return work.rows > k_rows_of_four; }

inline RowFour spread(Real a) { return RowFour{a, a, a, a}; }
inline RowFour load_four(const Real* from) { return *reinterpret_cast<const StoredRowFour*>(from); }
inline void store_four(const RowFour& v, Real* to) { *reinterpret_cast<StoredRowFour*>(to) = v; }
/// Loads the numbers of rows 4 and 5, followed by two zeros.
inline RowFour load_pair(const Real* from) { return RowFour{from[0], from[1], 0, 0}; }
inline void store_pair(const RowFour& v, Real* to) {
  to[0] = v[0];
  to[1] = v[1];
}
typedef int32_t RowWords __attribute__((vector_size(16)));
/// Masks that select all bits but the sign: of all lanes, or of the first three lanes.
inline constexpr RowWords k_sizes = {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX};
inline constexpr RowWords k_sizes_of_three = {INT32_MAX, INT32_MAX, INT32_MAX, 0};
/// Whether the magnitude of each lane that the mask `sizes` selects is at most `limit`.
inline bool are_within(const RowFour& v, Real limit, const RowWords& sizes) {
  typedef int64_t Halves __attribute__((vector_size(16)));
  const RowFour size = reinterpret_cast<RowFour>(reinterpret_cast<RowWords>(v) & sizes);
  const Halves within = reinterpret_cast<Halves>(size <= spread(limit));
  return (within[0] & within[1]) == -1;
}
inline void transpose(RowFour& a, RowFour& b, RowFour& c, RowFour& d) {
  const RowFour low_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), high_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const RowFour low_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5), high_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  a = __builtin_shufflevector(low_ab, low_cd, 0, 1, 4, 5);
  b = __builtin_shufflevector(low_ab, low_cd, 2, 3, 6, 7);
  c = __builtin_shufflevector(high_ab, high_cd, 0, 1, 4, 5);
  d = __builtin_shufflevector(high_ab, high_cd, 2, 3, 6, 7);
}

/// One number for each row of a joint.
template <bool wide>
struct RowLanes {
  RowFour low = {}, high = {};

  /// Reads a row or a column of JointLanes, or a row of a block.
  static RowLanes from(const Real* numbers) {
    RowLanes lanes;
    lanes.low = load_four(numbers);
    if constexpr (wide) lanes.high = load_four(numbers + k_rows_of_four);
    return lanes;
  }
  /// Reads k_joint_rows_max numbers.
  static RowLanes from_six(const Real* numbers) {
    RowLanes lanes;
    lanes.low = load_four(numbers);
    if constexpr (wide) lanes.high = load_pair(numbers + k_rows_of_four);
    return lanes;
  }
  /// Writes k_joint_rows_max numbers.
  void put(Real* numbers) const {
    store_four(low, numbers);
    if constexpr (wide) store_pair(high, numbers + k_rows_of_four);
  }
  /// Writes a row or a column of JointLanes, or a row of a block.
  void store(Real* numbers) const {
    store_four(low, numbers);
    if constexpr (wide) store_four(high, numbers + k_rows_of_four);
  }
  /// Adds `row` times `factor`.
  void add(const RowLanes& row, Real factor) {
    low += row.low * spread(factor);
    if constexpr (wide) high += row.high * spread(factor);
  }
  bool is_within(Real limit) const {
    if constexpr (wide) return are_within(low, limit, k_sizes) && are_within(high, limit, k_sizes);
    return are_within(low, limit, k_sizes);
  }
  RowLanes operator*(Real factor) const {
    RowLanes lanes;
    lanes.low = low * spread(factor);
    if constexpr (wide) lanes.high = high * spread(factor);
    return lanes;
  }
  RowLanes operator+(const RowLanes& other) const {
    RowLanes lanes;
    lanes.low = low + other.low;
    if constexpr (wide) lanes.high = high + other.high;
    return lanes;
  }
  RowLanes operator-(const RowLanes& other) const {
    RowLanes lanes;
    lanes.low = low - other.low;
    if constexpr (wide) lanes.high = high - other.high;
    return lanes;
  }
};

/// Calls visit with a constant: whether a joint has more than four rows.
template <bool k_wide>
struct Width {
  static constexpr bool wide = k_wide;
};
template <class Visit>
inline void with_width(bool wide, const Visit& visit) {
  if (wide)
    visit(Width<true>());
  else
    visit(Width<false>());
}

/// The sum of three columns, from `first` on, each times a component of v.
template <bool wide>
inline RowLanes<wide> column_sum(const Real (&column)[6][k_row_room], int first, const Vec3<Real>& v) {
  RowLanes<wide> sum = RowLanes<wide>::from(column[first]) * v.x;
  sum.add(RowLanes<wide>::from(column[first + 1]), v.y);
  sum.add(RowLanes<wide>::from(column[first + 2]), v.z);
  return sum;
}
/// One body's part of J v, with J given by its columns. The caller must negate the part of A.
template <bool wide>
inline RowLanes<wide> shown(const Real (&column)[6][k_row_room], const JointBody& body) {
  return column_sum<wide>(column, 0, body.linear_velocity) + column_sum<wide>(column, 3, body.angular_velocity);
}

inline JointLanes& lanes_of(const JointStage& stage, const JointWork& work) {
  return stage.lanes[static_cast<uint32_t>(&work - stage.work.data)];
}
/// J v for a joint's rows.
template <bool wide>
inline RowLanes<wide> joint_speeds(const JointStage& stage, const JointWork& work) {
  const JointLanes& lanes = lanes_of(stage, work);
  return shown<wide>(lanes.column[1], stage.bodies[work.body[1]]) -
         shown<wide>(lanes.column[0], stage.bodies[work.body[0]]);
}

/// Fills the rows and columns of a joint's Jacobian. Rows that the joint does not have are 0.
inline void fill_lanes(const JointWork& work, JointLanes& lanes) {
  constexpr RowWords k_first_three = {-1, -1, -1, 0};
  // Loads four numbers and clears the last. In JointRows, further numbers follow every vector.
  const auto vector = [](const Vec3<Unit>& v) {
    return reinterpret_cast<RowFour>(reinterpret_cast<RowWords>(load_four(&v.x)) & k_first_three);
  };
  for (uint32_t end = 0; end < 2; ++end) {
    Real(&row)[k_joint_rows_max][k_row_room] = lanes.row[end];
    const auto fill = [&row](uint32_t k, const RowFour& axis, const RowFour& arm) {
      store_four(axis, row[k]);
      store_four(arm, row[k] + k_rows_of_four);
    };
    uint32_t count = 0;
    if (work.points != 0) {
      const Vec3<Unit>& r = work.arm[end];
      fill(0, RowFour{1, 0, 0, 0}, RowFour{0, r.z, 0 - r.y, 0});
      fill(1, RowFour{0, 1, 0, 0}, RowFour{0 - r.z, 0, r.x, 0});
      fill(2, RowFour{0, 0, 1, 0}, RowFour{r.y, 0 - r.x, 0, 0});
      count = 3;
    }
    for (; count < work.rows; ++count) fill(count, vector(work.row[count].axis), vector(work.row[count].arm[end]));
    const uint32_t room = is_wide(work) ? k_joint_rows_max : k_rows_of_four;
    for (; count < room; ++count) fill(count, RowFour{}, RowFour{});
    for (uint32_t part = 0; part < 2; ++part) {  // linear, angular
      const uint32_t at = part * k_rows_of_four;
      Real(*const column)[k_row_room] = lanes.column[end] + 3 * part;
      RowFour a = load_four(row[0] + at), b = load_four(row[1] + at), c = load_four(row[2] + at);
      RowFour d = load_four(row[3] + at);
      transpose(a, b, c, d);
      store_four(a, column[0]);
      store_four(b, column[1]);
      store_four(c, column[2]);
      if (!is_wide(work)) continue;
      a = load_four(row[4] + at);
      b = load_four(row[5] + at);
      c = d = RowFour{};
      transpose(a, b, c, d);
      store_four(a, column[0] + k_rows_of_four);
      store_four(b, column[1] + k_rows_of_four);
      store_four(c, column[2] + k_rows_of_four);
    }
  }
}

/// The block of a coupling of two joints. It has one row for each row of the joint that is eliminated first, and one
/// column for each row of the joint that is eliminated later.
template <bool wide>
struct CouplingBlock {
  static constexpr uint32_t k_stride = wide ? k_row_room : k_rows_of_four;
  Real* first;

  Real* row(uint32_t k) const { return first + k * k_stride; }
  RowLanes<wide> at(uint32_t k) const { return RowLanes<wide>::from(row(k)); }
};

/// The sum of the first `height` rows of a block, each times a factor. The factors are `stride` apart.
template <bool wide, class Height>
inline RowLanes<wide> row_sum(const CouplingBlock<wide>& block, Height height, const Real* factor, uint32_t stride) {
  const uint32_t rows = height;
  RowLanes<wide> sum;
  DETENT_UNROLL
  for (uint32_t k = 0; k < k_joint_rows_max; ++k) {
    if (k == rows) break;
    sum.add(block.at(k), factor[k * stride]);
  }
  return sum;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
