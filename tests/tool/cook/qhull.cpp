#include "tests/tool/cook/qhull.h"

#include <stdio.h>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace detent_cook_test {

QhullAnswer qhull(const Cloud& cloud) {
  QhullAnswer answer;
  std::vector<double> coordinates;
  for (const auto& p : cloud) coordinates.insert(coordinates.end(), p.begin(), p.end());
  qhT state;
  qh_zero(&state, nullptr);
  char command[] = "qhull FA";
  FILE* const silence = tmpfile();
  if (qh_new_qhull(&state, 3, static_cast<int>(cloud.size()), coordinates.data(), False, command, silence, silence) !=
      0) {
    answer.problem = "Qhull fails";
  } else {
    qh_getarea(&state, state.facet_list);
    answer.volume = state.totvol;
    for (const vertexT* vertex = state.vertex_list; vertex != nullptr && vertex->next != nullptr;
         vertex = vertex->next) {
      answer.vertices.push_back(static_cast<size_t>((vertex->point - coordinates.data()) / 3));
    }
  }
  qh_freeqhull(&state, !qh_ALL);
  int long_count = 0, long_bytes = 0;
  qh_memfreeshort(&state, &long_count, &long_bytes);
  if (silence != nullptr) fclose(silence);
  return answer;
}

}  // namespace detent_cook_test
