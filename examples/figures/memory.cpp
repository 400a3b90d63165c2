#include <detent/world.h>
#include <stdlib.h>

#include "examples/figures/figures.h"

using namespace detent;

namespace figures {
namespace {

struct Bar {
  const char* words;
  Capacity capacity;
};
constexpr Bar k_bars[] = {
    {"bodies 100, contacts 300", {.bodies = 100, .contacts = 300}},
    {"the same, manifolds = false", {.bodies = 100, .contacts = 300, .manifolds = false}},
    {"the same, joints 50", {.bodies = 100, .contacts = 300, .joints = 50}},
    {"the same, sensed 500", {.bodies = 100, .contacts = 300, .sensed = 500}},
    {"bodies 200, contacts 300", {.bodies = 200, .contacts = 300}},
    {"bodies 200, contacts 800", {.bodies = 200, .contacts = 800}},
};

enum Kind : uint32_t { k_bodies, k_contacts, k_manifolds, k_joints, k_sensed, k_rest, k_kinds };
struct Look {
  const char* words;
  const char* colour;
};
constexpr Look k_looks[k_kinds] = {
    {"bodies", k_blue}, {"contacts", k_orange}, {"manifolds", k_green},
    {"joints", k_pink}, {"sensed", k_red},      {"the rest", k_grey},
};

/// Bytes of a block, by what they are for.
struct Parts {
  uint32_t state[k_kinds] = {};
  uint32_t work[k_kinds] = {};
};

/// Space that stages of a step share counts for contacts, which need most of it.
Parts parts_of(Capacity capacity) {
  bool fits = false;
  const Layout at = layout_of(capacity, fits);
  Parts parts;
  parts.state[k_rest] = at.poses + (at.manifolds - at.assets);
  parts.state[k_bodies] = at.contacts - at.poses;
  parts.state[k_contacts] = at.assets - at.contacts;
  parts.state[k_manifolds] = at.joints - at.manifolds;
  parts.state[k_joints] = at.sensed - at.joints;
  parts.state[k_sensed] = at.persistent_bytes - at.sensed;
  parts.work[k_rest] = at.tree_nodes - at.cache;
  parts.work[k_bodies] = (at.awake_contacts - at.tree_nodes) + (at.pairs - at.bounds) + (at.contact_order - at.islands);
  parts.work[k_contacts] =
      (at.bounds - at.awake_contacts) + (at.islands - at.pairs) + (at.manifold_work - at.contact_order);
  parts.work[k_manifolds] = at.joint_work - at.manifold_work;
  parts.work[k_joints] = at.sensed_work - at.joint_work;
  parts.work[k_sensed] = at.bytes - at.sensed_work;
  return parts;
}

constexpr double k_left = 206, k_right = k_width - 76;
constexpr double k_first = 92, k_row = 40, k_bar = 26;
constexpr double k_kib_max = 1100, k_kib_grid = 200;
constexpr double k_light = 0.4;  // of work space

double x_of(double kib) { return k_left + (k_right - k_left) * kib / k_kib_max; }

void draw_legend(Svg& svg) {
  const Parts parts = parts_of(k_bars[0].capacity);
  const std::string rest = number(parts.state[k_rest] + parts.work[k_rest], 0) + " bytes";
  svg.text({24, 28}, "world_bytes(capacity) by what the bytes are for", {.size = 14, .bold = true});
  double x = 24;
  for (uint32_t kind = 0; kind < k_rest; ++kind) {
    const Look& look = k_looks[kind];
    svg.rect({x, 42}, 13, 13, {.fill = look.colour});
    svg.rect({x + 13, 42}, 13, 13, {.fill = look.colour, .opacity = k_light});
    svg.text({x + 32, 53}, look.words);
    x += 104;
  }
  svg.text(
      {24, 76},
      "dark: state, which a snapshot holds; light: work space of the step; not seen: " + rest + " for the world itself",
      {.colour = k_grey});
}

void draw_bar(Svg& svg, double y, const Bar& bar) {
  svg.text({k_left - 12, y + 17}, bar.words, {.anchor = "end"});
  const Parts parts = parts_of(bar.capacity);
  svg.rect({k_left, y}, x_of(world_bytes(bar.capacity) / 1024.0) - k_left, k_bar, {.fill = "#ffffff"});
  uint32_t bytes = 0;
  for (const bool work : {false, true}) {
    for (uint32_t kind = 0; kind < k_kinds; ++kind) {
      const uint32_t more = work ? parts.work[kind] : parts.state[kind];
      const double from = x_of(bytes / 1024.0), to = x_of((bytes + more) / 1024.0);
      bytes += more;
      svg.rect({from, y}, to - from, k_bar, {.fill = k_looks[kind].colour, .opacity = work ? k_light : 1.0});
    }
    if (!work)
      svg.line({x_of(bytes / 1024.0), y - 4}, {x_of(bytes / 1024.0), y + k_bar + 4}, {.stroke = k_ink, .width = 1.5});
  }
  if (bytes != world_bytes(bar.capacity)) abort();
  svg.text({x_of(bytes / 1024.0) + 8, y + 17}, number(bytes / 1024.0, 0) + " KiB", {.halo = true});
}

}  // namespace

Svg draw_memory() {
  constexpr double rows = sizeof k_bars / sizeof *k_bars;
  constexpr double bottom = k_first + rows * k_row + 2;
  Svg svg(bottom + 40, "The bytes of a world by what they are for");
  draw_legend(svg);
  for (double kib = 0; kib <= k_kib_max; kib += k_kib_grid) {
    svg.line({x_of(kib), k_first - 4}, {x_of(kib), bottom}, {.stroke = k_faint});
    svg.text({x_of(kib), bottom + 17}, number(kib, 0), {.colour = k_grey, .anchor = "middle"});
  }
  svg.text({k_width - 24, bottom + 17}, "KiB", {.colour = k_grey, .anchor = "end"});
  double y = k_first + 4;
  for (const Bar& bar : k_bars) {
    draw_bar(svg, y, bar);
    y += k_row;
  }
  return svg;
}

}  // namespace figures
