#pragma once
#include <string>
#include <vector>

namespace figures {

inline constexpr double k_width = 800;  ///< px, of every figure

// Colours that also those tell apart who see no red or green. Source: Okabe, Ito, "Color universal design", 2008.
inline constexpr const char* k_blue = "#0072b2";
inline constexpr const char* k_sky = "#56b4e9";
inline constexpr const char* k_green = "#009e73";
inline constexpr const char* k_orange = "#e69f00";
inline constexpr const char* k_red = "#d55e00";
inline constexpr const char* k_pink = "#cc79a7";
inline constexpr const char* k_ink = "#1f2933";
inline constexpr const char* k_grey = "#5b6770";
inline constexpr const char* k_solid = "#c9d1d8";  ///< what does not move
inline constexpr const char* k_faint = "#e3e8ec";  ///< lines of a grid

/// A place in the picture, px; y is down.
struct Point {
  double x, y;
};
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(double scale, Point a) { return {scale * a.x, scale * a.y}; }

/// How an outline and what is within it are drawn.
struct Paint {
  const char* stroke = "none";
  double width = 1;  ///< px, of the stroke
  const char* fill = "none";
  double opacity = 1;          ///< of the fill
  const char* dash = nullptr;  ///< of the stroke: lengths, px
};

/// How words are drawn.
struct Lettering {
  const char* colour = k_ink;
  double size = 12;  ///< px
  const char* anchor = "start";
  bool bold = false;
  bool halo = false;  ///< light around the letters, for words over lines
};

/// One SVG file on a light ground. Numbers are written with one decimal, so the same drawing is the same bytes.
class Svg {
 public:
  Svg(double height, const std::string& title);

  void line(Point from, Point to, const Paint& paint);
  /// Through all points; `closed`: and back to the first.
  void path(const std::vector<Point>& points, const Paint& paint, bool closed = false);
  void circle(Point centre, double radius, const Paint& paint);
  /// `corner`: the radius of its corners, px.
  void rect(Point corner, double width, double height, const Paint& paint, double rounding = 0);
  /// A line or path with a head at its end, and at its start if it has `two` heads.
  void arrow(std::vector<Point> points, const char* colour, double width = 2, bool two = false);
  /// `at`: the foot of the letters. The words must be free of & and <.
  void text(Point at, const std::string& words, const Lettering& lettering = {});

  /// False if the file could not be written.
  bool write(const std::string& path) const;

 private:
  void add(const std::string& element, const Paint& paint);

  std::string content_;
};

/// With this many decimals, rounded half up.
std::string number(double value, int decimals = 1);

}  // namespace figures
