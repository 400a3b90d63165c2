#include "tests/common/oracle/feature_contact.h"

#include <gmpxx.h>
#include <math.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace detent_oracle {
namespace {

/// Coefficients from the constant on.
using Polynomial = std::vector<mpq_class>;

void trim(Polynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}
Polynomial plus(const Polynomial& a, const Polynomial& b, int sign) {
  Polynomial sum(std::max(a.size(), b.size()));
  for (size_t i = 0; i < a.size(); ++i) sum[i] += a[i];
  for (size_t i = 0; i < b.size(); ++i) sum[i] += sign * b[i];
  trim(sum);
  return sum;
}
Polynomial times(const Polynomial& a, const Polynomial& b) {
  if (a.empty() || b.empty()) return {};
  Polynomial product(a.size() + b.size() - 1);
  for (size_t i = 0; i < a.size(); ++i) {
    for (size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  }
  return product;
}
Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (size_t i = 1; i < p.size(); ++i) d.push_back(p[i] * static_cast<long>(i));
  return d;
}
mpq_class value_at(const Polynomial& p, const mpq_class& t) {
  mpq_class value = 0;
  for (size_t i = p.size(); i-- > 0;) value = value * t + p[i];
  return value;
}
/// quotient and remainder of a / b; b is not zero.
std::pair<Polynomial, Polynomial> divided(Polynomial a, const Polynomial& b) {
  Polynomial quotient(a.size() < b.size() ? 0 : a.size() - b.size() + 1);
  while (a.size() >= b.size()) {
    const size_t shift = a.size() - b.size();
    const mpq_class factor = a.back() / b.back();
    quotient[shift] = factor;
    for (size_t i = 0; i < b.size(); ++i) a[i + shift] -= factor * b[i];
    a.pop_back();
    trim(a);
  }
  return {quotient, a};
}
Polynomial square_free(const Polynomial& p) {
  Polynomial a = p, b = derivative(p);
  while (!b.empty()) {
    Polynomial rest = divided(a, b).second;
    a = b;
    b = rest;
  }
  return divided(p, a).first;
}

/// Sturm's chain of a square-free polynomial: how many roots lie in (from, to].
class Roots {
 public:
  explicit Roots(const Polynomial& p) : chain_{p, derivative(p)} {
    while (!chain_.back().empty()) {
      Polynomial rest = divided(chain_[chain_.size() - 2], chain_.back()).second;
      for (mpq_class& c : rest) c = -c;
      chain_.push_back(rest);
    }
    chain_.pop_back();
  }
  int count(const mpq_class& from, const mpq_class& to) const { return changes(from) - changes(to); }

  /// The first root after `from`, no later than the result and after it less `width`. Range: there is one, at most
  /// at 1.
  mpq_class next(mpq_class from, const mpq_class& width) const {
    mpq_class to = 1;
    for (const mpq_class begin = from; count(from, to) > 1;) {
      const mpq_class middle = (from + to) / 2;
      (count(begin, middle) > 0 ? to : from) = middle;
    }
    const int sign = sgn(value_at(chain_[0], to));
    while (sign != 0 && to - from > width) {
      const mpq_class middle = (from + to) / 2;
      const int here = sgn(value_at(chain_[0], middle));
      if (here == 0) return middle;
      (here == sign ? to : from) = middle;
    }
    return to;
  }

 private:
  int changes(const mpq_class& t) const {
    int changes = 0, last = 0;
    for (const Polynomial& p : chain_) {
      const int sign = sgn(value_at(p, t));
      changes += sign * last < 0 ? 1 : 0;
      if (sign != 0) last = sign;
    }
    return changes;
  }
  std::vector<Polynomial> chain_;
};

mpq_class rational(long double value) {
  int exponent = 0;
  const long double mantissa = ldexpl(frexpl(value, &exponent), 63);
  exponent -= 63;
  const mpz_class whole(static_cast<long>(mantissa)), power = mpz_class(1) << static_cast<unsigned>(abs(exponent));
  return exponent < 0 ? mpq_class(mpq_class(whole) / mpq_class(power)) : mpq_class(whole * power);
}
mpq_class time_of(int64_t time) { return rational(ldexpl(static_cast<long double>(time), -62)); }

using Corner = std::vector<Polynomial>;  ///< three of them, of time
Corner minus(const Corner& a, const Corner& b) {
  return {plus(a[0], b[0], -1), plus(a[1], b[1], -1), plus(a[2], b[2], -1)};
}
Corner cross(const Corner& a, const Corner& b) {
  const auto minor = [&](size_t i, size_t j) { return plus(times(a[i], b[j]), times(a[j], b[i]), -1); };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}
Polynomial dot(const Corner& a, const Corner& b) {
  return plus(plus(times(a[0], b[0]), times(a[1], b[1]), 1), times(a[2], b[2]), 1);
}

/// The differences of the corners, round the polygon.
std::vector<Corner> polygon_of(const ExactFeatures& f) {
  const auto difference = [&f](int a, int b) {
    Corner corner(3);
    for (size_t i = 0; i < 3; ++i) {
      const mpq_class from = rational(f.start[b][i]) - rational(f.start[a][i]);
      const mpq_class to = rational(f.end[b][i]) - rational(f.end[a][i]);
      corner[i] = {from, to - from};
      trim(corner[i]);
    }
    return corner;
  };
  if (!f.edges) return {difference(0, 1), difference(0, 2), difference(0, 3)};
  return {difference(0, 2), difference(0, 3), difference(1, 3), difference(1, 2)};
}

const mpq_class k_width = mpq_class(1) / (mpq_class(mpz_class(1) << 200));

/// The sign of a polynomial over a narrow interval from t on; 0 if it may change there.
int sign_near(const Polynomial& p, const mpq_class& t) {
  mpq_class slope = 0;
  for (size_t i = 1; i < p.size(); ++i) slope += abs(p[i]) * static_cast<long>(i);
  const mpq_class value = value_at(p, t);
  return abs(value) <= slope * k_width ? 0 : sgn(value);
}

using Point = std::vector<mpq_class>;
mpq_class dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The square of the distance at a time.
mpq_class square_gap_at(const std::vector<Corner>& polygon, const mpq_class& time) {
  std::vector<Point> q;
  for (const Corner& corner : polygon) {
    q.push_back({value_at(corner[0], time), value_at(corner[1], time), value_at(corner[2], time)});
  }
  const auto from_first = [&q](size_t i) -> Point { return {q[i][0] - q[0][0], q[i][1] - q[0][1], q[i][2] - q[0][2]}; };
  const Point normal = cross(from_first(1), from_first(q.size() - 1));
  const mpq_class square = dot(normal, normal);
  bool above = square != 0;
  mpq_class least = dot(q[0], q[0]);
  for (size_t i = 0; i < q.size(); ++i) {
    const Point &a = q[i], &b = q[(i + 1) % q.size()];
    above = above && dot(cross(a, b), normal) >= 0;
    const Point edge = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const mpq_class length = dot(edge, edge);
    mpq_class part = length == 0 ? mpq_class(0) : mpq_class(-dot(a, edge) / length);
    part = std::max(mpq_class(0), std::min(mpq_class(1), part));
    const Point nearest = {a[0] + edge[0] * part, a[1] + edge[1] * part, a[2] + edge[2] * part};
    least = std::min(least, dot(nearest, nearest));
  }
  if (above) {
    const mpq_class height = dot(q[0], normal);
    least = std::min(least, mpq_class(height * height / square));
  }
  return least;
}

}  // namespace

ExactContact first_contact(const ExactFeatures& features) {
  const std::vector<Corner> q = polygon_of(features);
  const Corner normal = cross(minus(q[1], q[0]), minus(q.back(), q[0]));
  const Polynomial coplanar = dot(normal, q[0]);
  if (coplanar.empty()) return {ExactAnswer::flat, 0};
  std::vector<Polynomial> sides = {dot(normal, normal)};
  for (size_t i = 0; i < q.size(); ++i) sides.push_back(dot(cross(q[i], q[(i + 1) % q.size()]), normal));
  const Roots roots(square_free(coplanar));
  mpq_class begin = -1;
  for (int left = roots.count(-1, 1); left > 0; --left) {
    const mpq_class to = roots.next(begin, k_width), from = to - k_width;
    begin = to;
    if (to < 0) continue;
    int least = 1;
    for (size_t i = 0; i < sides.size(); ++i) {
      const int sign = sign_near(sides[i], from);
      if (i == 0 && sign == 0) return {ExactAnswer::flat, 0};
      least = std::min(least, sign);
    }
    if (least < 0) continue;
    const mpq_class steps = to * mpq_class(mpz_class(1) << 62);
    const mpz_class time = (steps.get_num() + steps.get_den() - 1) / steps.get_den();
    return {least == 0 ? ExactAnswer::touch : ExactAnswer::meet, time.get_si()};
  }
  return {ExactAnswer::clear, int64_t{1} << 62};
}

double gap_at(const ExactFeatures& features, int64_t time) {
  return sqrt(square_gap_at(polygon_of(features), time_of(time)).get_d());
}

double least_gap_near(const ExactFeatures& features, int64_t time) {
  const std::vector<Corner> polygon = polygon_of(features);
  mpq_class at = time_of(time), width = mpq_class(1, 16), least = square_gap_at(polygon, at);
  for (int round = 0; round < 40; ++round, width /= 4) {
    const mpq_class middle = at;
    for (int i = -4; i <= 4; ++i) {
      const mpq_class t = middle + width * i;
      if (t < 0 || t > 1) continue;
      const mpq_class gap = square_gap_at(polygon, t);
      if (gap >= least) continue;
      least = gap;
      at = t;
    }
  }
  return sqrt(least.get_d());
}

double size_of(const ExactFeatures& features) {
  long double size = 0;
  const auto look_at = [&](int a, int b) {
    for (int i = 0; i < 3; ++i) {
      size = std::max(
          {size, fabsl(features.start[b][i] - features.start[a][i]), fabsl(features.end[b][i] - features.end[a][i])});
    }
  };
  if (features.edges) {
    look_at(0, 1);
  } else {
    look_at(1, 2);
    look_at(1, 3);
  }
  look_at(2, 3);
  return static_cast<double>(size);
}

}  // namespace detent_oracle
