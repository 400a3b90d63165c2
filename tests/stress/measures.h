#pragma once
#include <memory>

#include "tests/stress/stage.h"

/// What a scene is judged by, from the poses and velocities alone: of any engine. All of bodies that can move.
namespace detent_stress {

/// Of a body: the farthest that any has moved along the floor from where it started, m.
double drift(const Stage& stage, const States& states);
/// The farthest that any body is below where it started, m.
double sag(const Stage& stage, const States& states);
/// Of the bodies' centres, m/s.
double speed_mean(const Stage& stage, const States& states);

/// Of a chain, whose joints are in its order: by how much the way along its anchors is longer than between those of
/// each body, over the latter.
double stretch(const Stage& stage, const States& states);
/// The mean of the last third of a run; of S6's 30 s the last 10.
double late_mean(const std::vector<double>& values);

struct Sums {
  std::array<double, 3> linear = {};   ///< momentum, kg m/s
  std::array<double, 3> angular = {};  ///< about the origin, kg m^2/s
  double energy = 0;                   ///< of motion, J
  double potential = 0;                ///< J, of heights above y = 0
};
Sums sums_of(const Stage& stage, const States& states);

double length(const std::array<double, 3>& v);
std::array<double, 3> operator-(const std::array<double, 3>& a, const std::array<double, 3>& b);
/// The angle between two vectors, rad.
double angle_between(const std::array<double, 3>& a, const std::array<double, 3>& b);
/// Turns a vector into the axes of a rotation (x, y, z, w) and out of them.
std::array<double, 3> to_local(const double (&rotation)[4], const std::array<double, 3>& v);
std::array<double, 3> to_world(const double (&rotation)[4], const std::array<double, 3>& v);

/// How deep bodies are in each other.
struct Depths {
  double mean = 0;  ///< m, over the pairs that overlap
  double max = 0;   ///< m
  uint32_t pairs = 0;
};

/// Finds them, by contact_points() of the library's default configuration: the least way out of each overlapping pair.
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
