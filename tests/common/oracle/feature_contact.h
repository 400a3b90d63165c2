#pragma once
#include <stdint.h>

/// When two features whose corners move in straight lines first meet, in exact rationals. It shares nothing with the
/// library: there intervals of time are ruled out, here the roots of the coplanarity cubic are counted by Sturm's
/// theorem and looked at one by one. Host code of x86-64, whose long double holds 64 bits.
namespace detent_oracle {

/// The corners as detent::FeatureKind orders them.
struct ExactFeatures {
  bool edges;  ///< two edges; else a vertex and a face
  long double start[4][3], end[4][3];
};

enum class ExactAnswer {
  clear,
  meet,   ///< at `time`
  touch,  ///< likewise, on the edge of a feature as far as 2^-200 of the step tells
  flat,   ///< not told: the plane is the same for all corners all the time, or it is none where it counts
};
struct ExactContact {
  ExactAnswer answer;
  int64_t time;  ///< 2^-62 of the step, rounded up
};
ExactContact first_contact(const ExactFeatures& features);

/// The distance of the features at a time in 2^-62 of the step, of exact rationals.
double gap_at(const ExactFeatures& features, int64_t time);

/// The least distance found near a time: an upper bound of the least of all, and in most cases that.
double least_gap_near(const ExactFeatures& features, int64_t time);

/// The longest edge at the start or the end, by its largest component.
double size_of(const ExactFeatures& features);

}  // namespace detent_oracle
