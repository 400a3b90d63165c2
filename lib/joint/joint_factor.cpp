#include "joint/joint_factor.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The softness of a row is added to the row's diagonal element. It is 2^k_softness_power times the largest diagonal
/// element of the joint's rows of the same kind (linear or angular). In `f32` the softness is as small as the precision
/// permits. The pivot of a redundant row is only its softness, and the effect of the row is below the precision of the
/// numbers. Rows of drives use k_soft_power, so they yield before locked rows. After make_softer() all rows use
/// k_soft_power. Each further call multiplies the softness by 2^k_softer_step.
#if defined(DETENT_F32)
constexpr int k_softness_power = -20;
#else
constexpr int k_softness_power = -22;
#endif
constexpr int k_soft_power = -17;
constexpr int k_softer_step = 4, k_softer_calls = 4;
/// Lower bound of a pivot, so that its reciprocal is in the range of multiply().
constexpr Real k_pivot_min = 0x1p-29;
#if DETENT_FIXED
/// Responses are scaled to about 2^k_joint_response_bits, but by at most 2^(2 k_power_max), so that speeds fit a Real.
constexpr int k_joint_response_bits = 5, k_power_max = 9;
#endif
/// Upper bound of the softness of a spring: softer springs have no effect.
constexpr Real k_spring_max = 16384.0;

/// The columns of M^-1 J^T for one body: the change of its velocity and angular velocity by a unit impulse of each row.
struct Response {
  Vec3<Real> linear_velocity[k_joint_rows_max], angular_velocity[k_joint_rows_max];

  Response(const JointWork& work, const JointBody& body, uint32_t end) {
    if (work.points != 0) {
      // Angular velocities by unit impulses at the anchor along the axes e_i: I^-1 (r x e_i), where I^-1 is symmetric.
      const Vec3<Unit>& r = work.arm[end];
      const Vec3<Real> x = cross(body.turned[0], r), y = cross(body.turned[1], r), z = cross(body.turned[2], r);
      angular_velocity[0] = {x.x, y.x, z.x};
      angular_velocity[1] = {x.y, y.y, z.y};
      angular_velocity[2] = {x.z, y.z, z.z};
      linear_velocity[0] = {body.pushed, k_zero, k_zero};
      linear_velocity[1] = {k_zero, body.pushed, k_zero};
      linear_velocity[2] = {k_zero, k_zero, body.pushed};
    }
    for (uint32_t k = first_other(work); k < work.rows; ++k) {
      const JointRow& row = work.row[k];
      const Vec3<Unit>& torque = row.arm[end];
      linear_velocity[k] = has_axis(row) ? row.axis * body.pushed : k_zero_vector;
      angular_velocity[k] = {dot(body.turned[0], torque), dot(body.turned[1], torque), dot(body.turned[2], torque)};
    }
  }
};

#if !DETENT_JOINT_LANES
/// Calls `visit` with the height and the width of a block: the numbers of rows of two joints. The usual widths are
/// compile-time constants. Both numbers are constants if both joints have only the three rows of the anchor points.
#if defined(__OPTIMIZE_SIZE__)
template <class Visit>
inline void with_sizes(uint32_t height, uint32_t width, const Visit& visit) {
  visit(height, width);
}
#else
template <class Visit>
inline void with_sizes(uint32_t height, uint32_t width, const Visit& visit) {
  constexpr ConstantRows<3> k_points;
  if (width == 3 && height == 3)
    visit(k_points, k_points);
  else if (width == 3)
    visit(height, k_points);
  else if (width == 5)
    visit(height, ConstantRows<5>());
  else if (width == 6)
    visit(height, ConstantRows<6>());
  else
    visit(height, width);
}
#endif

using Rows = Real[k_joint_rows_max][k_joint_rows_max];

/// The dot product of the first `count` elements of two vectors. The elements of `a` are `stride` apart.
template <class Count>
DETENT_SHARED inline Real product(Count count, uint32_t stride, const Real* a, const Real* b) {
  const uint32_t elements = count;
  ProductSum sum;
  DETENT_UNROLL
  for (uint32_t k = 0; k < elements; ++k) sum.add(a[k * stride], b[k]);
  return sum.value();
}

/// Calls visit(i, x_i) for the elements from `first` on of x = B^T v, with the block B.
template <class Height, class Width, class Visit>
inline void each_product(Height height, Width width, const Real* block, const Real* v, uint32_t first,
                         const Visit& visit) {
  const uint32_t rows = height, columns = width;
#if defined(__OPTIMIZE_SIZE__)
  for (uint32_t i = first; i < columns; ++i) visit(i, product(rows, columns, block + i, v));
#else
  ProductSum sum[k_joint_rows_max];
  for (uint32_t k = 0; k < rows; ++k) {
    DETENT_UNROLL
    for (uint32_t i = first; i < columns; ++i) sum[i].add(block[k * columns + i], v[k]);
  }
  DETENT_UNROLL
  for (uint32_t i = first; i < columns; ++i) visit(i, sum[i].value());
#endif
}
/// each_product() for a block of two joints that have only the rows of the anchor points: all sums are in registers.
template <class Visit>
inline void each_product(ConstantRows<3> height, ConstantRows<3> width, const Real* block, const Real* v,
                         uint32_t first, const Visit& visit) {
  DETENT_UNROLL
  for (uint32_t i = first; i < 3; ++i) visit(i, product(height, width, block + i, v));
}

/// Multiplies a coupling's block by L^-1. L is the factor of the own block of the joint `work`.
template <class Height, class Width>
inline void divide_block(const JointWork& work, Height height, Width width, Real* block) {
  const uint32_t rows = height, columns = width;
  for (uint32_t k = 1; k < rows; ++k) {
    each_product(k, width, block, work.response[k], 0, [&](uint32_t i, Real part) { block[k * columns + i] -= part; });
  }
}

/// Adds the magnitudes of the fill-in between two joints to the diagonals of both joints, because there was no room for
/// their coupling.
void make_up_product(uint32_t rows, const Real* block, const Rows& scaled, JointWork& third, JointWork& other) {
  for (uint32_t i = 0; i < third.rows; ++i) {
    for (uint32_t m = 0; m < other.rows; ++m) {
      const Real size = abs(product(rows, third.rows, block + i, scaled[m]));
      third.response[i][i] += size;
      other.response[m][m] += size;
    }
  }
}

#endif

}  // namespace

void choose_unit([[maybe_unused]] const JointStage& stage, JointWork& work) {
  work.power[0] = work.power[1] = 0;
#if DETENT_FIXED
  work.rows = work.locked_rows;
  const uint32_t motions = driven_motions(stage.joints[work.joint]);
  for (uint32_t i = 0; i < k_free_motions; ++i) {
    if (((motions >> i) & 1) != 0) work.row[work.rows++] = work.free_row[i];
  }
  Real response[k_joint_rows_max] = {k_zero, k_zero, k_zero, k_zero, k_zero, k_zero};
  const bool is_rod = static_cast<JointType>(stage.joints[work.joint].type) == JointType::distance;
  for (uint32_t end = 0; end < 2; ++end) {
    const JointBody& body = stage.bodies[work.body[end]];
    if (body.mobile == 0) continue;
    if (is_rod) {
      // The direction of a rod may rotate in the tick. The response of its row may then grow up to this bound.
      const Real trace = body.turned[0].x + body.turned[1].y + body.turned[2].z;
      response[0] += body.pushed + trace * work.arm_length[end] * work.arm_length[end];
      continue;
    }
    const Response reaction(work, body, end);
    for (uint32_t k = 0; k < work.rows; ++k) {
      Real speed[k_joint_rows_max];
      show(work, k + 1, end, reaction.linear_velocity[k], reaction.angular_velocity[k], speed);
      response[k] += speed[k];
    }
  }
  Real most[2] = {-1.0, -1.0};  // greatest response of each kind; negative if the joint has no rows of this kind
  for (uint32_t k = 0; k < work.rows; ++k) most[row_kind(work, k)] = max(most[row_kind(work, k)], response[k]);
  for (int kind = 0; kind < 2; ++kind) {
    const int wanted = (k_joint_response_bits - exponent_above(most[kind])) / 2;
    work.power[kind] = wanted < k_power_max ? wanted : k_power_max;
    if (most[kind] < k_zero) continue;
    for (const uint32_t at : work.body) {
      JointBody& body = stage.bodies[at];
      if (body.power < impulse_power(work, kind)) body.power = impulse_power(work, kind);
    }
  }
#endif
}

#if !DETENT_JOINT_LANES
void JointFactor::start(JointWork& work) {
  for (uint32_t k = 0; k < work.rows; ++k) {
    work.row_power[k] = work.power[row_kind(work, k)];
    for (uint32_t m = 0; m <= k; ++m) work.response[k][m] = k_zero;
  }
}
#endif

const JointCoupling* JointFactor::find(uint32_t one, uint32_t other) const {
  const bool turns = stage_.work[other].place < stage_.work[one].place;
  const uint32_t first = turns ? other : one, second = turns ? one : other;
  for (uint32_t at = stage_.work[first].coupling; at != k_no_link; at = stage_.couplings[at].next[0]) {
    if (stage_.couplings[at].joint[1] == second) return &stage_.couplings[at];
  }
  return nullptr;
}

void JointFactor::make() {
  for (const uint32_t index : order_) {
    JointWork& work = stage_.work[index];
    start(work);
    each_coupling(work, [&](const JointCoupling& coupling) {
      const uint32_t size = work.rows * block_stride(stage_.work[coupling.joint[1]].rows);
      Real* const block = block_of(coupling);
      for (uint32_t k = 0; k < size; ++k) block[k] = k_zero;
    });
  }
  for (const uint32_t index : order_) add_responses(stage_.work[index]);
  for (uint32_t k = 0; dropped_ && k < order_.count; ++k) make_up(order_[k]);
  // Add the softness of each row.
  const int soft_power = k_soft_power + k_softer_step * (softer_calls_ < 2 ? 0 : softer_calls_ - 1);
  for (const uint32_t index : order_) {
    JointWork& work = stage_.work[index];
    Real most[2] = {k_zero, k_zero};
    const auto kind = [&](uint32_t k) { return row_kind(work, k); };
    for (uint32_t k = 0; k < work.rows; ++k) most[kind(k)] = max(most[kind(k)], diagonal(work, k));
    for (uint32_t k = 0; k < work.rows; ++k) {
      const int power = softer_calls_ != 0 || !is_locked(work, k) ? soft_power : k_softness_power;
      work.least[k] = max(scale_by_power(most[kind(k)], power), k_pivot_min);
      diagonal(work, k) += work.least[k] + min(work.spring[k], k_spring_max);
    }
  }
  for (const uint32_t index : order_) eliminate(stage_.work[index]);
}

bool JointFactor::make_softer() {
  if (softer_calls_ == k_softer_calls) return false;
  ++softer_calls_;
  make();
  return true;
}

/// Adds to a joint's diagonal the magnitudes of the matrix elements between this joint and the neighbours for whose
/// coupling there was no room.
void JointFactor::make_up(uint32_t index) {
  JointWork& work = stage_.work[index];
  for (uint32_t end = 0; end < 2; ++end) {
    const JointBody& body = stage_.bodies[work.body[end]];
    if (body.mobile == 0) continue;
    const Response reaction(work, body, end);
    for (uint32_t link = body.first; link != k_no_link;) {
      const uint32_t other_index = link / 2, far = link % 2;
      const JointWork& other = stage_.work[other_index];
      link = other.next[far];
      if (other_index == index || find(index, other_index) != nullptr) continue;
      for (uint32_t k = 0; k < work.rows; ++k) {
        Real speed[k_joint_rows_max];
        show(other, other.rows, far, reaction.linear_velocity[k], reaction.angular_velocity[k], speed);
        for (uint32_t m = 0; m < other.rows; ++m)
          diagonal(work, k) += abs(scale_by_power(speed[m], unit_power(work, k) + unit_power(other, m)));
      }
    }
  }
}

#if !DETENT_JOINT_LANES

void JointFactor::add_responses(JointWork& work) {
  for (uint32_t end = 0; end < 2; ++end) {
    const JointBody& body = stage_.bodies[work.body[end]];
    if (body.mobile == 0) continue;
    const Response reaction(work, body, end);
    for (uint32_t k = 0; k < work.rows; ++k) {
      Real speed[k_joint_rows_max];
      show(work, k + 1, end, reaction.linear_velocity[k], reaction.angular_velocity[k], speed);
      for (uint32_t m = 0; m <= k; ++m)
        work.response[k][m] += scale_by_power(speed[m], unit_power(work, k) + unit_power(work, m));
    }
    each_coupling(work, [&](const JointCoupling& coupling) {
      const JointWork& other = stage_.work[coupling.joint[1]];
      Real* const block = block_of(coupling);
      for (uint32_t far = 0; far < 2; ++far) {
        if (other.body[far] != work.body[end]) continue;
        for (uint32_t k = 0; k < work.rows; ++k) {
          Real speed[k_joint_rows_max];
          show(other, other.rows, far, reaction.linear_velocity[k], reaction.angular_velocity[k], speed);
          for (uint32_t m = 0; m < other.rows; ++m) {
            const Real scaled = scale_by_power(speed[m], unit_power(work, k) + unit_power(other, m));
            block[k * other.rows + m] += end == far ? scaled : -scaled;
          }
        }
      }
    });
  }
}

void JointFactor::eliminate(JointWork& work) {
  const uint32_t rows = work.rows;
  Rows& response = work.response;
  for (uint32_t k = 0; k < rows; ++k) {
    work.inverse[k] = scaled_reciprocal(max(response[k][k], work.least[k]));
    for (uint32_t l = k + 1; l < rows; ++l) {
      const Real of_pivot = multiply(response[l][k], work.inverse[k]);
      for (uint32_t m = k + 1; m <= l; ++m) response[l][m] -= of_pivot * response[m][k];
    }
    for (uint32_t l = k + 1; l < rows; ++l) response[l][k] = multiply(response[l][k], work.inverse[k]);
  }
  each_coupling(work, [&](const JointCoupling& coupling) {
    with_sizes(rows, stage_.work[coupling.joint[1]].rows,
               [&](auto height, auto width) { divide_block(work, height, width, block_of(coupling)); });
  });
  each_coupling(work, [&](const JointCoupling& coupling) {
    JointWork& other = stage_.work[coupling.joint[1]];
    const Real* const block = block_of(coupling);
    Rows scaled = {};  // initialised, because GCC does not see that every element is written before it is read
    with_sizes(rows, other.rows, [&](auto height, auto width) {
      const uint32_t columns = width;
      for (uint32_t k = 0; k < rows; ++k) {
        DETENT_UNROLL
        for (uint32_t m = 0; m < columns; ++m) scaled[m][k] = multiply(block[k * columns + m], work.inverse[k]);
      }
      for (uint32_t m = 0; m < columns; ++m)
        each_product(height, width, block, scaled[m], m, [&](uint32_t i, Real part) { other.response[i][m] -= part; });
    });
    each_pair(coupling, [&](const JointCoupling& further, Real* target) {
      JointWork& third = stage_.work[further.joint[1]];
      if (target == nullptr) {
        make_up_product(rows, block_of(further), scaled, third, other);
        return;
      }
      const Real* const block_of_third = block_of(further);
      const uint32_t count = other.rows;
      with_sizes(rows, third.rows, [=, &scaled](auto height, auto width) {
        const uint32_t columns = width;
        Real* row = target;
        for (uint32_t m = 0; m < count; ++m, row += columns)
          each_product(height, width, block_of_third, scaled[m], 0, [row](uint32_t i, Real part) { row[i] -= part; });
      });
    });
  });
}

Scaled JointFactor::substitute() {
  EnergySum energy;
  for (const uint32_t index : order_) {
    JointWork& work = stage_.work[index];
    Real over[k_joint_rows_max];
    for (uint32_t k = 0; k < work.rows; ++k) {
      work.side[k] -= product(k, 1, work.side, work.response[k]);
      bool clamped = false;
      over[k] = multiply(work.side[k], work.inverse[k], clamped);
      if (clamped) ++saturated;
      energy.add(work.side[k], over[k]);
    }
    each_coupling(work, [&](const JointCoupling& coupling) {
      JointWork& other = stage_.work[coupling.joint[1]];
      with_sizes(work.rows, other.rows, [&](auto height, auto width) {
        each_product(height, width, block_of(coupling), over, 0, [&](uint32_t i, Real part) { other.side[i] -= part; });
      });
    });
  }
  return energy.value();
}

void JointFactor::solve() {
  for (uint32_t place = order_.count; place-- > 0;) {
    JointWork& work = stage_.work[order_[place]];
    Real rest[k_joint_rows_max];
    for (uint32_t k = 0; k < work.rows; ++k) rest[k] = work.side[k];
    each_coupling(work, [&](const JointCoupling& coupling) {
      const JointWork& other = stage_.work[coupling.joint[1]];
      const Real* const block = block_of(coupling);
      with_rows(other.rows, [&](auto width) {
        for (uint32_t k = 0; k < work.rows; ++k) rest[k] -= product(width, 1, block + k * width, other.impulse);
      });
    });
    for (uint32_t k = 0; k < work.rows; ++k) {
      bool clamped = false;
      work.impulse[k] = clamp(multiply(rest[k], work.inverse[k], clamped), -k_solved_max, k_solved_max);
      if (clamped) ++saturated;
    }
    for (uint32_t k = work.rows; k-- > 0;) {
      for (uint32_t m = k + 1; m < work.rows; ++m) work.impulse[k] -= work.response[m][k] * work.impulse[m];
    }
  }
}

#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
