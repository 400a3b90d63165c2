#include "tests/campaigns/manifolds/measure.h"

#include <math.h>

#include <algorithm>
#include <limits>

#include "tests/common/oracle/contact_patch.h"

namespace detent_manifolds {

using detent_oracle::FacedSolid;
using detent_oracle::Frame;
using detent_oracle::Patch;
using detent_oracle::Placement;
using detent_oracle::Polygon;
using detent_oracle::Spot;

namespace {

constexpr double k_nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double k_pi = 3.14159265358979323846;

Arrow arrow_of(const Triple& v) { return {v[0], v[1], v[2]}; }

/// The library's points, in A's axes.
struct Points {
  Arrow normal = {0, 0, 0};
  std::vector<Arrow> at{};
};

/// The points of the contact and the corners of the true patch, in A's axes. `bearing`: the points that overlap or are
/// about as deep as the deepest.
struct Support {
  std::vector<Arrow> points{}, bearing{}, corners{};
};

/// Compares the contact with the exact solids, tick by tick.
class Judge {
 public:
  explicit Judge(const Scene& scene) : scene_(scene), a_(solid_of(scene.a)), b_(solid_of(scene.b)) {
    const auto size = [](const FacedSolid& solid) {
      return static_cast<double>(2 * (solid.solid().distance_max + solid.solid().rounding));
    };
    size_ = scene.mesh_cells != 0 ? size(b_) : std::min(size(a_), size(b_));
    thickness_ = scene.mesh_cells != 0 ? thickness_of(scene.b) : std::min(thickness_of(scene.a), thickness_of(scene.b));
  }

  Reading read(const Tick& tick);

 private:
  void measure_points(const Tick& tick, const Points& points, const Patch& patch, const Arrow& middle,
                      Reading& reading) const;
  Number staleness_of(const Tick& tick, const Patch& patch, const Polygon& kept) const;
  PointReading read_point(const Tick& tick, const Points& points, size_t i, const Arrow& middle) const;
  double jump_of(const Support& now, const Patch& patch, double motion) const;

  const Scene& scene_;
  FacedSolid a_, b_;
  double size_, thickness_;
  Placement placement_{};
  Arrow hint_ = {0, 0, 0};
  // Data of the tick before.
  bool has_last_ = false;
  Placement last_placement_{};
  Support last_{};
};

Reading Judge::read(const Tick& tick) {
  Reading reading;
  std::fill(reading.value, reading.value + k_measures, k_nothing);
  const Frame frame_a = detent_oracle::frame_of(tick.a.rotation), frame_b = detent_oracle::frame_of(tick.b.rotation);
  placement_.a = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int i = 0; i < 3; ++i) placement_.b.axis[i] = to_local(frame_a, frame_b.axis[i]);
  placement_.offset = to_local(frame_a, arrow_of(tick.b.position) - arrow_of(tick.a.position));
  const detent_oracle::Separation found =
      separation_of(a_.solid(), b_.solid(), placement_, {thickness_ * 1e-10L, 0}, hint_);
  hint_ = reading.normal = found.axis;
  reading.gap = static_cast<double>(found.gap);

  const Patch patch = patch_of(a_, b_, placement_, found.axis, found.gap + scene_.tolerance);
  reading.patch_area = static_cast<double>(area_of(patch.outline));
  const Number height = support_value(a_.solid(), found.axis) + a_.solid().rounding + found.gap / 2;
  Support support;
  Arrow middle = {0, 0, 0};
  for (const Spot& spot : patch.outline) {
    support.corners.push_back(patch.u * spot.u + patch.v * spot.v + patch.normal * height);
    middle = middle + support.corners.back() * (1.0L / static_cast<Number>(patch.outline.size()));
  }

  Points points;
  points.normal = to_local(frame_a, arrow_of(tick.stepped.normal));
  for (const FoundPoint& point : tick.stepped.points) {
    points.at.push_back(to_local(frame_a, arrow_of(point.from_a)));
    if (point.separation <= std::max(reading.gap, 0.0) + scene_.tolerance) support.bearing.push_back(points.at.back());
  }
  support.points = points.at;
  if (points.at.empty()) {
    reading.lost = reading.gap < 0.9 * tick.distance_max && !tick.stepped.seam;
    has_last_ = false;
    return reading;
  }
  reading.idle = reading.gap > tick.distance_max + 1e-3 * thickness_;
  if (!patch.outline.empty() && !reading.idle) {
    measure_points(tick, points, patch, middle, reading);
    double motion = static_cast<double>(detent_oracle::length(placement_.offset - last_placement_.offset));
    for (int i = 0; i < 3; ++i)
      motion += static_cast<double>(detent_oracle::length(placement_.b.axis[i] - last_placement_.b.axis[i]) *
                                    (b_.solid().distance_max + b_.solid().rounding));
    if (has_last_ && !tick.stepped.seam)
      reading.value[static_cast<uint32_t>(Measure::jump)] = jump_of(support, patch, motion);
  }
  has_last_ = !patch.outline.empty() && !tick.stepped.seam;
  last_placement_ = placement_;
  last_ = support;
  return reading;
}

void Judge::measure_points(const Tick& tick, const Points& points, const Patch& patch, const Arrow& middle,
                           Reading& reading) const {
  const auto set = [&](Measure measure, Number value) {
    reading.value[static_cast<uint32_t>(measure)] = static_cast<double>(value);
  };
  double deepest = HUGE_VAL;
  for (const FoundPoint& point : tick.stepped.points) deepest = std::min(deepest, point.separation);
  set(tick.stepped.seam ? Measure::seam : Measure::depth, fabs(deepest - reading.gap) / thickness_);
  if (tick.stepped.seam) return;

  std::vector<Spot> spots;
  for (const Arrow& at : points.at) spots.push_back(patch.spot(at));
  const Polygon kept = outline_of(spots);
  Number loss = 0;
  for (const Spot& corner : patch.outline) loss = std::max(loss, distance_beyond(kept, corner));
  const bool parted = reading.gap > thickness_ / 256;
  set(parted ? Measure::parted : Measure::loss, loss / size_);
  if (tick.stepped.reused) set(Measure::stale, staleness_of(tick, patch, kept) / size_);
  // For a patch narrower than a fiftieth of the size, `loss` is sufficient.
  Number diameter = 0;
  for (const Spot& p : patch.outline) {
    for (const Spot& q : patch.outline) diameter = std::max(diameter, hypotl(p.u - q.u, p.v - q.v));
  }
  if (!parted && reading.patch_area > 0.02L * size_ * diameter)
    set(Measure::uncovered, std::max(0.0L, 1 - area_of(overlap_of(kept, patch.outline)) / area_of(patch.outline)));

  Number outside = 0, error = 0;
  for (size_t i = 0; i < points.at.size(); ++i) {
    const PointReading point = read_point(tick, points, i, middle);
    reading.points.push_back(point);
    outside = std::max(outside, static_cast<Number>(point.outside));
    // Without a contact by either value there is nothing to support.
    const double separation = tick.stepped.points[i].separation;
    if (std::min(separation, point.gap) <= std::max(reading.gap, 0.0) + thickness_ * 0x1p-10)
      error = std::max(error, fabsl(separation - point.gap));
  }
  set(Measure::outside, outside / size_);
  set(Measure::point, error / thickness_);
}

Number Judge::staleness_of(const Tick& tick, const Patch& patch, const Polygon& kept) const {
  const Frame frame_a = detent_oracle::frame_of(tick.a.rotation);
  std::vector<Spot> spots;
  for (const FoundPoint& point : tick.anew.points)
    spots.push_back(patch.spot(to_local(frame_a, arrow_of(point.from_a))));
  const Polygon anew = outline_of(spots);
  if (anew.empty()) return size_;
  Number most = 0;
  for (const Spot& spot : kept) most = std::max(most, distance_beyond(anew, spot));
  for (const Spot& spot : anew) most = std::max(most, distance_beyond(kept, spot));
  return most;
}

PointReading Judge::read_point(const Tick& tick, const Points& points, size_t i, const Arrow& middle) const {
  const Number distance_max = tick.distance_max + 1e-6L * thickness_, separation = tick.stepped.points[i].separation;
  Arrow at = points.at[i];
  Number gap = 0;
  const auto within = [&](const Arrow& place) {
    return gap_over(a_, b_, placement_, points.normal, place, gap) && gap <= distance_max;
  };
  const auto across = [&](const Arrow& displacement) {
    return displacement - points.normal * dot(displacement, points.normal);
  };
  Number outside = 0;
  if (!within(at)) {
    // The region within the contact margin is convex, so the line to its middle enters it once. The nearest point of
    // the region may be to the side.
    const Arrow to_middle = across(middle - at);
    Number low = 0, part = 1;
    for (int k = 0; k < 44; ++k) {
      const Number half = (low + part) / 2;
      (within(at + to_middle * half) ? part : low) = half;
    }
    outside = part * detent_oracle::length(to_middle);
    Arrow start = at + to_middle * part;
    const Patch near = patch_of(a_, b_, placement_, points.normal, distance_max);
    if (!near.outline.empty()) {
      const Spot from = near.spot(at), to = nearest_in(near.outline, from);
      const Number aside = hypotl(to.u - from.u, to.v - from.v);
      if (aside < outside) {
        outside = aside;
        start = at + near.u * (to.u - from.u) + near.v * (to.v - from.v);
      }
    }
    at = start;
  }
  // A place beyond the sides of a face by no more than a 64th counts as over it (include/detent/contact.h), so there
  // the surfaces may be farther apart than the planes.
  const Arrow to_middle = across(middle - at);
  const Number run = detent_oracle::length(to_middle);
  double best = within(at) ? static_cast<double>(gap) : k_nothing;
  for (int k = 1; k <= 6 && run > 0 && !(best <= static_cast<double>(separation)); ++k) {
    if (!within(at + to_middle * std::min(1.0L, k * size_ / 128 / run))) continue;
    if (isnan(best) || fabsl(separation - gap) < fabsl(separation - best)) best = static_cast<double>(gap);
  }
  return {static_cast<double>(outside), best};
}

double Judge::jump_of(const Support& now, const Patch& patch, double motion) const {
  const auto distance_max = [](const std::vector<Arrow>& arrows, const Arrow& direction) {
    Number most = -HUGE_VALL;
    for (const Arrow& arrow : arrows) most = std::max(most, dot(arrow, direction));
    return most;
  };
  constexpr int k_directions = 32;
  Number most = 0;
  for (int i = 0; i < k_directions; ++i) {
    const double angle = 2 * k_pi * i / k_directions;
    const Arrow direction = patch.u * cos(angle) + patch.v * sin(angle);
    // Speculative points come and go: only supporting points count as lost or gained.
    const Number lost = distance_max(last_.bearing, direction) - distance_max(now.points, direction);
    const Number won = distance_max(now.bearing, direction) - distance_max(last_.points, direction);
    const Number explained = fabsl(distance_max(now.corners, direction) - distance_max(last_.corners, direction));
    most = std::max(most, std::max(lost, won) - explained - 2 * motion);
  }
  return static_cast<double>(most) / size_;
}

uint32_t shared(const Found& found, const Found& before) {
  uint32_t count = 0;
  for (const FoundPoint& point : found.points) {
    count += std::any_of(before.points.begin(), before.points.end(),
                         [&](const FoundPoint& other) { return other.feature == point.feature; });
  }
  return count;
}

}  // namespace

const char* name_of(Measure measure) {
  constexpr const char* k_names[] = {"depth",   "point", "loss",  "parted", "uncovered",
                                     "outside", "jump",  "stale", "seam"};
  return k_names[static_cast<uint32_t>(measure)];
}

Verdict judge(const Scene& scene, const Followed& followed, const Visit& visit) {
  Verdict verdict;
  verdict.seed = scene.seed;
  verdict.kind = scene.kind;
  verdict.motion = scene.motion;
  verdict.shapes = scene.shapes();
  verdict.problem = followed.problem;
  Judge judge(scene);
  for (uint32_t tick = 0; tick < followed.ticks.size(); ++tick) {
    const Tick& now = followed.ticks[tick];
    const Reading reading = judge.read(now);
    ++verdict.ticks;
    verdict.reused += now.stepped.reused;
    verdict.lost += reading.lost;
    verdict.idle += reading.idle;
    verdict.seams += now.stepped.seam;
    verdict.capped += now.stepped.capped;
    verdict.most_points = std::max(verdict.most_points, static_cast<uint32_t>(now.stepped.points.size()));
    for (uint32_t i = 0; i < k_measures; ++i) {
      if (isnan(reading.value[i])) continue;
      if (!verdict.measured[i] || reading.value[i] > verdict.worst[i].value)
        verdict.worst[i] = {reading.value[i], tick};
      verdict.measured[i] = true;
    }
    if (tick != 0 && scene.motion == Motion::still) {
      const Tick& before = followed.ticks[tick - 1];
      verdict.names += static_cast<uint32_t>(now.stepped.points.size());
      verdict.names_kept += shared(now.stepped, before.stepped);
      verdict.names_anew += static_cast<uint32_t>(now.anew.points.size());
      verdict.names_anew_kept += shared(now.anew, before.anew);
    }
    if (visit) visit(tick, now, reading);
  }
  return verdict;
}

}  // namespace detent_manifolds
