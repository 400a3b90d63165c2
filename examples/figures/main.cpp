#include <stdio.h>

#include "examples/figures/figures.h"

/// detent_figures FOLDER: writes every figure into the folder, as FOLDER/NAME.svg.
int main(int argc, char** argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: detent_figures FOLDER\n");
    return 2;
  }
  struct Figure {
    const char* name;
    figures::Svg (*draw)();
  };
  constexpr Figure k_figures[] = {
      {"joints", figures::draw_joints}, {"mover", figures::draw_mover},
      {"events", figures::draw_events}, {"continuous_collision", figures::draw_continuous_collision},
      {"memory", figures::draw_memory},
  };
  for (const Figure& figure : k_figures) {
    const std::string path = std::string(argv[1]) + "/" + figure.name + ".svg";
    if (figure.draw().write(path)) continue;
    fprintf(stderr, "%s cannot be written\n", path.c_str());
    return 1;
  }
}
