#include "examples/billiards/picture.h"

#include <detent/body.h>
#include <detent/numbers.h>
#include <detent/world.h>
#include <inttypes.h>
#include <stdio.h>

#include <numbers>
#include <string>

#include "examples/scenes/make.h"
#include "ports/config_text.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace billiards {
namespace {

constexpr int k_second = 1000;  // ticks
constexpr int k_lead = 1000;    // ticks, before the match starts
constexpr int k_hold = 2000;    // ticks, after it has ended

// The picture, in px; the table is a group of it, in mm.
constexpr double k_width = 900;
constexpr double k_height = 672;
constexpr double k_left = 24;
constexpr double k_right = k_width - k_left;
constexpr double k_table_y = 296;
constexpr double k_scale = 0.3;  // px / mm
constexpr double k_timeline_y = 572;
constexpr int k_clock_row = 24;

constexpr double k_x = k_half_length * 1000;
constexpr double k_y = k_half_width * 1000;
constexpr double k_r = k_ball_radius * 1000;
constexpr double k_cushion = k_cushion_width * 1000;
constexpr double k_rail = 6 * 25.4;        // from the noses to the table's edge [WPA] 6: 4 to 7.5 in
constexpr double k_sight = 3.6875 * 25.4;  // [WPA] 6: from the noses to the sights

/// Each hole is drawn where the slate of a table with common shelves ends: 1.75 in behind a corner's mouth, 0.19 in
/// behind a side's.
struct Hole {
  double x, y, radius;
};
constexpr Hole corner_hole(double end, double side) { return {end * (k_x + 33.5), side * (k_y + 33.5), 61}; }
constexpr Hole side_hole(double side) { return {0, side * (k_y + 69), 64}; }
constexpr Hole k_holes[] = {corner_hole(-1, -1), corner_hole(-1, 1), corner_hole(1, -1),
                            corner_hole(1, 1),   side_hole(-1),      side_hole(1)};

// The marks on a ball, in ball radii. A mark whose direction is at the angle t from the vertical is drawn as a disc at
// t / 90 degrees times `rim` from the ball's centre, clipped at the ball's outline. So a number is hidden from 90
// degrees on, a cap from 120.
constexpr double k_number = 0.46;
constexpr double k_number_rim = 1 + k_number;
constexpr double k_cap = 0.78;
constexpr double k_cap_rim = 1.38;    // the caps leave a stripe 1.2 radii wide
constexpr double k_cap_hidden = 2.2;  // rad

struct Colours {
  const char* ball;
  const char* trail;  ///< light enough for the cloth
};
constexpr Colours k_colours[] = {
    {"#f7f3e6", "#ffffff"}, {"#f4c20d", "#ffd84a"}, {"#1d4fc4", "#7fa8ff"},
    {"#d3222a", "#ff6f66"}, {"#5a2a8c", "#bd95f5"}, {"#f07818", "#ffa552"},
    {"#0d8a48", "#74e6a0"}, {"#7e1b25", "#e08c84"}, {"#17181b", "#0a0d0c"},
};
const Colours& colours_of(uint32_t number) { return k_colours[number <= 8 ? number : number - 8]; }

Vec3<double> axis_y(const Quat& q) {
  const double x = unit_to_host(q.x), y = unit_to_host(q.y), z = unit_to_host(q.z), w = unit_to_host(q.w);
  return {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
}
Vec3<double> axis_z(const Quat& q) {
  const double x = unit_to_host(q.x), y = unit_to_host(q.y), z = unit_to_host(q.z), w = unit_to_host(q.w);
  return {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
}
Vec3<double> opposite(const Vec3<double>& v) { return {-v.x, -v.y, -v.z}; }

/// The angle between this direction and the vertical, rad.
double tilt(const Vec3<double>& direction) { return acos(fmin(fmax(direction.y, -1.0), 1.0)); }

/// The drawn position of a mark in this direction.
Track::Key mark(int tick, const Vec3<double>& direction, double rim) {
  const double across = hypot(direction.x, direction.z);
  const double scale = across < 1e-9 ? 0.0 : rim * k_r * tilt(direction) / (std::numbers::pi / 2) / across;
  return {tick, direction.x * scale, direction.z * scale};
}

double speed(const Shot& shot) {
  return hypot(real_to_host(shot.linear_velocity.x), real_to_host(shot.linear_velocity.z));
}

double distance(const Track::Key& a, const Track::Key& b) { return hypot(a.x - b.x, a.y - b.y); }

/// Rounds to steps of 1 / `steps`, so that %g writes few digits; converts -0 to 0.
double rounded(double value, double steps = 10) { return round(value * steps) / steps + 0.0; }

std::string text(double value) {
  char digits[32];
  snprintf(digits, sizeof digits, "%g", rounded(value));
  return digits;
}
std::string text(const Track::Key& key) { return text(key.x) + ' ' + text(key.y); }

/// The value of an animated attribute at a tick. Ticks before the match are negative.
struct Value {
  int tick;
  std::string text;
};

constexpr const char* k_definitions = R"(<defs>
<radialGradient id='cloth' r='.7'><stop stop-color='#1f7d5c'/><stop offset='1' stop-color='#135540'/></radialGradient>
<linearGradient id='wood' x2='0' y2='1'>
<stop stop-color='#70462a'/><stop offset='.5' stop-color='#52301c'/><stop offset='1' stop-color='#3c2213'/>
</linearGradient>
<radialGradient id='shadow'><stop offset='.55' stop-opacity='.45'/><stop offset='1' stop-opacity='0'/></radialGradient>
<radialGradient id='shade' cx='.38' cy='.32' r='.72'>
<stop stop-color='#fff' stop-opacity='.38'/><stop offset='.35' stop-color='#fff' stop-opacity='0'/>
<stop offset='.6' stop-opacity='0'/><stop offset='1' stop-opacity='.5'/>
</radialGradient>
<clipPath id='ball'><circle r='28.6'/></clipPath>
<clipPath id='clock'><path d='M-80-17h84v22h-84z'/></clipPath>
<g id='light'><circle r='28.6' fill='url(#shade)'/>
<ellipse cx='-9' cy='-11' rx='7' ry='4.5' transform='rotate(-40 -9 -11)' fill='#fff' opacity='.75'/></g>
</defs>
)";

}  // namespace

void Picture::add_cushions(const World& world) {
  for (BodyId id = next_body(world, {}); !is_null(id); id = next_body(world, id)) {
    Shape shape;
    Pose pose;
    must(get_shape(world, id, shape));
    must(get_pose(world, id, pose));
    if (shape.type != ShapeType::box) continue;
    cushions_.push_back({coord_to_host(pose.position.x) * 1000, coord_to_host(pose.position.z) * 1000,
                         real_to_host(shape.half_extents.x) * 1000, real_to_host(shape.half_extents.z) * 1000});
  }
}

void Picture::add_ball(Ball& ball, const World& world, int tick, bool moved) {
  Pose pose;
  must(get_pose(world, ball.id, pose));
  ball.centre.add({tick, coord_to_host(pose.position.x) * 1000, coord_to_host(pose.position.z) * 1000}, moved);

  // Both ends of the axis have a number: the upper one is drawn.
  Vec3<double> number = axis_y(pose.rotation);
  if (number.y < 0) number = opposite(number);
  const Track::Key spot = mark(tick, number, k_number_rim);
  const bool other_end = distance(spot, ball.number.last()) > k_r;
  ball.number.add(spot, moved || other_end);

  const Vec3<double> axis = axis_z(pose.rotation);
  for (int end = 0; end < 2; ++end) {
    const Vec3<double> cap = end == 0 ? axis : opposite(axis);
    Track& track = ball.caps[end];
    const bool was_hidden = track.last().tick + 1 < tick;
    if (tilt(cap) < k_cap_hidden) track.add(mark(tick, cap, k_cap_rim), was_hidden);
  }
}

void Picture::add(const World& world, int tick) {
  ticks_ = tick;
  if (tick == 0) add_cushions(world);
  BodyId ids[k_ball_count];
  for (BodyId id = next_ball(world, {}); !is_null(id); id = next_ball(world, id)) ids[ball_number(world, id)] = id;
  const bool shot = shots_played(world) > shots_.size();
  if (shot) shots_.push_back(tick);
  for (uint32_t number = 0; number < k_ball_count; ++number) {
    Ball& ball = balls_[number];
    const BodyId id = ids[number];
    const bool other = !(id == ball.id);
    if (other && !is_null(ball.id)) drops_.push_back({tick, number, ball.centre.last().x, ball.centre.last().y});
    if (other) ball.seen.push_back({tick, !is_null(id)});
    ball.id = id;
    if (!is_null(id)) add_ball(ball, world, tick, other);
    if (shot && !ball.centre.empty()) ball.centre.make_key();
  }
}

/// Writes the file.
class Page {
 public:
  Page(const Picture& picture, FILE* file) : picture_(picture), file_(file) {}

  void write(uint64_t digest) {
    fprintf(file_,
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %g %g' width='%g' height='%g' fill='#e8ecef'"
            " font-family='system-ui,Segoe UI,Roboto,sans-serif'>\n<title>Eight-ball, simulated by Detent</title>\n%s",
            k_width, k_height, k_width, k_height, k_definitions);
    fprintf(file_, "<rect width='%g' height='%g' rx='10' fill='#15191e'/>\n", k_width, k_height);
    write_header();
    fprintf(file_, "<g transform='translate(%g %g) scale(%g)'>\n", k_width / 2, k_table_y, k_scale);
    write_table();
    for (uint32_t number = 0; number < k_ball_count; ++number) write_trails(number);
    for (const Picture::Drop& drop : picture_.drops_) write_drop(drop);
    for (uint32_t number = k_ball_count; number-- > 0;) write_ball(number);
    fprintf(file_, "</g>\n");
    write_timeline();
    write_legend(digest);
    fprintf(file_, "</svg>\n");
  }

 private:
  /// Adds an animation to the open element. `what`: the animation's name and its attributes except times and values.
  void animate(const char* what, const std::vector<Value>& values) {
    const double ticks = k_lead + picture_.ticks_ + k_hold;
    fprintf(file_, "<%s dur='%gs' repeatCount='indefinite' keyTimes='0", what, ticks / k_second);
    for (const Value& value : values) fprintf(file_, ";%g", rounded((k_lead + value.tick) / ticks, 1e5));
    fprintf(file_, ";1' values='%s", values.front().text.c_str());
    for (const Value& value : values) fprintf(file_, ";%s", value.text.c_str());
    fprintf(file_, ";%s'/>", values.back().text.c_str());
  }
  /// Opens a group that starts at the track's first point and moves along the track.
  void open_group(const Track& track, const char* attributes = "") {
    fprintf(file_, "<g%s transform='translate(%s)'>", attributes, text(track.keys().front()).c_str());
    std::vector<Value> values;
    for (const Track::Key& key : track.keys()) values.push_back({key.tick, text(key)});
    if (track.last().tick != values.back().tick) values.push_back({track.last().tick, text(track.last())});
    if (values.size() > 1) animate("animateTransform attributeName='transform' type='translate'", values);
  }

  void write_header() {
    fprintf(file_, "<text x='%g' y='35' font-size='19' font-weight='600'>Eight-ball, simulated by Detent</text>\n",
            k_left);
    const std::vector<int>& shots = picture_.shots_;
    for (size_t i = 0; i < shots.size(); ++i) {
      fprintf(file_, "<text x='%g' y='35' font-size='15' text-anchor='end' opacity='%d'>shot %d: %s, %.1f m/s",
              k_right - 96, i == 0, static_cast<int>(i + 1), k_shots[i].name, speed(k_shots[i]));
      std::vector<Value> opacity = {{0, i == 0 ? "1" : "0"}, {shots[i], "1"}};
      if (i + 1 < shots.size()) opacity.push_back({shots[i + 1], "0"});
      animate("animate attributeName='opacity' calcMode='discrete'", opacity);
      fprintf(file_, "</text>\n");
    }
    write_clock();
  }
  /// Draws a strip of seconds and one of tenths; a window shows one row of each.
  void write_clock() {
    constexpr int tenth_ticks = k_second / 10;
    std::vector<Value> seconds, tenths;
    for (int i = 0; i * tenth_ticks <= picture_.ticks_; ++i) {
      tenths.push_back({i * tenth_ticks, "0 -" + std::to_string(i % 10 * k_clock_row)});
      if (i % 10 == 0) seconds.push_back({i * tenth_ticks, "0 -" + std::to_string(i / 10 * k_clock_row)});
    }
    fprintf(file_,
            "<g transform='translate(%g 35)' text-anchor='end' font-size='19' font-weight='600'><g "
            "clip-path='url(#clock)'>",
            k_right);
    write_strip(-35, static_cast<int>(seconds.size()), seconds);
    write_strip(-17, 10, tenths);
    fprintf(file_, "</g><text x='-30'>.</text><text>s</text></g>\n");
  }
  void write_strip(double right, int rows, const std::vector<Value>& values) {
    fprintf(file_, "<g>");
    for (int row = 0; row < rows; ++row) fprintf(file_, "<text x='%g' y='%d'>%d</text>", right, k_clock_row * row, row);
    animate("animateTransform attributeName='transform' type='translate' calcMode='discrete'", values);
    fprintf(file_, "</g>");
  }

  void write_rect(double x, double y, double half_length, double half_width, const char* attributes) {
    fprintf(file_, "<rect x='%g' y='%g' width='%g' height='%g' %s/>\n", rounded(x - half_length),
            rounded(y - half_width), rounded(2 * half_length), rounded(2 * half_width), attributes);
  }
  void write_sight(double x, double y) {
    fprintf(file_, "<path d='M%g %gl8 13-8 13-8-13z'/>\n", rounded(x), rounded(y - 13));
  }
  void write_table() {
    write_rect(0, 0, k_x + k_rail, k_y + k_rail, "rx='70' fill='url(#wood)' stroke='#2a170d' stroke-width='6'");
    write_rect(0, 0, k_x + k_rail - 12, k_y + k_rail - 12,
               "rx='60' fill='none' stroke='#b58a5e' stroke-opacity='.35' stroke-width='4'");
    write_rect(0, 0, k_x + k_cushion, k_y + k_cushion, "fill='#0b3326'");
    write_rect(0, 0, k_x, k_y, "fill='url(#cloth)'");
    for (const Picture::Cushion& cushion : picture_.cushions_) {
      write_rect(cushion.x, cushion.y, cushion.half_length, cushion.half_width,
                 "fill='#1b6e51' stroke='#0b3326' stroke-width='3'");
    }
    for (const Hole& hole : k_holes) {
      fprintf(file_, "<circle cx='%g' cy='%g' r='%g' fill='#050607' stroke='#2b231d' stroke-width='9'/>\n", hole.x,
              hole.y, hole.radius);
    }
    fprintf(file_, "<g fill='#e9dfc8'>\n");
    for (const int side : {-1, 1}) {
      for (const int eighth : {-3, -2, -1, 1, 2, 3}) write_sight(eighth * k_x / 4, side * (k_y + k_sight));
      for (const int quarter : {-1, 0, 1}) write_sight(side * (k_x + k_sight), quarter * k_y / 2);
    }
    fprintf(file_,
            "</g>\n<path d='M-%g-%gv%g' stroke='#fff' stroke-opacity='.14' stroke-width='4'/>\n"
            "<circle cx='%g' r='7' fill='#fff' opacity='.3'/>\n",
            k_string * 1000, k_y, 2 * k_y, k_string * 1000);
  }

  /// Draws the path of a ball, in pieces of one shot each.
  void write_trails(uint32_t number) {
    const Track& track = picture_.balls_[number].centre;
    fprintf(file_, "<g fill='none' stroke='%s' stroke-width='5' stroke-linejoin='round'>\n", colours_of(number).trail);
    std::vector<Track::Key> piece;
    size_t shots = 0;
    for (const Track::Key& key : track.keys()) {
      const bool jump = !piece.empty() && piece.back().tick == key.tick;
      if (!jump) piece.push_back(key);
      const bool shot = shots < picture_.shots_.size() && picture_.shots_[shots] <= key.tick;
      if (jump || shot) {
        write_trail(piece, shots);
        piece = {key};
      }
      if (shot) ++shots;
    }
    piece.push_back(track.last());
    write_trail(piece, shots);
    fprintf(file_, "</g>\n");
  }
  /// `shots`: the number of shots played so far; the next shot dims the trail.
  void write_trail(const std::vector<Track::Key>& piece, size_t shots) {
    double length = 0;
    for (size_t i = 1; i < piece.size(); ++i) length += distance(piece[i - 1], piece[i]);
    if (length < 1) return;
    // The trail is drawn as a dash longer than the trail, shifted so that it ends at the ball. Before the match the
    // whole trail is visible, faintly.
    const double dash = ceil(length) + 1;
    double hidden = dash;
    std::vector<Value> offset = {{-k_lead, "0"}, {0, "0"}, {0, text(hidden)}};
    std::vector<Value> opacity = {{-k_lead / 2, ".3"}, {0, "0"}, {0, ".8"}};
    fprintf(file_, "<path opacity='.3' d='");
    for (size_t i = 0; i < piece.size(); ++i) {
      if (i > 0) hidden -= distance(piece[i - 1], piece[i]);
      offset.push_back({piece[i].tick, text(hidden)});
      fprintf(file_, "%c%s", i == 0 ? 'M' : 'L', text(piece[i]).c_str());
    }
    if (shots < picture_.shots_.size()) {
      const int next = picture_.shots_[shots];
      opacity.insert(opacity.end(), {{next, ".8"}, {next + k_second / 2, ".2"}});
    }
    fprintf(file_, "' stroke-dasharray='%g'>", dash);
    animate("animate attributeName='stroke-dashoffset'", offset);
    animate("animate attributeName='opacity'", opacity);
    fprintf(file_, "</path>\n");
  }

  /// Draws a ball's marks and its highlight. `rolls`: the marks move as the ball rolls; otherwise they stay as at the
  /// start.
  void write_face(uint32_t number, bool rolls) {
    const Picture::Ball& ball = picture_.balls_[number];
    const auto open_mark = [&](const Track& track) {
      Track still(0);
      still.add(track.keys().front());
      open_group(rolls ? track : still);
    };
    fprintf(file_, "<g clip-path='url(#ball)'><circle r='%g' fill='%s'/>", k_r, colours_of(number).ball);
    for (int end = 0; end < 2 && number > 8; ++end) {
      open_mark(ball.caps[end]);
      fprintf(file_, "<circle r='%g' fill='%s'/></g>", k_cap * k_r, k_colours[0].ball);
    }
    open_mark(ball.number);
    if (number == 0) {
      fprintf(file_, "<circle r='6' fill='#c8202a'/>");
    } else {
      fprintf(file_,
              "<circle r='%g' fill='#fffdf5'/>"
              "<text y='6.5' font-size='18' font-weight='700' fill='#111' text-anchor='middle'>%" PRIu32 "</text>",
              k_number * k_r, number);
    }
    fprintf(file_, "</g></g><use href='#light'/>");
  }
  /// Draws a pocketed ball that falls into its pocket.
  void write_drop(const Picture::Drop& drop) {
    const Hole* hole = k_holes;
    for (const Hole& other : k_holes) {
      if (hypot(other.x - drop.x, other.y - drop.y) < hypot(hole->x - drop.x, hole->y - drop.y)) hole = &other;
    }
    const int end = drop.tick + 150;
    Track track(0);
    track.add({drop.tick, drop.x, drop.y});
    track.add({end, hole->x, hole->y});
    open_group(track, " opacity='0'");
    write_face(drop.ball, false);
    animate("animate attributeName='opacity'", {{drop.tick, "0"}, {drop.tick, "1"}, {end, "0"}});
    fprintf(file_, "</g>\n");
  }
  void write_ball(uint32_t number) {
    const Picture::Ball& ball = picture_.balls_[number];
    const std::string name = number == 0 ? "cue ball" : "ball " + std::to_string(number);
    open_group(ball.centre, (" id='ball-" + std::to_string(number) + "'").c_str());
    fprintf(file_, "<title>%s</title><circle cx='9' cy='11' r='36' fill='url(#shadow)'/>", name.c_str());
    write_face(number, true);
    std::vector<Value> opacity;
    for (const auto& [tick, on_table] : ball.seen) opacity.push_back({tick, on_table ? "1" : "0"});
    if (opacity.size() > 1) animate("animate attributeName='opacity' calcMode='discrete'", opacity);
    fprintf(file_, "</g>\n");
  }

  /// Draws a dot for each shot, and above the line the pocketed balls.
  void write_timeline() {
    const double length = k_right - k_left;
    const auto x = [&](int tick) { return rounded(k_left + length * tick / picture_.ticks_); };
    fprintf(file_, "<rect x='%g' y='%g' width='%g' height='4' rx='2' fill='#39424c'/>\n", k_left, k_timeline_y - 2,
            length);
    fprintf(file_, "<rect x='%g' y='%g' width='0' height='4' rx='2' fill='#5fd3a2'>", k_left, k_timeline_y - 2);
    animate("animate attributeName='width'", {{0, "0"}, {picture_.ticks_, text(length)}});
    fprintf(file_, "</rect>\n");
    for (const int shot : picture_.shots_) fprintf(file_, "<circle cx='%g' cy='%g' r='4'/>\n", x(shot), k_timeline_y);
    for (const Picture::Drop& drop : picture_.drops_) {
      fprintf(file_, "<g transform='translate(%g %g) scale(.3)'>", x(drop.tick), k_timeline_y - 16);
      write_face(drop.ball, false);
      fprintf(file_, "</g>\n");
    }
  }

  void write_legend(uint64_t digest) {
    fprintf(file_, "<g transform='translate(%g %g)' font-size='13' fill='#aeb8c2'>\n", k_left, k_timeline_y + 38);
    fprintf(file_,
            "<text>%d balls, %d shots, the break at %.1f m/s; %d ticks of 1 ms: %g s, shown in real time</text>\n"
            "<text y='20'>configuration %s, digest of the state after the last tick: <tspan fill='#e8ecef' "
            "font-family='ui-monospace,Consolas,DejaVu Sans Mono,monospace'>%016" PRIx64
            "</tspan></text>\n"
            "<text y='40'>the same bits on every machine: &#8220;detent verify&#8221; compares them after each "
            "tick</text>\n",
            static_cast<int>(k_ball_count), static_cast<int>(picture_.shots_.size()), speed(k_shots[0]),
            picture_.ticks_, static_cast<double>(picture_.ticks_) / k_second, config_text(k_config), digest);
    fprintf(file_,
            "</g>\n<g transform='translate(%g %g)' font-size='13' fill='#aeb8c2' stroke-width='2'>\n"
            "<path d='M0-4.5h26' stroke='#fff'/><text x='36'>path of a ball, this shot</text>\n"
            "<path d='M0 15.5h26' stroke='#fff' opacity='.3'/><text x='36' y='20'>earlier shots</text>\n"
            "<circle cx='13' cy='35.5' r='4' fill='#e8ecef'/><text x='36' y='40'>a shot; above, a ball "
            "pocketed</text>\n</g>\n",
            k_right - 236, k_timeline_y + 38);
  }

  const Picture& picture_;
  FILE* file_;
};

bool Picture::write(const char* path, uint64_t digest) const {
  FILE* file = fopen(path, "w");
  if (file == nullptr) return false;
  Page(*this, file).write(digest);
  return fclose(file) == 0;
}

}  // namespace billiards
}  // namespace DETENT_NAMESPACE
}  // namespace detent
