#include "tests/common/oracle/convex_toi.h"

#include <algorithm>
#include <utility>

namespace detent_oracle {

namespace {

constexpr Number k_contact = 1e-15L;                ///< of the size
constexpr Number k_dip = 1e-12L;                    ///< of the size: how deep the gap may be unseen before a hit
constexpr Number k_near_parts[] = {0.99L, 0.999L};  ///< of the least gap found: what the floor of a clear step comes to
constexpr int k_samples_hit = 50000;
constexpr int k_samples_near[] = {20000, 400};

struct Sample {
  Number time;
  Placement placement;
  Separation is;
};

/// Times that no bound covers yet; empty if from >= to.
struct Span {
  Number from, to;
};

/// What the bounds need of one body.
struct AngularVelocity {
  Arrow rotation_vector;
  Number rate;          ///< |turn|
  Number distance_max;  ///< from the origin
  Number reach_axis;    ///< from the axis of the angular velocity
};
AngularVelocity angular_velocity_of(const ConvexSolid& solid, const Frame& frame, const Arrow& rotation_vector) {
  const Number rate = length(rotation_vector);
  const Number reach_axis =
      rate > 0 ? reach_from_line(solid, to_local(frame, rotation_vector * (1 / rate))) : solid.distance_max;
  return {rotation_vector, rate, solid.distance_max, reach_axis};
}

class Search {
 public:
  explicit Search(const Encounter& encounter)
      : e_(encounter),
        angular_velocity_a_(angular_velocity_of(e_.a, e_.frame_a, e_.turn_a)),
        angular_velocity_b_(angular_velocity_of(e_.b, e_.frame_b, e_.turn_b)),
        half_space_a_(e_.a.core == CoreKind::half_space),
        half_space_(half_space_a_ || e_.b.core == CoreKind::half_space),
        radii_(e_.a.rounding + e_.b.rounding),
        velocity_(length(e_.displacement)) {
    rounding_ = std::max(rounding_of(e_.a, e_.b, e_.offset), rounding_of(e_.a, e_.b, e_.offset + e_.displacement));
    contact_ = std::max(k_contact * e_.size, rounding_);
    dip_ = std::max(k_dip * e_.size, 4 * rounding_);
    // A half-space's far points move as fast as one likes; that nearest to B moves so fast at most.
    const Number far = half_space_ ? length(e_.offset) + velocity_ : 0;
    speed_ = velocity_ +
             angular_velocity_a_.rate * (half_space_a_ ? far + e_.b.distance_max : angular_velocity_a_.reach_axis) +
             angular_velocity_b_.rate *
                 (half_space_ && !half_space_a_ ? far + e_.a.distance_max : angular_velocity_b_.reach_axis);
  }

  Verdict run();
  Number chord_excess(const Arrow& axis, const Arrow& omega, Number from, Number to) const {
    return bend(axis, omega, from, to) * (to - from) * (to - from) / 8;
  }

 private:
  Arrow offset_at(Number time) const { return e_.offset + e_.displacement * time; }

  Sample sample(Number time, const Arrow& hint, Number relative) {
    Sample result = {time, placement_at(e_, time), {}};
    Accuracy accuracy;
    accuracy.relative = relative;
    result.is = separation_of(e_.a, e_.b, result.placement, accuracy, hint);
    ++samples_;
    gaps_.push_back({time, result.is.gap});
    return result;
  }
  Sample rough_sample(Number time, const Arrow& hint) { return sample(time, hint, near_part_ > 0 ? 1e-4L : 1e-3L); }

  /// K of a turning axis.
  Number bend(const Arrow& axis, const Arrow& omega, Number from, Number to) const {
    const Number across = length(cross(axis, omega)), rate = length(omega);
    const Number far = std::max(length(offset_at(from)), length(offset_at(to)));
    Number sum = across * (2 * velocity_ + rate * far);
    for (const AngularVelocity* angular_velocity : {&angular_velocity_a_, &angular_velocity_b_}) {
      const Arrow u = angular_velocity->rotation_vector - omega;
      const Number size = length(u);
      const Number sine = std::min(size, length(cross(axis, u)) + (to - from) * across * size);
      sum += rate > 0 ? angular_velocity->distance_max *
                            (sine * size + length(cross(angular_velocity->rotation_vector, omega)))
                      : angular_velocity->reach_axis * sine * size;
    }
    return sum;
  }

  void cover_by_spheres(Number level, const Sample& x, const Sample& y, Span& open) const;
  void cover_by_speed(Number level, const Sample& x, const Sample& y, Span& open) const;
  void cover_by_axis(Number level, const Sample& x, const Sample& y, const Sample& from, const Arrow& omega,
                     Span& open) const;
  Span uncovered(Number level, const Sample& x, const Sample& y) const;

  Sample first_contact(Sample above, Sample below);
  bool descend(std::vector<std::pair<Sample, Sample>> todo, int budget);
  Number floor_of_least() const { return near_part_ * least_.is.gap - dip_ / 10; }
  void polish();
  Sample deepest_after(const Sample& contact);

  const Encounter& e_;
  AngularVelocity angular_velocity_a_, angular_velocity_b_;
  bool half_space_a_, half_space_;
  Number radii_, velocity_, rounding_ = 0, contact_ = 0, dip_ = 0, speed_ = 0;
  int samples_ = 0;
  std::vector<std::pair<Number, Number>> gaps_{};  ///< time and gap of all samples
  Number near_part_ = 0;                           ///< the least gap is sought, else the first contact
  Sample least_{}, contact_sample_{};
  bool met_ = false;
};

/// Narrows what is open to the part where `low` < 0 < `high` fails: times x + L r for r in (first, second).
void keep(const Sample& x, const Sample& y, Number first, Number second, Span& open) {
  const Number span = y.time - x.time;
  open.from = std::max(open.from, x.time + span * first);
  open.to = std::min(open.to, x.time + span * second);
}

void Search::cover_by_spheres(Number level, const Sample& x, const Sample& y, Span& open) const {
  if (half_space_) return;
  const Number distance_max = e_.a.distance_max + e_.b.distance_max + radii_ + level + rounding_;
  const Arrow p = x.placement.offset, d = y.placement.offset - p;
  if (distance_max < 0) {
    open.to = open.from;
    return;
  }
  const Number a = dot(d, d), half = dot(p, d), c = dot(p, p) - distance_max * distance_max;
  if (!(a > 0)) {
    if (c > 0) open.to = open.from;
    return;
  }
  const Number nearest = -half / a;
  const Arrow off = p + d * nearest;
  const Number square = (distance_max * distance_max - dot(off, off)) / a;
  if (square < 0) {
    open.to = open.from;
    return;
  }
  const Number wide = sqrtl(square) + 1e-15L;
  keep(x, y, nearest - wide, nearest + wide, open);
}

void Search::cover_by_speed(Number level, const Sample& x, const Sample& y, Span& open) const {
  const Number low_x = x.is.gap_floor - level - rounding_, low_y = y.is.gap_floor - level - rounding_;
  if (low_x >= 0) open.from = std::max(open.from, speed_ > 0 ? x.time + low_x / speed_ * (1 - 1e-15L) : y.time);
  if (low_y >= 0) open.to = std::min(open.to, speed_ > 0 ? y.time - low_y / speed_ * (1 - 1e-15L) : x.time);
}

void Search::cover_by_axis(Number level, const Sample& x, const Sample& y, const Sample& from, const Arrow& omega,
                           Span& open) const {
  const Number span = y.time - x.time;
  const Number bound = level + radii_ + rounding_;
  const Number kappa = bend(from.is.axis, omega, x.time, y.time) * span * span / 2;
  const Number core_x = x.is.overlap ? x.is.separation : x.is.distance;
  const Number core_y = y.is.overlap ? y.is.separation : y.is.distance;
  const Number most = std::max(core_x, core_y) - bound;
  if (kappa > 16 * most) return;  // it would cover little
  const bool at_x = &from == &x;
  const Arrow other = turned(from.is.axis, omega * (at_x ? span : -span));
  const Number low_x = separation_along(e_.a, e_.b, x.placement, at_x ? from.is.axis : other) - bound;
  const Number low_y = separation_along(e_.a, e_.b, y.placement, at_x ? other : from.is.axis) - bound;
  // low_x (1 - r) + low_y r - kappa r (1 - r) < 0: between two roots.
  const Number b = low_y - low_x - kappa;
  if (!(kappa > 0)) {
    if (low_x >= 0 && low_y >= 0) {
      open.to = open.from;
    } else if (low_x >= 0) {
      keep(x, y, low_x / (low_x - low_y), 1, open);
    } else if (low_y >= 0) {
      keep(x, y, 0, low_x / (low_x - low_y), open);
    }
    return;
  }
  const Number square = b * b - 4 * kappa * low_x;
  if (square <= 0) {
    open.to = open.from;
    return;
  }
  const Number q = -(b + (b < 0 ? -sqrtl(square) : sqrtl(square))) / 2;
  const Number one = q / kappa, two = q != 0 ? low_x / q : 0;
  if (std::max(one, two) <= 0 || std::min(one, two) >= 1) {
    open.to = open.from;
    return;
  }
  keep(x, y, std::max(std::min(one, two), 0.0L), std::min(std::max(one, two), 1.0L), open);
}

/// What of [x, y] may have a gap below `level`, as far as the bounds know.
Span Search::uncovered(Number level, const Sample& x, const Sample& y) const {
  Span open = {x.time, y.time};
  const auto done = [&open] { return !(open.from < open.to); };
  cover_by_spheres(level, x, y, open);
  if (done()) return open;
  cover_by_speed(level, x, y, open);
  if (done()) return open;
  if (half_space_) {
    cover_by_axis(level, x, y, x, half_space_a_ ? e_.turn_a : e_.turn_b, open);
    return open;
  }
  const Arrow still = {0, 0, 0};
  for (const Sample* from : {&x, &y}) {
    cover_by_axis(level, x, y, *from, still, open);
    if (done()) return open;
  }
  if (!(angular_velocity_a_.rate > 0 || angular_velocity_b_.rate > 0)) return open;
  const Arrow across = cross(x.is.axis, y.is.axis);
  const Number sine = length(across), cosine = dot(x.is.axis, y.is.axis);
  if (sine > 1e-15L) {
    cover_by_axis(level, x, y, x, across * (atan2l(sine, cosine) / (sine * (y.time - x.time))), open);
    if (done()) return open;
  }
  for (const AngularVelocity* angular_velocity : {&angular_velocity_a_, &angular_velocity_b_}) {
    if (!(angular_velocity->rate > 0)) continue;
    for (const Sample* from : {&x, &y}) {
      cover_by_axis(level, x, y, *from, angular_velocity->rotation_vector, open);
      if (done()) return open;
    }
  }
  return open;
}

/// A contact between a sample apart and one in contact or overlap: regula falsi (Illinois), bisecting where that is
/// slow.
Sample Search::first_contact(Sample above, Sample below) {
  Number high = above.is.gap, low = below.is.gap;
  int side = 0;
  for (int i = 0; i < 200 && below.is.gap < -contact_; ++i) {
    const Number width = below.time - above.time;
    Number time = above.time + width * (i % 8 == 7 ? 0.5L : high / (high - low));
    if (!(time > above.time && time < below.time)) time = above.time + width / 2;
    if (!(time > above.time && time < below.time)) break;
    Sample middle = sample(time, above.is.axis, 0);
    if (middle.is.gap > contact_) {
      above = std::move(middle);
      high = above.is.gap;
      if (side == 1) low /= 2;
      side = 1;
    } else {
      below = std::move(middle);
      low = below.is.gap;
      if (side == -1) high /= 2;
      side = -1;
    }
  }
  return below;
}

/// Cuts intervals until all is covered. For the first contact the level is -dip_, and a sample in contact ends the
/// step there; for the least gap it follows the least sample. Returns whether the budget sufficed.
bool Search::descend(std::vector<std::pair<Sample, Sample>> todo, int budget) {
  while (!todo.empty()) {
    auto [x, y] = std::move(todo.back());
    todo.pop_back();
    if (samples_ > budget) return false;
    const Number level = near_part_ > 0 ? floor_of_least() : -dip_;
    const Span open = uncovered(level, x, y);
    if (!(open.from < open.to)) continue;
    const Number width = open.to - open.from;
    const bool narrowed = width < 0.6L * (y.time - x.time);
    const Number middle = open.from + width / 2;
    if (!narrowed && !(middle > x.time && middle < y.time)) continue;  // the last bits of time
    std::vector<Sample> cuts;
    if (!narrowed) {
      cuts.push_back(rough_sample(middle, x.is.axis));
    } else {
      if (open.from > x.time) cuts.push_back(rough_sample(open.from, x.is.axis));
      if (open.to < y.time) cuts.push_back(rough_sample(open.to, y.is.axis));
    }
    bool ended = false;
    for (const Sample& cut : cuts) {
      if (near_part_ > 0) {
        if (cut.is.gap < least_.is.gap) least_ = cut;
      } else if (!ended && cut.is.gap <= contact_) {
        contact_sample_ = first_contact(x, cut);
        met_ = ended = true;
      }
    }
    if (ended) {
      // Whatever comes later no longer matters.
      todo.clear();
      todo.push_back({std::move(x), contact_sample_});
    } else if (!narrowed) {
      todo.push_back({cuts[0], std::move(y)});
      todo.push_back({std::move(x), std::move(cuts[0])});
    } else {
      Sample from = open.from > x.time ? cuts.front() : std::move(x);
      Sample to = open.to < y.time ? cuts.back() : std::move(y);
      todo.push_back({std::move(from), std::move(to)});
    }
  }
  return true;
}

/// Brent's search for the least gap around the least sample, between its neighbours in time.
void Search::polish() {
  Number low = 0, high = 1;
  for (const auto& [time, gap] : gaps_) {
    if (time < least_.time) low = std::max(low, time);
    if (time > least_.time) high = std::min(high, time);
  }
  constexpr Number k_golden = 0.3819660112501051518L;
  Sample best = sample(least_.time, least_.is.axis, 0);
  Number second = best.time, third = best.time, gap_second = best.is.gap, gap_third = best.is.gap;
  Number step = 0, step_before = 0;
  for (int i = 0; i < 60; ++i) {
    const Number middle = (low + high) / 2, tolerance = 1e-10L * (high - low) + 1e-16L;
    if (fabsl(best.time - middle) + (high - low) / 2 <= 2 * tolerance || high - low < 1e-11L) break;
    bool golden = true;
    if (fabsl(step_before) > tolerance) {
      const Number r = (best.time - second) * (best.is.gap - gap_third);
      Number q = (best.time - third) * (best.is.gap - gap_second);
      Number p = (best.time - third) * q - (best.time - second) * r;
      q = 2 * (q - r);
      if (q > 0) p = -p;
      q = fabsl(q);
      const Number before = step_before;
      step_before = step;
      if (fabsl(p) < fabsl(q * before / 2) && p > q * (low - best.time) && p < q * (high - best.time)) {
        step = p / q;
        golden = false;
      }
    }
    if (golden) {
      step_before = best.time < middle ? high - best.time : low - best.time;
      step = k_golden * step_before;
    }
    const Number time = best.time + (fabsl(step) >= tolerance ? step : step > 0 ? tolerance : -tolerance);
    if (!(time > low && time < high)) break;
    const Sample tried = sample(time, best.is.axis, 0);
    if (tried.is.gap <= best.is.gap) {
      (tried.time >= best.time ? low : high) = best.time;
      third = second, gap_third = gap_second;
      second = best.time, gap_second = best.is.gap;
      best = tried;
    } else {
      (tried.time < best.time ? low : high) = tried.time;
      if (tried.is.gap <= gap_second || second == best.time) {
        third = second, gap_third = gap_second;
        second = tried.time, gap_second = tried.is.gap;
      } else if (tried.is.gap <= gap_third || third == best.time || third == second) {
        third = tried.time, gap_third = tried.is.gap;
      }
    }
  }
  least_ = best;
}

/// The deepest of some samples after a contact, over the time in which the solids pass through each other.
Sample Search::deepest_after(const Sample& contact) {
  constexpr int k_halvings = 36, k_refinements = 12;
  const Number passage = speed_ > 0 ? 2 * (e_.size + radii_) / speed_ : 1;
  const Number width = std::min(1 - contact.time, passage);
  Sample deepest = contact;
  // A graze may last 1e-9 of the passage: geometric, towards the contact.
  for (int i = k_halvings; i >= 0; --i) {
    const Sample tried = sample(contact.time + ldexpl(width, -i), deepest.is.axis, 1e-2L);
    if (tried.is.gap < deepest.is.gap) deepest = tried;
  }
  Number wide = deepest.time - contact.time;
  for (int i = 0; i < k_refinements; ++i) {
    wide *= i % 2 == 0 ? 0.6L : 1;
    const Number time = deepest.time + (i % 2 == 0 ? wide : -wide);
    if (!(time > contact.time && time <= 1)) continue;
    const Sample tried = sample(time, deepest.is.axis, 1e-2L);
    if (tried.is.gap < deepest.is.gap) deepest = tried;
  }
  return deepest;
}

Verdict Search::run() {
  Verdict verdict;
  verdict.size = e_.size;
  verdict.contact = contact_;
  const Sample start = sample(0, {0, 0, 0}, 0);
  met_ = start.is.gap <= contact_;
  if (met_) {
    contact_sample_ = start;
    verdict.gap_min_floor = start.is.gap;
  } else {
    const Sample end = sample(1, start.is.axis, 0);
    std::vector<std::pair<Sample, Sample>> todo;
    if (end.is.gap <= contact_) {
      met_ = true;
      contact_sample_ = first_contact(start, end);
      todo.push_back({start, contact_sample_});
    } else {
      todo.push_back({start, end});
    }
    verdict.complete = descend(todo, k_samples_hit);
    verdict.gap_min_floor = -dip_;
    if (!met_) {
      const auto least = std::min_element(gaps_.begin(), gaps_.end(),
                                          [](const auto& p, const auto& q) { return p.second < q.second; });
      least_ = sample(least->first, start.is.axis, 0);
      polish();
      for (int i = 0; i < 2; ++i) {
        near_part_ = k_near_parts[i];
        const Number before = least_.is.gap;
        if (!descend({{start, end}}, samples_ + k_samples_near[i])) break;
        verdict.gap_min_floor = floor_of_least();
        if (least_.is.gap < before) polish();
      }
    }
  }
  verdict.hit = met_;
  if (met_) {
    verdict.time = contact_sample_.time;
    const Sample deepest = deepest_after(contact_sample_);
    verdict.gap_min = deepest.is.gap;
    verdict.gap_min_time = deepest.time;
    verdict.certain = verdict.complete && deepest.is.gap < -dip_;
  } else {
    verdict.gap_min = least_.is.gap;
    verdict.gap_min_time = least_.time;
    verdict.certain = verdict.complete && verdict.gap_min_floor > 0;
  }
  verdict.samples = samples_;
  return verdict;
}

}  // namespace

Verdict judge(const Encounter& encounter) { return Search(encounter).run(); }
Verdict judge(const detent_queries::Query& query) { return judge(encounter_of(query)); }

Number signed_gap_at(const Encounter& encounter, Number time) {
  return separation_of(encounter.a, encounter.b, placement_at(encounter, time)).gap;
}
Number signed_gap_at(const detent_queries::Query& query, Number time) {
  return signed_gap_at(encounter_of(query), time);
}

Number chord_excess(const Encounter& encounter, const Arrow& axis, const Arrow& omega, Number from, Number to) {
  return Search(encounter).chord_excess(axis, omega, from, to);
}

}  // namespace detent_oracle
