#pragma once
#include <queue>

#include "tests/unit/toi/ccd_queries.h"

/// The same test by plain interval inclusion, for comparison: boxes of time and of two positions on the features are
/// halved, the earliest first, until the box that bounds the differences is small (Snyder 1992, as in Wang et al.
/// 2021).
namespace detent_test {

class PlainInclusion {
 public:
  /// `tolerance` is in the unit of the coordinates.
  PlainInclusion(const CcdQuery& query, double tolerance) : query_(query), tolerance_(tolerance) {
    rounding_ = ldexp(1, 15 - scale_of(query));  // 2^-45 of the largest coordinate
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < 12; ++i) {  // the twelve edges of the whole box
        const int along = i / 4;
        double low[3], high[3];
        for (int k = 0, bit = 1; k < 3; ++k) {
          low[k] = high[k] = k == along ? 0 : (i & bit) != 0 ? 1 : 0;
          if (k != along) bit = 2;
        }
        high[along] = 1;
        const double change = difference(axis, high[0], high[1], high[2]) - difference(axis, low[0], low[1], low[2]);
        speed_[along] = std::max(speed_[along], fabs(change));
      }
    }
  }

  /// Whether a box remains that may contain a contact, or the limit of boxes was reached.
  bool meets() {
    const auto later = [](const Box& a, const Box& b) { return a.low[0] > b.low[0]; };
    std::priority_queue<Box, std::vector<Box>, decltype(later)> open(later);
    open.push({{0, 0, 0}, {1, 1, 1}});
    for (boxes_ = 0; !open.empty();) {
      const Box box = open.top();
      open.pop();
      if (!query_.edges && box.low[1] + box.low[2] > 1) continue;  // beyond the face's third edge
      if (++boxes_ == k_boxes_max) return true;
      double width = 0;
      if (!holds_origin(box, width)) continue;
      if (width <= tolerance_) return true;
      const int widest = widest_of(box);
      Box left = box, right = box;
      left.high[widest] = right.low[widest] = (box.low[widest] + box.high[widest]) / 2;
      open.push(left);
      open.push(right);
    }
    return false;
  }
  uint32_t boxes() const { return boxes_; }
  static constexpr uint32_t k_boxes_max = 100000;

 private:
  struct Box {
    double low[3], high[3];
  };
  /// The difference of the two positions at a time, linear in each parameter.
  double difference(int axis, double t, double u, double v) const {
    const auto at = [&](int i) { return query_.start[i][axis] + (query_.end[i][axis] - query_.start[i][axis]) * t; };
    if (query_.edges) return at(0) + (at(1) - at(0)) * u - at(2) - (at(3) - at(2)) * v;
    return at(0) - at(1) - (at(2) - at(1)) * u - (at(3) - at(1)) * v;
  }
  bool holds_origin(const Box& box, double& width) const {
    for (int axis = 0; axis < 3; ++axis) {
      double least = HUGE_VAL, most = -HUGE_VAL;
      for (int i = 0; i < 8; ++i) {
        const double value = difference(axis, (i & 1 ? box.high : box.low)[0], (i & 2 ? box.high : box.low)[1],
                                        (i & 4 ? box.high : box.low)[2]);
        least = std::min(least, value);
        most = std::max(most, value);
      }
      if (least > rounding_ || most < -rounding_) return false;
      width = std::max(width, most - least);
    }
    return true;
  }
  /// The parameter of the three whose halving reduces the box most.
  int widest_of(const Box& box) const {
    int widest = 0;
    double most = -1;
    for (int i = 0; i < 3; ++i) {
      const double width = speed_[i] * (box.high[i] - box.low[i]);
      if (width > most) widest = i;
      most = std::max(most, width);
    }
    return widest;
  }

  const CcdQuery& query_;
  double tolerance_, rounding_ = 0, speed_[3] = {0, 0, 0};
  uint32_t boxes_ = 0;
};

}  // namespace detent_test
