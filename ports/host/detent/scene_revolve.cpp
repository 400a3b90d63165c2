#include "scene_revolve.h"

#include <math.h>

#include <algorithm>

namespace detent_tool {

namespace {

constexpr double k_radians = 3.14159265358979323846 / 180.0;

/// A rotation quaternion x, y, z, w.
struct Turn {
  double x = 0, y = 0, z = 0, w = 1;
};

/// The rotation b followed by a.
Turn product(const Turn& a, const Turn& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

/// Sine and cosine of an angle within +-pi/2, computed by their series with a remainder below an ulp. The functions of
/// the C library are not used, because they differ from machine to machine.
void sine_and_cosine(double angle, double& sine, double& cosine) {
  constexpr int k_terms = 13;
  const double square = angle * angle;
  sine = cosine = 1;
  for (int i = k_terms; i > 0; --i) {
    cosine = 1 - square * cosine / ((2 * i - 1) * (2 * i));
    sine = 1 - square * sine / ((2 * i) * (2 * i + 1));
  }
  sine *= angle;
}

/// Makes the rotation about an axis. Returns false if the axis has no direction.
bool rotate_about(const double (&axis)[3], double degrees, Turn& revolution) {
  const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  if (!(length > 1e-6)) return false;
  const double rest = degrees - 360 * floor(degrees / 360 + 0.5);
  double sine, cosine;
  sine_and_cosine(rest / 2 * k_radians, sine, cosine);
  revolution = {axis[0] / length * sine, axis[1] / length * sine, axis[2] / length * sine, cosine};
  return true;
}

void rotate(const Turn& revolution, double (&v)[3]) {
  const Turn back = {-revolution.x, -revolution.y, -revolution.z, revolution.w};
  const Turn result = product(product(revolution, {v[0], v[1], v[2], 0}), back);
  v[0] = result.x;
  v[1] = result.y;
  v[2] = result.z;
}

/// Reads the forms listed in docs/scene.md.
bool read_rotation(const Node& node, Turn& revolution) {
  if (is_numbers(node, 4)) {
    const auto& items = node.items;
    revolution = {items[0].number, items[1].number, items[2].number, items[3].number};
    const double square = revolution.x * revolution.x + revolution.y * revolution.y + revolution.z * revolution.z +
                          revolution.w * revolution.w;
    return square > 0.998 && square < 1.002;  // the reader's limits
  }
  if (node.kind != NodeKind::object) return false;
  if (const Node* const angles = member_of(node, "euler_degrees")) {
    if (!is_numbers(*angles, 3) || node.keys.size() != 1) return false;
    for (size_t i = 0; i < 3; ++i) {
      double axis[3] = {};
      axis[i] = 1;
      Turn part;
      rotate_about(axis, angles->items[i].number, part);
      revolution = product(part, revolution);
    }
    return true;
  }
  const Node* const axis = member_of(node, "axis");
  const Node* const degrees = member_of(node, "degrees");
  if (axis == nullptr || degrees == nullptr || node.keys.size() != 2) return false;
  if (!is_numbers(*axis, 3) || degrees->kind != NodeKind::number) return false;
  return rotate_about({axis->items[0].number, axis->items[1].number, axis->items[2].number}, degrees->number,
                      revolution);
}

Node rotation_node(const Turn& revolution, uint32_t line) {
  const double length = sqrt(revolution.x * revolution.x + revolution.y * revolution.y + revolution.z * revolution.z +
                             revolution.w * revolution.w);
  Node node;
  node.kind = NodeKind::array;
  node.line = line;
  for (const double value : {revolution.x, revolution.y, revolution.z, revolution.w}) {
    Node& item = node.items.emplace_back();
    item.kind = NodeKind::number;
    item.line = line;
    item.number = std::clamp(value / length, -1.0, 1.0);
  }
  return node;
}

void revolve_vector(Node& entry, const char* key, const Turn& revolution, const double (&about)[3]) {
  Node* const node = member_of(entry, key);
  if (node == nullptr || !is_numbers(*node, 3)) return;
  double v[3];
  for (size_t i = 0; i < 3; ++i) v[i] = node->items[i].number - about[i];
  rotate(revolution, v);
  for (size_t i = 0; i < 3; ++i) node->items[i].number = v[i] + about[i];
}

/// Rotates the rotation in `key`. `beside`: if this key is present and `key` is missing, adds `key`, as if it were the
/// rotation by 0.
void turn_rotation(Node& entry, const char* key, const char* beside, const Turn& revolution) {
  Node* const node = member_of(entry, key);
  Turn own;
  if (node != nullptr) {
    if (read_rotation(*node, own)) *node = rotation_node(product(revolution, own), node->line);
  } else if (member_of(entry, beside) != nullptr) {
    entry.keys.push_back(key);
    entry.items.push_back(rotation_node(revolution, entry.line));
  }
}

}  // namespace

const Node* member_of(const Node& object, const char* key) {
  const auto found = std::find(object.keys.begin(), object.keys.end(), key);
  return found == object.keys.end() ? nullptr : &object.items[static_cast<size_t>(found - object.keys.begin())];
}
Node* member_of(Node& object, const char* key) {
  return const_cast<Node*>(member_of(static_cast<const Node&>(object), key));
}

bool is_numbers(const Node& node, size_t count) {
  return node.kind == NodeKind::array && node.items.size() == count &&
         std::all_of(node.items.begin(), node.items.end(),
                     [](const Node& item) { return item.kind == NodeKind::number; });
}

void revolve_entry(Node& entry, const SceneRevolution& revolution) {
  Turn made;
  if (!rotate_about(revolution.axis, revolution.degrees, made)) return;
  constexpr double k_origin[3] = {0, 0, 0};
  for (const char* key : {"position", "point"}) revolve_vector(entry, key, made, revolution.about);
  for (const char* key : {"linear_velocity", "angular_velocity"}) revolve_vector(entry, key, made, k_origin);
  turn_rotation(entry, "rotation", "position", made);
  turn_rotation(entry, "frame", "point", made);
}

}  // namespace detent_tool
