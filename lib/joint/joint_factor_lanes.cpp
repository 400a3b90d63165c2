#include "joint/joint_factor.h"

/// The parts of JointFactor that process the rows of a joint side by side. The upper half of a joint's own block is in
/// JointLanes::upper: element (k, l) of it is element (l, k) of JointWork::response.
#if DETENT_JOINT_LANES
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The first `count` rows of a block, `stride` numbers apart.
struct BlockRows {
  const Real* first;
  uint32_t stride;
  uint32_t count;
};
/// Factors that are `stride` numbers apart.
struct FactorList {
  const Real* first;
  uint32_t stride;
};

/// Subtracts from `target` the sum of the rows times their factors.
template <bool wide>
void subtract_rows(const BlockRows& rows, const FactorList& factors, Real* target) {
  RowLanes<wide> sum;
  for (uint32_t k = 0; k < rows.count; ++k)
    sum.add(RowLanes<wide>::from(rows.first + k * rows.stride), factors.first[k * factors.stride]);
  (RowLanes<wide>::from_six(target) - sum).put(target);
}

/// The products of four rows with a vector.
template <bool wide>
RowFour products(const Real* const (&row)[k_rows_of_four], const RowLanes<wide>& v) {
  RowFour a = load_four(row[0]) * v.low, b = load_four(row[1]) * v.low;
  RowFour c = load_four(row[2]) * v.low, d = load_four(row[3]) * v.low;
  transpose(a, b, c, d);
  RowFour sum = a + b + c + d;
  if constexpr (wide) {
    RowFour e = load_four(row[0] + k_rows_of_four) * v.high, f = load_four(row[1] + k_rows_of_four) * v.high;
    RowFour g = load_four(row[2] + k_rows_of_four) * v.high, h = load_four(row[3] + k_rows_of_four) * v.high;
    transpose(e, f, g, h);
    sum = sum + e + f;
  }
  return sum;
}
/// Subtracts the product of a block of `height` rows with a vector from `rest`.
template <bool wide>
void subtract_products(const Real* block, uint32_t height, const Real* vector, Real* rest) {
  constexpr uint32_t k_stride = wide ? k_row_room : k_rows_of_four;
  const RowLanes<wide> v = RowLanes<wide>::from_six(vector);
  const auto four = [&](uint32_t first) {
    const Real* row[k_rows_of_four];
    for (uint32_t i = 0; i < k_rows_of_four; ++i) row[i] = block + (first + i < height ? first + i : first) * k_stride;
    return products(row, v);
  };
  store_four(load_four(rest) - four(0), rest);
  if (height > k_rows_of_four)
    store_pair(load_pair(rest + k_rows_of_four) - four(k_rows_of_four), rest + k_rows_of_four);
}

/// Adds the magnitudes of the fill-in between two joints, for which there was no room, to the diagonals of both joints.
void make_up_fill(const JointWork& third, const JointWork& other, const BlockRows& known, const Real* scaled,
                  JointLanes& of_third, JointLanes& of_other) {
  for (uint32_t i = 0; i < third.rows; ++i) {
    for (uint32_t m = 0; m < other.rows; ++m) {
      Real sum = k_zero;
      for (uint32_t k = 0; k < known.count; ++k) sum += known.first[k * known.stride + i] * scaled[k * k_row_room + m];
      of_third.upper[i][i] += abs(sum);
      of_other.upper[m][m] += abs(sum);
    }
  }
}

}  // namespace

void JointFactor::start(JointWork& work) {
  JointLanes& lanes = lanes_of(stage_, work);
  fill_lanes(work, lanes);
  for (uint32_t k = work.rows; k < k_joint_rows_max; ++k) work.target[k] = work.side[k] = work.impulse[k] = k_zero;
  for (uint32_t k = 0; k < work.rows; ++k) {
    store_four(RowFour{}, lanes.upper[k]);
    store_four(RowFour{}, lanes.upper[k] + k_rows_of_four);
  }
}

template <bool wide>
void JointFactor::add_responses_of_end(JointWork& work, uint32_t end) {
  const JointBody& body = stage_.bodies[work.body[end]];
  if (body.mobile == 0) return;
  JointLanes& lanes = lanes_of(stage_, work);
  // The motion by a unit impulse of each row.
  RowLanes<wide> motion[6];
  for (int i = 0; i < 3; ++i) {
    motion[i] = RowLanes<wide>::from(lanes.column[end][i]) * body.pushed;
    motion[3 + i] = column_sum<wide>(lanes.column[end], 3, body.turned[i]);
  }
  for (uint32_t m = 0; m < work.rows; ++m) {
    const Real* const row = lanes.row[end][m];
    RowLanes<wide> linear = motion[0] * row[0], angular = motion[3] * row[4];
    for (int i = 1; i < 3; ++i) {
      linear.add(motion[i], row[i]);
      angular.add(motion[3 + i], row[4 + i]);
    }
    (RowLanes<wide>::from_six(lanes.upper[m]) + (linear + angular)).put(lanes.upper[m]);
  }
  if (work.coupling == k_no_link) return;
  Real by_row[6][k_row_room];
  for (int i = 0; i < 6; ++i) {
    store_four(motion[i].low, by_row[i]);
    store_four(motion[i].high, by_row[i] + k_rows_of_four);
  }
  for (uint32_t at = work.coupling; at != k_no_link; at = stage_.couplings[at].next[0]) {
    const JointCoupling& coupling = stage_.couplings[at];
    const JointWork& other = stage_.work[coupling.joint[1]];
    const JointLanes& lanes_of_other = lanes_of(stage_, other);
    for (uint32_t far = 0; far < 2; ++far) {
      if (other.body[far] != work.body[end]) continue;
      with_width(is_wide(other), [&](auto width) {
        using Lanes = RowLanes<decltype(width)::wide>;
        constexpr uint32_t k_stride = decltype(width)::wide ? k_row_room : k_rows_of_four;
        Real* const block = block_of(coupling);
        for (uint32_t k = 0; k < work.rows; ++k) {
          const Vec3<Real> linear = {by_row[0][k], by_row[1][k], by_row[2][k]};
          const Vec3<Real> angular = {by_row[3][k], by_row[4][k], by_row[5][k]};
          const Lanes speed = column_sum<decltype(width)::wide>(lanes_of_other.column[far], 0, linear) +
                              column_sum<decltype(width)::wide>(lanes_of_other.column[far], 3, angular);
          const Lanes before = Lanes::from_six(block + k * k_stride);
          (end == far ? before + speed : before - speed).put(block + k * k_stride);
        }
      });
    }
  }
}

void JointFactor::add_responses(JointWork& work) {
  with_width(is_wide(work), [&](auto width) {
    for (uint32_t end = 0; end < 2; ++end) add_responses_of_end<decltype(width)::wide>(work, end);
  });
}

template <bool wide>
void JointFactor::eliminate_own(JointWork& work) {
  Real(&upper)[k_joint_rows_max][k_row_room] = lanes_of(stage_, work).upper;
  for (uint32_t k = 0; k < work.rows; ++k) {
    work.inverse[k] = scaled_reciprocal(max(upper[k][k], work.least[k]));
    const RowLanes<wide> over = RowLanes<wide>::from(upper[k]) * work.inverse[k];
    for (uint32_t m = k + 1; m < work.rows; ++m) (RowLanes<wide>::from(upper[m]) - over * upper[k][m]).put(upper[m]);
    over.put(upper[k]);
  }
}

void JointFactor::eliminate(JointWork& work) {
  with_width(is_wide(work), [&](auto width) { eliminate_own<decltype(width)::wide>(work); });
  const uint32_t rows = work.rows;
  const Real(&upper)[k_joint_rows_max][k_row_room] = lanes_of(stage_, work).upper;
  for (uint32_t at = work.coupling; at != k_no_link; at = stage_.couplings[at].next[0]) {
    const JointCoupling& coupling = stage_.couplings[at];
    const uint32_t index = coupling.joint[1];
    JointWork& other = stage_.work[index];
    JointLanes& lanes_of_other = lanes_of(stage_, other);
    const uint32_t stride = block_stride(other.rows);
    Real* const block = block_of(coupling);
    Real scaled[k_joint_rows_max][k_row_room];  // the block over the pivots
    with_width(is_wide(other), [&](auto width) {
      using Lanes = RowLanes<decltype(width)::wide>;
      for (uint32_t k = 0; k < rows; ++k) {
        Real* const row = block + k * stride;
        if (k > 0) subtract_rows<decltype(width)::wide>({block, stride, k}, {&upper[0][k], k_row_room}, row);
        (Lanes::from(row) * work.inverse[k]).put(scaled[k]);
      }
      for (uint32_t m = 0; m < other.rows; ++m)
        subtract_rows<decltype(width)::wide>({block, stride, rows}, {&scaled[0][m], k_row_room},
                                             lanes_of_other.upper[m]);
    });
    // The blocks of the couplings before this one in the list are already multiplied by L^-1.
    for (uint32_t before = work.coupling; before != at; before = stage_.couplings[before].next[0]) {
      const JointCoupling& known = stage_.couplings[before];
      JointWork& third = stage_.work[known.joint[1]];
      const JointCoupling* const between = find(known.joint[1], index);
      const BlockRows of_third = {block_of(known), block_stride(third.rows), rows};
      if (between == nullptr) {
        make_up_fill(third, other, of_third, scaled[0], lanes_of(stage_, third), lanes_of_other);
        continue;
      }
      // The rows of a coupling's block are the rows of the joint that is eliminated first.
      Real* const target = block_of(*between);
      const bool turned = other.place < third.place;
      const JointWork &first = turned ? other : third, &second = turned ? third : other;
      const BlockRows of_other = {scaled[0], k_row_room, rows};
      const BlockRows &of_second = turned ? of_third : of_other, &of_first = turned ? of_other : of_third;
      with_width(is_wide(second), [&](auto width) {
        for (uint32_t i = 0; i < first.rows; ++i)
          subtract_rows<decltype(width)::wide>(of_second, {of_first.first + i, of_first.stride},
                                               target + i * block_stride(second.rows));
      });
    }
  }
}

Scaled JointFactor::substitute() {
  EnergySum energy;
  for (const uint32_t index : order_) {
    JointWork& work = stage_.work[index];
    const Real(&upper)[k_joint_rows_max][k_row_room] = lanes_of(stage_, work).upper;
    Real over[k_joint_rows_max];
    for (uint32_t k = 0; k < work.rows; ++k) {
      ProductSum sum;
      for (uint32_t m = 0; m < k; ++m) sum.add(upper[m][k], work.side[m]);
      work.side[k] -= sum.value();
      bool clamped = false;
      over[k] = multiply(work.side[k], work.inverse[k], clamped);
      if (clamped) ++saturated;
      energy.add(work.side[k], over[k]);
    }
    for (uint32_t at = work.coupling; at != k_no_link; at = stage_.couplings[at].next[0]) {
      const JointCoupling& coupling = stage_.couplings[at];
      JointWork& other = stage_.work[coupling.joint[1]];
      with_width(is_wide(other), [&](auto width) {
        constexpr uint32_t k_stride = decltype(width)::wide ? k_row_room : k_rows_of_four;
        subtract_rows<decltype(width)::wide>({block_of(coupling), k_stride, work.rows}, {over, 1}, other.side);
      });
    }
  }
  return energy.value();
}

void JointFactor::solve() {
  for (uint32_t place = order_.count; place-- > 0;) {
    JointWork& work = stage_.work[order_[place]];
    Real rest[k_row_room];
    store_four(load_four(work.side), rest);
    store_pair(load_pair(work.side + k_rows_of_four), rest + k_rows_of_four);
    for (uint32_t at = work.coupling; at != k_no_link; at = stage_.couplings[at].next[0]) {
      const JointCoupling& coupling = stage_.couplings[at];
      const JointWork& other = stage_.work[coupling.joint[1]];
      with_width(is_wide(other), [&](auto width) {
        subtract_products<decltype(width)::wide>(block_of(coupling), work.rows, other.impulse, rest);
      });
    }
    for (uint32_t k = 0; k < work.rows; ++k) {
      bool clamped = false;
      work.impulse[k] = clamp(multiply(rest[k], work.inverse[k], clamped), -k_solved_max, k_solved_max);
      if (clamped) ++saturated;
    }
    const Real(&upper)[k_joint_rows_max][k_row_room] = lanes_of(stage_, work).upper;
    for (uint32_t k = work.rows; k-- > 0;) {
      for (uint32_t m = k + 1; m < work.rows; ++m) work.impulse[k] -= upper[k][m] * work.impulse[m];
    }
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
