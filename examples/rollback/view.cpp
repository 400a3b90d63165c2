#include "examples/rollback/view.h"

#include <detent/numbers.h>
#include <fcntl.h>
#include <math.h>
#include <unistd.h>

namespace detent_rollback {

using namespace detent;

namespace {

constexpr int k_columns = 76, k_rows = 20;

char symbol(const World& world, BodyId body) {
  switch (pitch::kind_of(world, body)) {
    case pitch::Kind::player:
      return static_cast<char>('1' + pitch::owner_of(world, body));
    case pitch::Kind::ball:
      return 'o';
    case pitch::Kind::crate:
      return '#';
    case pitch::Kind::shot:
      return '*';
    default:
      return 0;
  }
}

/// The left and right border of a row, open at the goals.
char end_of_row(int row) { return row < k_rows * 3 / 10 || row >= k_rows * 7 / 10 ? '|' : ' '; }

}  // namespace

std::string draw(const World& world) {
  std::string rows[k_rows];
  for (int row = 0; row < k_rows; ++row) {
    rows[row] = end_of_row(row) + std::string(k_columns, ' ') + end_of_row(row) + "\x1b[K\n";
  }
  for (BodyId body = next_body(world, {}); !is_null(body); body = next_body(world, body)) {
    const char sign = symbol(world, body);
    Pose pose;
    if (sign == 0 || get_pose(world, body, pose) != Status::ok) continue;
    const double x = coord_to_host(pose.position.x) / pitch::k_half_length;
    const double z = coord_to_host(pose.position.z) / pitch::k_half_width;
    const int column = static_cast<int>(floor((x + 1) / 2 * k_columns));
    const int row = static_cast<int>(floor((z + 1) / 2 * k_rows));
    if (column < 0 || column >= k_columns || row < 0 || row >= k_rows) continue;
    rows[row][static_cast<size_t>(column + 1)] = sign;
  }
  const std::string line = "+" + std::string(k_columns, '-') + "+\x1b[K\n";
  const pitch::Score score = pitch::score(world);
  std::string all = "\x1b[H" + line;
  for (const std::string& row : rows) all += row;
  return all + line + "1 3 | " + std::to_string(score.right) + " : " + std::to_string(score.left) + " | 2 4\x1b[K\n";
}

Keyboard::Keyboard() : is_terminal_(tcgetattr(STDIN_FILENO, &before_) == 0) {
  if (!is_terminal_) return;
  termios raw = before_;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  tcsetattr(STDIN_FILENO, TCSANOW, &raw);
}

Keyboard::~Keyboard() {
  if (is_terminal_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

uint8_t Keyboard::input() {
  uint8_t once = 0;
  for (char key = 0; is_terminal_ && read(STDIN_FILENO, &key, 1) == 1;) {
    switch (key) {
      case 'w':
        displacement_ = pitch::k_far;
        break;
      case 's':
        displacement_ = pitch::k_near;
        break;
      case 'a':
        displacement_ = pitch::k_left;
        break;
      case 'd':
        displacement_ = pitch::k_right;
        break;
      case 'x':
        displacement_ = 0;
        break;
      case ' ':
        once = pitch::k_throw;
        break;
      default:
        break;
    }
  }
  return displacement_ | once;
}

}  // namespace detent_rollback
