#include "examples/figures/svg.h"

#include <math.h>
#include <stdio.h>

#include <algorithm>

namespace figures {
namespace {

constexpr double k_head = 9;         // px, length of an arrow's head
constexpr double k_head_half = 3.5;  // px, half its width

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "='" + value + "'";
}
std::string attribute(const char* name, double value) { return attribute(name, number(value)); }

/// Shortens the path at its end by the length of a head; the corners of that head.
std::vector<Point> take_head(std::vector<Point>& points) {
  const Point tip = points.back();
  while (points.size() > 2 && hypot(points.back().x - tip.x, points.back().y - tip.y) < k_head) points.pop_back();
  if (hypot(points.back().x - tip.x, points.back().y - tip.y) < k_head) points.pop_back();
  const Point path = tip - points.back();
  const Point along = (1 / hypot(path.x, path.y)) * path;
  const Point foot = tip - k_head * along;
  const Point across = {-k_head_half * along.y, k_head_half * along.x};
  points.push_back(foot);
  return {tip, foot + across, foot - across};
}

}  // namespace

std::string number(double value, int decimals) {
  const double steps = pow(10, decimals);
  // The little more: what is a tie but for the last bit of a sine goes up on every machine.
  const double rounded = floor(value * steps + 0.5 + 1e-6) / steps + 0.0;
  char digits[32];
  snprintf(digits, sizeof digits, "%.*f", decimals, rounded);
  return digits;
}

Svg::Svg(double height, const std::string& title) {
  content_ = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " + number(k_width, 0) + ' ' + number(height, 0) +
             "' width='" + number(k_width, 0) + "' height='" + number(height, 0) +
             "' font-family='Helvetica,Arial,sans-serif'>\n<title>" + title + "</title>\n";
  rect({0, 0}, k_width, height, {.fill = "#fbfcfd"}, 8);
}

void Svg::add(const std::string& element, const Paint& paint) {
  content_ += '<' + element + attribute("fill", paint.fill);
  if (paint.opacity < 1) content_ += attribute("fill-opacity", number(paint.opacity, 2));
  if (std::string(paint.stroke) != "none") {
    content_ += attribute("stroke", paint.stroke) + attribute("stroke-width", paint.width);
    if (paint.dash != nullptr) content_ += attribute("stroke-dasharray", paint.dash);
  }
  content_ += "/>\n";
}

void Svg::line(Point from, Point to, const Paint& paint) { path({from, to}, paint); }

void Svg::path(const std::vector<Point>& points, const Paint& paint, bool closed) {
  std::string path;
  for (const Point& point : points) {
    path += path.empty() ? 'M' : 'L';
    path += number(point.x) + ' ' + number(point.y);
  }
  add("path" + attribute("d", path + (closed ? "z" : "")) + " stroke-linejoin='round'", paint);
}

void Svg::circle(Point centre, double radius, const Paint& paint) {
  add("circle" + attribute("cx", centre.x) + attribute("cy", centre.y) + attribute("r", radius), paint);
}

void Svg::rect(Point corner, double width, double height, const Paint& paint, double rounding) {
  std::string element = "rect" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", width) +
                        attribute("height", height);
  if (rounding > 0) element += attribute("rx", rounding);
  add(element, paint);
}

void Svg::arrow(std::vector<Point> points, const char* colour, double width, bool two) {
  std::vector<std::vector<Point>> heads = {take_head(points)};
  if (two) {
    std::reverse(points.begin(), points.end());
    heads.push_back(take_head(points));
  }
  path(points, {.stroke = colour, .width = width});
  for (const std::vector<Point>& head : heads) path(head, {.fill = colour}, true);
}

void Svg::text(Point at, const std::string& words, const Lettering& lettering) {
  content_ += "<text" + attribute("x", at.x) + attribute("y", at.y) +
              attribute("font-size", number(lettering.size, 0)) + attribute("fill", lettering.colour);
  if (std::string(lettering.anchor) != "start") content_ += attribute("text-anchor", lettering.anchor);
  if (lettering.bold) content_ += attribute("font-weight", "600");
  if (lettering.halo) content_ += " stroke='#fbfcfd' stroke-width='3' stroke-linejoin='round' paint-order='stroke'";
  content_ += '>' + words + "</text>\n";
}

bool Svg::write(const std::string& path) const {
  FILE* file = fopen(path.c_str(), "wb");
  if (file == nullptr) return false;
  const bool written = fputs((content_ + "</svg>\n").c_str(), file) >= 0;
  return fclose(file) == 0 && written;
}

}  // namespace figures
