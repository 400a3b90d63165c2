#include "cook_compound.h"
#include "read_points.h"
#include "words.h"

namespace detent_cook {
namespace {

constexpr size_t k_corners_max = size_t{1} << 24;  ///< vertices of a hull's faces
constexpr size_t k_parts_max = size_t{1} << 16;    ///< far more than cook_compound() accepts

/// Reads exactly `count` numbers; if `optional`, also none.
std::string read_numbers(std::string_view& line, double* numbers, size_t count, bool optional = false) {
  for (size_t i = 0; i < count; ++i) {
    const std::string_view word = next_word(line);
    if (word.empty() && optional && i == 0) return {};
    if (word.empty()) return "numbers are missing";
    if (!number_from(word, numbers[i])) return quoted(word) + " is no finite number";
  }
  return {};
}

class Reader {
 public:
  CompoundRead read(std::string_view text) {
    for (size_t number = 1; !text.empty(); ++number) {
      std::string_view line = next_line(text);
      std::string problem = take(line);
      if (parts_.size() > k_parts_max) problem = "more parts than can be cooked";
      if (!problem.empty()) return {{}, at_line(number, problem)};
    }
    end_hull();
    if (parts_.empty()) return {{}, "there is no face, ball, capsule or box"};
    return {parts_, {}};
  }

 private:
  std::string take(std::string_view line) {
    const std::string_view kind = next_word(line);
    if (kind == "v") {
      vertices_.emplace_back();
      return read_vertex(line, vertices_.back());
    }
    if (kind == "f") return take_face(line);
    if (kind == "o" || kind == "g") end_hull();
    if (kind == "ball") return take_round(line, 1);
    if (kind == "capsule") return take_round(line, 2);
    if (kind == "box") return take_box(line);
    if (kind == "density" || kind == "rounding") {
      end_hull();
      return read_numbers(line, kind == "density" ? &density_ : &rounding_, 1);
    }
    return {};
  }

  std::string take_face(std::string_view line) {
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      uint32_t index = 0;
      if (!index_from(word, vertices_.size(), index)) return quoted(word) + " names no vertex before this line";
      if (hull_.size() == k_corners_max) return "more corners than can be cooked";
      hull_.push_back(vertices_[index]);
    }
    return {};
  }

  std::string take_round(std::string_view line, size_t point_count) {
    end_hull();
    double numbers[7];
    const size_t count = 3 * point_count + 1;
    if (const std::string problem = read_numbers(line, numbers, count); !problem.empty()) return problem;
    CompoundPart part;
    part.kind = point_count == 1 ? CompoundPart::Kind::ball : CompoundPart::Kind::capsule;
    for (size_t i = 0; i < point_count; ++i)
      part.points.push_back({numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]});
    part.radius = numbers[count - 1];
    part.density = density_;
    parts_.push_back(part);
    return {};
  }

  std::string take_box(std::string_view line) {
    end_hull();
    double numbers[10] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    if (const std::string problem = read_numbers(line, numbers, 6); !problem.empty()) return problem;
    if (const std::string problem = read_numbers(line, numbers + 6, 4, true); !problem.empty()) return problem;
    const std::array<double, 4> rotation = {numbers[6], numbers[7], numbers[8], numbers[9]};
    if (rotation == std::array<double, 4>{0, 0, 0, 0}) return "the rotation is zero";
    CompoundPart part;
    part.points = box_points({numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}, rotation);
    part.radius = rounding_;
    part.density = density_;
    parts_.push_back(part);
    return {};
  }

  void end_hull() {
    if (hull_.empty()) return;
    CompoundPart part;
    part.points = hull_;
    part.radius = rounding_;
    part.density = density_;
    parts_.push_back(part);
    hull_.clear();
  }

  std::vector<CompoundPart> parts_{};
  std::vector<Point> vertices_{}, hull_{};
  double density_ = 1, rounding_ = 0;
};

}  // namespace

CompoundRead read_compound_text(std::string_view text) { return Reader().read(text); }

}  // namespace detent_cook
