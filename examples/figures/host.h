#pragma once
#include <detent/numbers.h>
#include <stdio.h>
#include <stdlib.h>

/// Between the library's numbers and those of a drawing.
namespace figures {

/// A figure's world is made as it is written here: what cannot be made is a fault of the program.
inline void must(detent::Status status, int line = __builtin_LINE()) {
  if (status == detent::Status::ok) return;
  fprintf(stderr, "line %d: %s\n", line, detent::status_text(status));
  exit(1);
}

inline detent::Real real(double value) {
  detent::Real result{};
  must(detent::real_from_host(value, result));
  return result;
}
inline detent::Coord coord(double value) {
  detent::Coord result{};
  must(detent::coord_from_host(value, result));
  return result;
}
inline detent::Vec3<detent::Real> vector(double x, double y, double z) { return {real(x), real(y), real(z)}; }
inline detent::Position position(double x, double y, double z) { return {coord(x), coord(y), coord(z)}; }

using Vector = detent::Vec3<double>;
inline Vector host(const detent::Position& p) {
  return {detent::coord_to_host(p.x), detent::coord_to_host(p.y), detent::coord_to_host(p.z)};
}
inline Vector host_vector(const detent::Vec3<detent::Real>& v) {
  return {detent::real_to_host(v.x), detent::real_to_host(v.y), detent::real_to_host(v.z)};
}
inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(double scale, const Vector& a) { return {scale * a.x, scale * a.y, scale * a.z}; }

/// The place in the world of a point given in the body's axes.
inline Vector world_point(const detent::Pose& pose, double x, double y, double z) {
  return host(detent::to_world(pose, vector(x, y, z)));
}

inline constexpr detent::Quat k_unturned = {0.0, 0.0, 0.0, 1.0};
/// A turn about z, rad.
inline detent::Quat turned(double angle) { return detent::rotated_by(k_unturned, vector(0, 0, angle)); }

}  // namespace figures
