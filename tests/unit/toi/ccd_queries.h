#pragma once
#include <math.h>
#include <stdint.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/common/support/data_file.h"

/// Queries of continuous collision with exact ground truth, of Wang, Ferguson, Schneider, Jiang, Attene, Panozzo:
/// features whose corners move in straight lines. Every coordinate is a double.
namespace detent_test {

struct CcdQuery {
  bool edges;                     ///< two edges; else a vertex and a face
  double start[4][3], end[4][3];  ///< the corners, in the order of detent::FeatureKind
  bool meets;
};

inline const char* const k_ccd_sets[] = {
    "erleben-cube-cliff-edges", "erleben-cube-internal-edges", "erleben-sliding-spike",
    "erleben-sliding-wedge",    "erleben-spike-crack",         "erleben-spike-wedge",
    "erleben-spikes",           "erleben-wedge-crack",         "unit-tests"};

/// The queries of a set; none if there is no such file under $DETENT_DATA.
inline std::vector<CcdQuery> ccd_queries(const std::string& set, bool edges) {
  std::vector<CcdQuery> queries;
  for (const char* file : {"data_0_0.csv", "data_0_1.csv"}) {
    const std::string text = data_file("ccd-queries/" + set + (edges ? "/edge-edge/" : "/vertex-face/") + file);
    const char* at = text.c_str();
    const auto number = [&at] {
      char* end = nullptr;
      const double value = strtod(at, &end);
      at = *end == '\0' ? end : end + 1;
      return value;
    };
    for (size_t rows = static_cast<size_t>(std::count(text.begin(), text.end(), '\n')); rows >= 8; rows -= 8) {
      CcdQuery query = {};
      query.edges = edges;
      for (int row = 0; row < 8; ++row) {
        for (int axis = 0; axis < 3; ++axis) {
          const double numerator = number(), denominator = number();  // a power of two
          (row < 4 ? query.start[row] : query.end[row - 4])[axis] = numerator / denominator;
        }
        query.meets = number() != 0;
      }
      queries.push_back(query);
    }
  }
  return queries;
}

/// The power of two that scales all coordinates to 60 bits.
inline int scale_of(const CcdQuery& query) {
  double most = 0;
  for (int i = 0; i < 12; ++i) {
    most = std::max({most, fabs((&query.start[0][0])[i]), fabs((&query.end[0][0])[i])});
  }
  return most == 0 ? 0 : 60 - (ilogb(most) + 1);
}

}  // namespace detent_test
