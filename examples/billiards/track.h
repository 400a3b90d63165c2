#pragma once
#include <math.h>

#include <vector>

/// A moving point, stored as a few keys with linear motion between them.
class Track {
 public:
  struct Key {
    int tick;
    double x, y;
    friend bool operator==(const Key&, const Key&) = default;
  };

  /// `tolerance`: the largest error of a point between two keys, along each axis.
  explicit Track(double tolerance) : tolerance_(tolerance) {}

  /// Adds the point's position at a tick; ticks rise. `jump`: the point stayed at its last position until this tick, so
  /// two keys have the same tick.
  void add(const Key& point, bool jump = false) {
    if (keys_.empty()) {
      last_ = point;
      make_key();
    } else if (jump) {
      add({point.tick, last_.x, last_.y});
      make_key();
      last_ = point;
      make_key();
    } else {
      if (!reaches(point)) make_key();
      last_ = point;
      narrow();
    }
  }
  /// Stores the last point as a key.
  void make_key() {
    if (keys_.empty() || keys_.back() != last_) keys_.push_back(last_);
    x_ = y_ = {};
  }

  bool empty() const { return keys_.empty(); }
  const Key& last() const { return last_; }
  const std::vector<Key>& keys() const { return keys_; }

 private:
  /// The range of speeds from the last key on that pass every later point within the tolerance.
  struct Speeds {
    double min = -INFINITY, max = INFINITY;
  };

  bool reaches(const Key& point) const {
    const Key& from = keys_.back();
    const double ticks = point.tick - from.tick;
    const double x = (point.x - from.x) / ticks, y = (point.y - from.y) / ticks;
    return x >= x_.min && x <= x_.max && y >= y_.min && y <= y_.max;
  }
  void narrow() {
    const Key& from = keys_.back();
    const double ticks = last_.tick - from.tick;
    const auto narrow_axis = [&](Speeds& speeds, double displacement) {
      speeds.min = fmax(speeds.min, (displacement - tolerance_) / ticks);
      speeds.max = fmin(speeds.max, (displacement + tolerance_) / ticks);
    };
    narrow_axis(x_, last_.x - from.x);
    narrow_axis(y_, last_.y - from.y);
  }

  double tolerance_;
  std::vector<Key> keys_;
  Key last_ = {};  ///< the last point, whether it is a key or not
  Speeds x_, y_;
};
