#include "tests/common/oracle/convex_distance.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <type_traits>
#include <utility>

namespace detent_oracle {

namespace {

#if defined(__SIZEOF_FLOAT128__) && __LDBL_MANT_DIG__ < 113
__extension__ typedef __float128 Wide;
#else
typedef Number Wide;
#endif

template <class T>
T magnitude(T value) {
  return value < 0 ? -value : value;
}
Number root(Number value) { return sqrtl(value); }
#if defined(__SIZEOF_FLOAT128__) && __LDBL_MANT_DIG__ < 113
Wide root(Wide value) {
  // Below the range of long double's squares there is nothing to refine.
  const Wide guess = sqrtl(static_cast<Number>(value));
  return guess > 0 ? (guess + value / guess) / 2 : guess;
}
#endif
/// The unit of rounding, or a little more.
template <class T>
T unit() {
  return std::is_same_v<T, Number> ? T(std::numeric_limits<Number>::epsilon()) : T(0x1p-110L);
}
template <class T>
T norm(const Vector3<T>& v) {
  return root(dot(v, v));
}
template <class T, class From>
Vector3<T> cast(const Vector3<From>& v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

/// A support point of a core, body frame: one of those farthest along `direction`.
template <class T>
Vector3<T> support_point(const ConvexSolid& solid, const Vector3<T>& direction) {
  const T half = static_cast<T>(solid.half_length), radius = static_cast<T>(solid.radius);
  const T across =
      solid.core == CoreKind::points ? T(0) : root(T(direction.x * direction.x + direction.z * direction.z));
  const Vector3<T> rim =
      across > 0 ? Vector3<T>{direction.x / across * radius, 0, direction.z / across * radius} : Vector3<T>{0, 0, 0};
  switch (solid.core) {
    case CoreKind::cylinder:
      return {rim.x, direction.y < 0 ? -half : half, rim.z};
    case CoreKind::cone:
      if (direction.y * half * 2 >= radius * across) return {0, half * 3 / 2, 0};
      return {rim.x, -half / 2, rim.z};
    case CoreKind::half_space:
      return {0, 0, 0};
    case CoreKind::points:
      break;
  }
  Vector3<T> best = cast<T>(solid.points[0]);
  T most = dot(best, direction);
  for (size_t i = 1; i < solid.points.size(); ++i) {
    const Vector3<T> point = cast<T>(solid.points[i]);
    const T along = dot(point, direction);
    if (along > most) {
      most = along;
      best = point;
    }
  }
  return best;
}

/// A point w of B less A, and the points of the cores it comes from.
template <class T>
struct Vertex {
  Vector3<T> w, a, b;
};
template <class T>
bool same(const Vector3<T>& p, const Vector3<T>& q) {
  return p.x == q.x && p.y == q.y && p.z == q.z;
}

/// The Minkowski difference B less A.
template <class T>
struct Difference {
  const ConvexSolid &a, &b;
  Vector3<T> axes_a[3], axes_b[3], offset;
  T extent;  ///< of the coordinates
  int asked = 0;

  Difference(const ConvexSolid& solid_a, const ConvexSolid& solid_b, const Placement& placement)
      : a(solid_a), b(solid_b), offset(cast<T>(placement.offset)) {
    for (int i = 0; i < 3; ++i) {
      axes_a[i] = cast<T>(placement.a.axis[i]);
      axes_b[i] = cast<T>(placement.b.axis[i]);
    }
    extent = norm(offset) + static_cast<T>(a.distance_max + b.distance_max);
  }
  static Vector3<T> support_in_world(const ConvexSolid& solid, const Vector3<T> (&axes)[3], const Vector3<T>& n) {
    const Vector3<T> p = support_point<T>(solid, {dot(axes[0], n), dot(axes[1], n), dot(axes[2], n)});
    return axes[0] * p.x + axes[1] * p.y + axes[2] * p.z;
  }
  /// The point with the least n.w.
  Vertex<T> nearest_along(const Vector3<T>& n) {
    ++asked;
    Vertex<T> vertex;
    vertex.a = support_in_world(a, axes_a, n);
    vertex.b = support_in_world(b, axes_b, -n);
    vertex.w = offset + (vertex.b - vertex.a);
    return vertex;
  }
};

/// The point nearest to the origin of the hull of some of a simplex's vertices.
template <class T>
struct Nearest {
  int count = 0, index[3] = {};
  T weight[3] = {};
  Vector3<T> v = {};  ///< the point; of an edge or face it has the exact direction, orthogonal to it
  T square = 0;
};

template <class T>
void consider(Nearest<T>& best, const Nearest<T>& other) {
  if (best.count == 0 || other.square < best.square) best = other;
}
template <class T>
void consider_vertex(const Vertex<T>* s, int i, Nearest<T>& best) {
  consider(best, {1, {i, 0, 0}, {1, 0, 0}, s[i].w, dot(s[i].w, s[i].w)});
}
template <class T>
void consider_edge(const Vertex<T>* s, int i, int j, Nearest<T>& best) {
  const Vector3<T> e = s[j].w - s[i].w;
  const T square = dot(e, e);
  if (!(square > 0)) return;
  const T t = -dot(s[i].w, e) / square;
  if (!(t > 0 && t < 1)) return;
  Vector3<T> v = s[i].w + e * t;
  v = v - e * (dot(v, e) / square);
  consider(best, {2, {i, j, 0}, {1 - t, t, 0}, v, dot(v, v)});
}
/// Turns a triangle until its longest edge is opposite its first corner: a thin one's normal then has the most digits.
template <class T>
std::array<int, 3> best_corners(const Vertex<T>* s, int i, int j, int k) {
  const auto square = [s](int p, int q) {
    const Vector3<T> e = s[q].w - s[p].w;
    return dot(e, e);
  };
  const T opposite_i = square(j, k), opposite_j = square(k, i), opposite_k = square(i, j);
  if (opposite_i >= opposite_j && opposite_i >= opposite_k) return {i, j, k};
  return opposite_j >= opposite_k ? std::array<int, 3>{j, k, i} : std::array<int, 3>{k, i, j};
}
template <class T>
void consider_face(const Vertex<T>* s, int first, int second, int third, Nearest<T>& best) {
  const auto [i, j, k] = best_corners(s, first, second, third);
  const Vector3<T> e = s[j].w - s[i].w, f = s[k].w - s[i].w, n = cross(e, f);
  const T square = dot(n, n);
  if (!(square > 0)) return;
  const Vector3<T> p = -s[i].w;
  const T u = dot(cross(p, f), n) / square, v = dot(cross(e, p), n) / square;
  if (!(u > 0 && v > 0 && u + v < 1)) return;
  const T along = dot(n, s[i].w) / square;
  consider(best, {3, {i, j, k}, {1 - u - v, u, v}, n * along, along * along * square});
}
/// Whether the origin is inside a tetrahedron beyond doubt: by determinants larger than their rounding errors. (Cores
/// that all but touch make tetrahedra without thickness, whose signs are noise.)
template <class T>
bool encloses_origin(const Vertex<T>* s) {
  const T noise = 16 * unit<T>() * (16 * unit<T>());
  for (int l = 0; l < 4; ++l) {
    const Vector3<T>& p = s[(l + 1) & 3].w;
    const Vector3<T> e = s[(l + 2) & 3].w - p, f = s[(l + 3) & 3].w - p, g = s[l].w - p, n = cross(e, f);
    const T origin = -dot(n, p), opposite = dot(n, g), rough = noise * dot(e, e) * dot(f, f);
    if (!(origin * origin > rough * dot(p, p) && opposite * opposite > rough * dot(g, g))) return false;
    if ((origin > 0) != (opposite > 0)) return false;
  }
  return true;
}

/// What GJK ends with. The last vertex of a simplex is always its newest.
template <class T>
struct Gjk {
  bool overlap = false;
  Vertex<T> simplex[4];
  int count = 0;
  T distance = 0, separation = 0;
  Vector3<T> axis = {}, point_a = {}, point_b = {};
};

template <class T>
Gjk<T> gjk(Difference<T>& difference, const Vector3<T>& hint, T rounding, T absolute, T relative, T radii) {
  constexpr int k_iterations = 300;
  Gjk<T> result;
  Vector3<T> axis = hint;
  if (!(dot(axis, axis) > 0)) axis = difference.offset;
  if (!(dot(axis, axis) > 0)) axis = {1, 0, 0};
  axis = axis * (1 / norm(axis));
  Vertex<T>* const s = result.simplex;
  s[0] = difference.nearest_along(axis);
  result.count = 1;
  result.separation = dot(axis, s[0].w);
  result.axis = axis;
  T before = -1;
  for (int iteration = 0; iteration < k_iterations; ++iteration) {
    const int last = result.count - 1;
    if (result.count == 4 && encloses_origin(s)) {
      result.overlap = true;
      return result;
    }
    // In exact arithmetic the newest vertex is always part of the nearest feature.
    Nearest<T> nearest;
    consider_vertex(s, last, nearest);
    for (int i = 0; i < last; ++i) {
      consider_edge(s, i, last, nearest);
      for (int j = 0; j < i; ++j) consider_face(s, j, i, last, nearest);
    }
    if (before >= 0 && nearest.square >= before) return result;  // rounding: what is there is the best
    before = nearest.square;
    Vertex<T> kept[4];
    for (int i = 0; i < nearest.count; ++i) kept[i] = s[nearest.index[i]];
    std::copy(kept, kept + nearest.count, s);
    result.count = nearest.count;
    result.point_a = result.point_b = {0, 0, 0};
    for (int i = 0; i < nearest.count; ++i) {
      result.point_a = result.point_a + s[i].a * nearest.weight[i];
      result.point_b = result.point_b + s[i].b * nearest.weight[i];
    }
    result.distance = norm(difference.offset + (result.point_b - result.point_a));
    const T size = root(nearest.square);
    if (!(size > rounding)) {
      result.overlap = true;  // the boundary: the expanding polytope finds a depth of about 0
      return result;
    }
    axis = nearest.v * (1 / size);
    axis = axis * (1 / norm(axis));
    const Vertex<T> vertex = difference.nearest_along(axis);
    const T separation = dot(axis, vertex.w);
    if (separation > result.separation) {
      result.separation = separation;
      result.axis = axis;
    }
    const T wide = relative * magnitude(T(result.distance - radii));
    if (result.distance - result.separation <= (wide > absolute ? wide : absolute)) return result;
    for (int i = 0; i < result.count; ++i) {
      if (same(vertex.a, s[i].a) && same(vertex.b, s[i].b)) return result;
    }
    s[result.count++] = vertex;
  }
  return result;
}

/// Adds vertices to a simplex that touches the origin until it is a tetrahedron. False if the difference is flat; then
/// `normal` is orthogonal to it.
template <class T>
bool grow(Difference<T>& difference, Gjk<T>& simplex, T rounding, Vector3<T>& normal) {
  Vertex<T>* const s = simplex.simplex;
  while (simplex.count < 4) {
    const Vector3<T> e = simplex.count > 1 ? s[1].w - s[0].w : Vector3<T>{0, 0, 0};
    Vector3<T> across[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int directions = 3;
    if (simplex.count == 2) {
      const T x = magnitude(e.x), y = magnitude(e.y), z = magnitude(e.z);
      const int least = x <= y && x <= z ? 0 : y <= z ? 1 : 2;
      across[0] = cross(e, across[least]);
      across[0] = across[0] * (1 / norm(across[0]));
      across[1] = cross(e, across[0]) * (1 / norm(e));
      directions = 2;
    } else if (simplex.count == 3) {
      across[0] = cross(e, s[2].w - s[0].w);
      across[0] = across[0] * (1 / norm(across[0]));
      directions = 1;
    }
    T best = 0;
    Vertex<T> chosen = s[0];
    for (int i = 0; i < 2 * directions; ++i) {
      const Vector3<T> n = i % 2 == 0 ? across[i / 2] : -across[i / 2];
      const Vertex<T> vertex = difference.nearest_along(n);
      const T off = dot(n, s[0].w - vertex.w);
      if (off > best) {
        best = off;
        chosen = vertex;
      }
    }
    normal = across[0];
    if (!(best > rounding)) return false;
    s[simplex.count++] = chosen;
  }
  return true;
}

/// A closed surface of triangles around the origin, all in the difference. A facet gives way to a new point only if the
/// point is in front of it beyond doubt; then what is added can only wind around the origin once more, never less, and
/// the nearest plane is a lower bound of the depth even if rounding leaves a dent. Slivers have no front: they go with
/// their neighbours, and if the origin might have been between one and the new point, the bound is given up.
template <class T>
class Polytope {
 public:
  struct Facet {
    int vertex[3];
    int neighbour[3];   ///< across the edge from vertex k to vertex k + 1
    Vector3<T> normal;  ///< outwards
    T distance;         ///< of its plane from the origin
    T tilt;             ///< error of the normal
    T error;            ///< of the distance
    bool sliver;        ///< no area: its normal has no digits; it lies within rounding of its neighbours
    bool gone;
  };

  explicit Polytope(const Vertex<T> (&tetrahedron)[4]) : points_(tetrahedron, tetrahedron + 4) {
    const Vector3<T>& p = points_[0].w;
    const Vector3<T> normal = cross(points_[1].w - p, points_[2].w - p);
    if (dot(normal, points_[3].w - p) > 0) std::swap(points_[1], points_[2]);
    add(0, 1, 2, {1, 3, 2});
    add(0, 3, 1, {2, 3, 0});
    add(0, 2, 3, {0, 3, 1});
    add(1, 3, 2, {1, 2, 0});
  }

  /// The facet whose plane may be nearest, or -1.
  int nearest() {
    while (!queue_.empty() && facets_[queue_.top().second].gone) queue_.pop();
    return queue_.empty() ? -1 : static_cast<int>(queue_.top().second);
  }
  const Facet& facet(int index) const { return facets_[static_cast<size_t>(index)]; }
  bool has_corner(int index, const Vertex<T>& vertex) const {
    for (const int i : facet(index).vertex) {
      const Vertex<T>& corner = points_[static_cast<size_t>(i)];
      if (same(corner.a, vertex.a) && same(corner.b, vertex.b)) return true;
    }
    return false;
  }

  /// Lower bound of the depth, if facet `index` is nearest().
  T floor(int index) const {
    const Facet& f = facet(index);
    return doubtful_ || !(f.distance > f.error) ? T(0) : T(f.distance - f.error);
  }

  /// Takes in a point beyond the facet `seen`. False if what would be left is no polytope.
  bool enlarge(int seen, const Vertex<T>& vertex, T rounding) {
    horizon_.clear();
    if (!in_front(facet(seen), vertex.w, rounding)) return false;
    seen_normal_ = facet(seen).normal;
    at(seen).gone = true;
    for (int k = 0; k < 3; ++k) look(seen, k, vertex.w, rounding);
    if (horizon_.size() < 3) return false;
    const int apex = static_cast<int>(points_.size()), first = static_cast<int>(facets_.size());
    const int count = static_cast<int>(horizon_.size());
    points_.push_back(vertex);
    for (int i = 0; i < count; ++i) {
      const auto [from, to, beyond, edge] = horizon_[static_cast<size_t>(i)];
      if (to != horizon_[static_cast<size_t>((i + 1) % count)][0]) return false;
      at(beyond).neighbour[edge] = first + i;
      add(from, to, apex, {beyond, first + (i + 1) % count, first + (i + count - 1) % count});
    }
    return true;
  }

 private:
  Facet& at(int index) { return facets_[static_cast<size_t>(index)]; }

  void add(int i, int j, int k, const std::array<int, 3>& neighbours) {
    const auto point = [this](int index) { return points_[static_cast<size_t>(index)].w; };
    Facet f = {{i, j, k}, {neighbours[0], neighbours[1], neighbours[2]}, {0, 0, 0}, 0, 0, 0, true, false};
    const auto [p, q, r] = best_corners(points_.data(), i, j, k);
    const Vector3<T> e = point(q) - point(p), g = point(r) - point(p), n = cross(e, g);
    const T size = norm(n), rough = norm(e) * norm(g) * unit<T>();
    if (size > 64 * rough) {
      f.sliver = false;
      f.normal = n * (1 / size);
      Vector3<T> corner = point(i);
      for (const int other : {j, k}) {
        if (dot(point(other), point(other)) < dot(corner, corner)) corner = point(other);
      }
      f.distance = dot(f.normal, corner);
      f.tilt = 16 * rough / size;
      f.error = f.tilt * norm(corner);
      queue_.push({f.distance - f.error, facets_.size()});
    }
    facets_.push_back(f);
  }

  bool in_front(const Facet& f, const Vector3<T>& w, T rounding) const {
    Vector3<T> arm = w - points_[static_cast<size_t>(f.vertex[0])].w;
    for (const int i : f.vertex) {
      const Vector3<T> other = w - points_[static_cast<size_t>(i)].w;
      if (dot(other, other) < dot(arm, arm)) arm = other;
    }
    const T beyond = dot(f.normal, arm) - rounding;
    return beyond > 0 && beyond * beyond > f.tilt * f.tilt * dot(arm, arm);
  }
  /// Whether the origin may lie between a facet and a point: surely not if all are before the nearest facet's plane
  /// moved to the origin.
  bool may_hold_origin(const Facet& f, const Vector3<T>& w, T rounding) const {
    bool before = dot(seen_normal_, w) > rounding;
    for (const int i : f.vertex) before = before && dot(seen_normal_, points_[static_cast<size_t>(i)].w) > rounding;
    return !before;
  }

  /// Goes on across edge k of a facet that the point sees; the horizon comes out in order.
  void look(int from, int k, const Vector3<T>& w, T rounding) {
    const int index = facet(from).neighbour[k];
    if (facet(index).gone) return;
    // Two facets may share two edges: this is the one that runs the other way.
    int entry = 0;
    while (entry < 2 &&
           (facet(index).neighbour[entry] != from || facet(index).vertex[entry] != facet(from).vertex[(k + 1) % 3])) {
      ++entry;
    }
    const Facet& f = facet(index);
    if (f.sliver || in_front(f, w, rounding)) {
      if (f.sliver) doubtful_ = doubtful_ || may_hold_origin(f, w, rounding);
      at(index).gone = true;
      look(index, (entry + 1) % 3, w, rounding);
      look(index, (entry + 2) % 3, w, rounding);
    } else {
      horizon_.push_back({facet(from).vertex[k], facet(from).vertex[(k + 1) % 3], index, entry});
    }
  }

  Vector3<T> seen_normal_ = {};
  bool doubtful_ = false;
  std::vector<Vertex<T>> points_;
  std::vector<Facet> facets_;
  std::vector<std::array<int, 4>> horizon_;  ///< from, to, the facet beyond and its edge
  std::priority_queue<std::pair<T, size_t>, std::vector<std::pair<T, size_t>>, std::greater<>> queue_;
};

template <class T>
struct Depth {
  T least = 0, most = 0;
  Vector3<T> axis = {};  ///< from A to B: pushing B this far along it separates the cores
};

/// Expanding polytope, from a simplex that holds the origin.
template <class T>
Depth<T> expand(Difference<T>& difference, Gjk<T>& start, T rounding, T absolute, T relative) {
  constexpr int k_expansions = 400;
  Depth<T> depth;
  Vector3<T> flat = {};
  if (start.count < 4 && !grow(difference, start, rounding, flat)) {
    const T one = -dot(flat, difference.nearest_along(flat).w);
    const T other = dot(flat, difference.nearest_along(-flat).w);
    depth.axis = other < one ? -flat : flat;
    depth.most = other < one ? other : one;
    if (depth.most < 0) depth.most = 0;
    return depth;
  }
  Polytope<T> polytope(start.simplex);
  depth.most = T(1e300);
  for (int expansion = 0; expansion < k_expansions; ++expansion) {
    const int nearest = polytope.nearest();
    if (nearest < 0) return depth;
    const auto& facet = polytope.facet(nearest);
    const Vertex<T> vertex = difference.nearest_along(-facet.normal);
    const T distance_max = dot(facet.normal, vertex.w);
    if (distance_max < depth.most) {
      depth.most = distance_max;
      depth.axis = -facet.normal;
    }
    depth.least = polytope.floor(nearest);
    const T wide = relative * depth.most;
    if (depth.most - depth.least <= (wide > absolute ? wide : absolute)) return depth;
    if (polytope.has_corner(nearest, vertex) || !polytope.enlarge(nearest, vertex, rounding)) return depth;
  }
  return depth;
}

template <class T>
Separation solve(const ConvexSolid& a, const ConvexSolid& b, const Placement& placement, const Accuracy& accuracy,
                 const Arrow& hint, Number rounding) {
  Difference<T> difference(a, b, placement);
  const T scale = static_cast<T>(rounding) / 64, absolute = static_cast<T>(accuracy.absolute);
  const T tiny = sizeof(T) > sizeof(Number) || std::numeric_limits<Number>::digits > 64 ? scale / 65536 : scale;
  const T relative = static_cast<T>(accuracy.relative), radii = static_cast<T>(a.rounding + b.rounding);
  Gjk<T> found = gjk<T>(difference, cast<T>(hint), tiny, absolute, relative, radii);
  Separation result;
  result.overlap = found.overlap;
  if (!found.overlap) {
    result.distance = static_cast<Number>(found.distance);
    result.separation = static_cast<Number>(found.separation);
    result.axis = cast<Number>(found.axis);
    result.point_a = cast<Number>(found.point_a);
    result.point_b = cast<Number>(found.point_b);
    result.slack = static_cast<Number>(found.distance - found.separation);
  } else {
    const T coarse = static_cast<T>(k_depth_relative);
    const Depth<T> depth = expand<T>(difference, found, tiny, absolute, relative > coarse ? relative : coarse);
    result.separation = static_cast<Number>(-depth.most);
    result.depth_floor = static_cast<Number>(depth.least);
    result.axis = cast<Number>(depth.axis);
    result.slack = static_cast<Number>(depth.most - depth.least);
  }
  result.iterations = difference.asked;
  return result;
}

/// A half-space has one axis only, and its boundary holds its position.
Separation against_half_space(const ConvexSolid& a, const ConvexSolid& b, const Placement& placement) {
  const bool first = a.core == CoreKind::half_space;
  Separation result;
  result.axis = first ? placement.a.axis[1] : -placement.b.axis[1];
  result.separation = separation_along(a, b, placement, result.axis);
  result.overlap = result.separation < 0;
  result.distance = std::max(result.separation, 0.0L);
  result.depth_floor = std::max(-result.separation, 0.0L);
  result.iterations = 1;
  const Difference<Number> difference(a, b, placement);
  if (first) {
    result.point_b = Difference<Number>::support_in_world(b, difference.axes_b, -result.axis);
    result.point_a = placement.offset + result.point_b - result.axis * result.separation;
  } else {
    result.point_a = Difference<Number>::support_in_world(a, difference.axes_a, result.axis);
    result.point_b = result.point_a + result.axis * result.separation - placement.offset;
  }
  return result;
}

}  // namespace

Number rounding_of(const ConvexSolid& a, const ConvexSolid& b, const Arrow& offset) {
  return 32 * std::numeric_limits<Number>::epsilon() * (length(offset) + a.distance_max + b.distance_max);
}

Number separation_along(const ConvexSolid& a, const ConvexSolid& b, const Placement& placement, const Arrow& axis) {
  return dot(axis, placement.offset) - support_value(a, to_local(placement.a, axis)) -
         support_value(b, to_local(placement.b, -axis));
}

Separation separation_of(const ConvexSolid& a, const ConvexSolid& b, const Placement& placement,
                         const Accuracy& accuracy, const Arrow& hint) {
  Separation result;
  if (a.core == CoreKind::half_space || b.core == CoreKind::half_space) {
    result = against_half_space(a, b, placement);
  } else {
    const Number rounding = rounding_of(a, b, placement.offset), size = size_of(a, b);
    Accuracy wanted = accuracy;
    if (!(wanted.absolute > 0)) wanted.absolute = std::max(rounding, 1e-16L * size);
    result = solve<Number>(a, b, placement, wanted, hint, rounding);
    const Number gap = result.overlap ? result.separation : result.distance - a.rounding - b.rounding;
    Number enough = std::max(16 * wanted.absolute, wanted.relative * fabsl(gap));
    if (result.overlap) enough = std::max(enough, -16 * k_depth_relative * result.separation);
    if (!(result.slack <= enough) && !(result.overlap && a.rounding + b.rounding > 0)) {
      const int iterations = result.iterations;
      const Separation again = solve<Wide>(a, b, placement, wanted, result.axis, rounding);
      if (!(again.slack > result.slack)) result = again;
      result.iterations = again.iterations + iterations;
      result.quadruple = true;
    }
  }
  const Number radii = a.rounding + b.rounding;
  result.gap = (result.overlap ? result.separation : result.distance) - radii;
  result.gap_floor = result.separation - radii;
  return result;
}

Separation separation_of(const detent_queries::Query& query) {
  const Encounter encounter = encounter_of(query);
  return separation_of(encounter.a, encounter.b, placement_at(encounter, 0));
}

}  // namespace detent_oracle
