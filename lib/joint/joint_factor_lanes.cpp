#include "joint/joint_factor.h"

/// The parts of JointFactor that process the rows of a joint side by side. The upper half of a joint's own block is in
/// JointLanes::upper: element (k, l) of it is element (l, k) of JointWork::response.
#if DETENT_JOINT_LANES
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Subtracts row_sum() from the row that starts at `row`.
template <bool wide, class Height>
inline void subtract_rows(const CouplingBlock<wide>& block, Height height, const Real* factor, uint32_t stride,
                          Real* row) {
  (RowLanes<wide>::from(row) - row_sum(block, height, factor, stride)).store(row);
}

/// The products of up to four rows of a block, from `first` on, with a vector. If the block has fewer rows, the further
/// lanes of the result are not used.
template <bool wide, class Height>
inline RowFour products(const CouplingBlock<wide>& block, uint32_t first, Height height, const RowLanes<wide>& v) {
  const uint32_t rows = height;
  const RowLanes<wide> none;
  const auto row = [&](uint32_t k) { return k < rows ? block.at(k) : none; };
  const RowLanes<wide> p = row(first), q = row(first + 1), r = row(first + 2), s = row(first + 3);
  RowFour a = p.low * v.low, b = q.low * v.low, c = r.low * v.low, d = s.low * v.low;
  transpose(a, b, c, d);
  RowFour sum = a + b + c + d;
  if constexpr (wide) {
    RowFour e = p.high * v.high, f = q.high * v.high, g = r.high * v.high, h = s.high * v.high;
    transpose(e, f, g, h);
    sum = sum + e + f;
  }
  return sum;
}
/// Subtracts the product of a block with a vector from `rest`.
template <bool wide, class Height>
inline void subtract_products(const CouplingBlock<wide>& block, Height height, const Real* vector, Real* rest) {
  const RowLanes<wide> v = RowLanes<wide>::from_six(vector);
  store_four(load_four(rest) - products(block, 0, height, v), rest);
  if (height > k_rows_of_four)
    store_pair(load_pair(rest + k_rows_of_four) - products(block, k_rows_of_four, height, v), rest + k_rows_of_four);
}

/// Adds the magnitudes of the fill-in between two joints to the diagonals of both joints, because there was no room for
/// their coupling.
template <bool wide>
void make_up_fill(const JointWork& third, const JointWork& other, const CouplingBlock<wide>& block, uint32_t height,
                  const Real (&scaled)[k_joint_rows_max][k_row_room], JointLanes& of_third, JointLanes& of_other) {
  for (uint32_t i = 0; i < third.rows; ++i) {
    for (uint32_t m = 0; m < other.rows; ++m) {
      Real sum = k_zero;
      for (uint32_t k = 0; k < height; ++k) sum += block.row(k)[i] * scaled[k][m];
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
  // Velocity (0 to 2) and angular velocity (3 to 5) of the body by a unit impulse of each row.
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
  each_coupling(work, [&](const JointCoupling& coupling) {
    const JointWork& other = stage_.work[coupling.joint[1]];
    const JointLanes& lanes_of_other = lanes_of(stage_, other);
    for (uint32_t far = 0; far < 2; ++far) {
      if (other.body[far] != work.body[end]) continue;
      with_width(is_wide(other), [&](auto width) {
        constexpr bool k_wide = decltype(width)::wide;
        const CouplingBlock<k_wide> block = {block_of(coupling)};
        for (uint32_t k = 0; k < work.rows; ++k) {
          const Vec3<Real> linear = {by_row[0][k], by_row[1][k], by_row[2][k]};
          const Vec3<Real> angular = {by_row[3][k], by_row[4][k], by_row[5][k]};
          const RowLanes<k_wide> speed = column_sum<k_wide>(lanes_of_other.column[far], 0, linear) +
                                         column_sum<k_wide>(lanes_of_other.column[far], 3, angular);
          (end == far ? block.at(k) + speed : block.at(k) - speed).store(block.row(k));
        }
      });
    }
  });
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
  with_rows(work.rows, [&](auto height) { eliminate_couplings(work, height); });
}

template <class Height>
void JointFactor::eliminate_couplings(JointWork& work, Height height) {
  const uint32_t rows = height;
  const Real(&upper)[k_joint_rows_max][k_row_room] = lanes_of(stage_, work).upper;
  // Multiplies the blocks by L^-1.
  each_coupling(work, [&](const JointCoupling& coupling) {
    with_width(is_wide(stage_.work[coupling.joint[1]]), [&](auto width) {
      const CouplingBlock<decltype(width)::wide> block = {block_of(coupling)};
      for (uint32_t k = 1; k < rows; ++k) subtract_rows(block, k, &upper[0][k], k_row_room, block.row(k));
    });
  });
  each_coupling(work, [&](const JointCoupling& coupling) {
    const JointWork& other = stage_.work[coupling.joint[1]];
    JointLanes& lanes_of_other = lanes_of(stage_, other);
    Real scaled[k_joint_rows_max][k_row_room];  // the block's rows divided by their pivots
    with_width(is_wide(other), [&](auto width) {
      const CouplingBlock<decltype(width)::wide> block = {block_of(coupling)};
      for (uint32_t k = 0; k < rows; ++k) (block.at(k) * work.inverse[k]).store(scaled[k]);
      for (uint32_t m = 0; m < other.rows; ++m)
        subtract_rows(block, height, &scaled[0][m], k_row_room, lanes_of_other.upper[m]);
    });
    each_pair(coupling, [&](const JointCoupling& further, Real* target) {
      const JointWork& third = stage_.work[further.joint[1]];
      with_width(is_wide(third), [&](auto width) {
        constexpr bool k_wide = decltype(width)::wide;
        const CouplingBlock<k_wide> block = {block_of(further)};
        if (target == nullptr) {
          make_up_fill(third, other, block, rows, scaled, lanes_of(stage_, third), lanes_of_other);
          return;
        }
        const CouplingBlock<k_wide> between = {target};
        for (uint32_t m = 0; m < other.rows; ++m)
          subtract_rows(block, height, &scaled[0][m], k_row_room, between.row(m));
      });
    });
  });
}

template <class Height>
void JointFactor::substitute_joint(JointWork& work, Height height, EnergySum& energy) {
  const uint32_t rows = height;
  const Real(&upper)[k_joint_rows_max][k_row_room] = lanes_of(stage_, work).upper;
  Real over[k_joint_rows_max] = {};
  DETENT_UNROLL
  for (uint32_t k = 0; k < rows; ++k) {
    ProductSum sum;
    for (uint32_t m = 0; m < k; ++m) sum.add(upper[m][k], work.side[m]);
    work.side[k] -= sum.value();
    bool clamped = false;
    over[k] = multiply(work.side[k], work.inverse[k], clamped);
    if (clamped) ++saturated;
    energy.add(work.side[k], over[k]);
  }
  each_coupling(work, [&](const JointCoupling& coupling) {
    JointWork& other = stage_.work[coupling.joint[1]];
    with_width(is_wide(other), [&](auto width) {
      constexpr bool k_wide = decltype(width)::wide;
      const CouplingBlock<k_wide> block = {block_of(coupling)};
      (RowLanes<k_wide>::from_six(other.side) - row_sum(block, height, over, 1)).put(other.side);
    });
  });
}

Scaled JointFactor::substitute() {
  EnergySum energy;
  for (const uint32_t index : order_) {
    JointWork& work = stage_.work[index];
    with_rows(work.rows, [&](auto height) { substitute_joint(work, height, energy); });
  }
  return energy.value();
}

template <class Height>
void JointFactor::solve_joint(JointWork& work, Height height) {
  const uint32_t rows = height;
  Real rest[k_row_room];
  store_four(load_four(work.side), rest);
  store_pair(load_pair(work.side + k_rows_of_four), rest + k_rows_of_four);
  each_coupling(work, [&](const JointCoupling& coupling) {
    const JointWork& other = stage_.work[coupling.joint[1]];
    with_width(is_wide(other), [&](auto width) {
      constexpr bool k_wide = decltype(width)::wide;
      subtract_products(CouplingBlock<k_wide>{block_of(coupling)}, height, other.impulse, rest);
    });
  });
  const Real(&upper)[k_joint_rows_max][k_row_room] = lanes_of(stage_, work).upper;
  for (uint32_t left = rows; left > 0; --left) {
    const uint32_t k = left - 1;
    bool clamped = false;
    Real impulse = clamp(multiply(rest[k], work.inverse[k], clamped), -k_solved_max, k_solved_max);
    if (clamped) ++saturated;
    for (uint32_t m = k + 1; m < rows; ++m) impulse -= upper[k][m] * work.impulse[m];
    work.impulse[k] = impulse;
  }
}

void JointFactor::solve() {
  for (uint32_t place = order_.count; place-- > 0;) {
    JointWork& work = stage_.work[order_[place]];
    with_rows(work.rows, [&](auto height) { solve_joint(work, height); });
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
