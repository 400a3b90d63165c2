#pragma once
#include <memory>

#include "tests/campaigns/stress/stage.h"

/// Measures of a scene, computed from poses and velocities only, for any engine. They include only bodies that can
/// move.
namespace detent_stress {

/// The farthest horizontal distance of a body from its start, m.
double drift(const Stage& stage, const States& states);
/// The greatest drop of a body below its start, m.
double sag(const Stage& stage, const States& states);
/// The mean speed of the bodies' centres, m/s.
double speed_mean(const Stage& stage, const States& states);

/// For a chain with its joints in order: the relative increase of the path along its anchors over the sum of the
/// distances between each body's anchors.
double stretch(const Stage& stage, const States& states);
/// The mean of the last third of a run: for the 30 s of S6 the last 10 s.
double late_mean(const std::vector<double>& values);

struct Sums {
  std::array<double, 3> linear = {};   ///< linear momentum, kg m/s
  std::array<double, 3> angular = {};  ///< about the origin, kg m^2/s
  double energy = 0;                   ///< kinetic, J
  double potential = 0;                ///< J, 0 at y = 0
};
Sums sums_of(const Stage& stage, const States& states);

double length(const std::array<double, 3>& v);
std::array<double, 3> operator-(const std::array<double, 3>& a, const std::array<double, 3>& b);
/// The angle between two vectors, rad.
double angle_between(const std::array<double, 3>& a, const std::array<double, 3>& b);
/// Rotates a vector to the local axes of a rotation (x, y, z, w), and back to world axes.
std::array<double, 3> to_local(const double (&rotation)[4], const std::array<double, 3>& v);
std::array<double, 3> to_world(const double (&rotation)[4], const std::array<double, 3>& v);

/// Depths of overlapping bodies.
struct Depths {
  double mean = 0;  ///< m, over the pairs that overlap
  double max = 0;   ///< m
  uint32_t pairs = 0;
};

/// Measures depths with contact_points() of the library's default configuration: the least translation that separates
/// each overlapping pair.
class DepthMeter {
 public:
  explicit DepthMeter(const Stage& stage);
  ~DepthMeter();
  DepthMeter(const DepthMeter&) = delete;
  DepthMeter& operator=(const DepthMeter&) = delete;
  Depths measure(const States& states) const;

 private:
  struct Solids;
  std::unique_ptr<Solids> solids_;
};

}  // namespace detent_stress
