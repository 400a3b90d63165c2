#include "scene_reader.h"

#include <detent/numbers.h>
#include <math.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "scene_repeat.h"
#include "scene_words.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr size_t k_assets_max = 1024;

std::string written(double value) {
  char text[64];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return std::string(text, error == std::errc() ? end : text);
}

std::string outside(double value, const Range& range) {
  const bool low = range.low > -HUGE_VAL, high = range.high < HUGE_VAL;
  if (low && high) return written(value) + " is not in [" + written(range.low) + ", " + written(range.high) + "]";
  if (high) return written(value) + " is above " + written(range.high);
  return written(value) + (range.above ? " is not above " : " is below ") + written(range.low);
}

bool in_range(double value, const Range& range) {
  return value <= range.high && (range.above ? value > range.low : value >= range.low);
}

/// Rotates by `degrees` about an axis of any length. Uses only sums, products, quotients and roots of doubles, whose
/// results are the same on every machine, and then the library's own rotation.
Quat turned_about(const Quat& rotation, const double (&axis)[3], double degrees) {
  const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  const double angle = degrees * (3.14159265358979323846 / 180.0);
  Vec3<Real> rotation_vector = {0.0, 0.0, 0.0};
  Real* const part[3] = {&rotation_vector.x, &rotation_vector.y, &rotation_vector.z};
  for (int i = 0; i < 3; ++i) {
    // The angle is bounded, and the quotient within [-1, 1].
    if (real_from_host(axis[i] / length * angle, *part[i]) != Status::ok) return rotation;
  }
  return rotated_by(rotation, rotation_vector);
}

}  // namespace

void SceneReading::problem(const SceneOrigin& origin, const std::string& text) {
  if (!is_full()) problems.push_back({origin.line, origin.path, text});
}
void SceneReading::problem(const Node& node, const std::string& path, const std::string& text) {
  problem({node.line, path}, text);
}

ObjectReader::ObjectReader(SceneReading& reading, const Node& node, const std::string& path)
    : reading_(reading), node_(node), path_(path) {}

size_t ObjectReader::index_of(const char* key) const {
  return static_cast<size_t>(std::find(node_.keys.begin(), node_.keys.end(), key) - node_.keys.begin());
}

SceneOrigin ObjectReader::origin_of(const char* key) const {
  const size_t index = index_of(key);
  return {index < node_.items.size() ? node_.items[index].line : node_.line, path_of(key)};
}

void ObjectReader::problem(const char* key, const std::string& text) { reading_.problem(origin_of(key), text); }

const Node* ObjectReader::take(const SceneField& field) {
  known_.push_back(field.key);
  const size_t index = index_of(field.key);
  if (index < node_.keys.size()) return &node_.items[index];
  if (field.required) reading_.problem(node_, path_of(field.key), "is missing");
  return nullptr;
}

bool ObjectReader::is(const Node& node, NodeKind kind, const std::string& path) {
  if (node.kind == kind) return true;
  const char* const names[] = {"null", "true or false", "a number", "a text", "a list", "an object"};
  reading_.problem(node, path, std::string("is not ") + names[static_cast<uint32_t>(kind)]);
  return false;
}

bool ObjectReader::number(const SceneField& field, const Node& node, const std::string& path, double& value) {
  if (!is(node, NodeKind::number, path)) return false;
  if (!in_range(node.number, field.range)) {
    reading_.problem(node, path, outside(node.number, field.range));
    return false;
  }
  value = node.number;
  return true;
}

bool ObjectReader::whole_number(const SceneField& field, const Node& node, double& value) {
  double read = 0;
  if (!number(field, node, path_of(field.key), read)) return false;
  if (read != floor(read)) {
    reading_.problem(node, path_of(field.key), written(read) + " is not a whole number");
    return false;
  }
  value = read;
  return true;
}

bool ObjectReader::numbers(const SceneField& field, const Node& node, const std::string& path, double* values,
                           size_t count) {
  if (node.kind != NodeKind::array || node.items.size() != count) {
    reading_.problem(node, path, "is not a list of " + std::to_string(count) + " numbers");
    return false;
  }
  bool good = true;
  for (size_t i = 0; i < count; ++i) {
    good = number(field, node.items[i], path + "[" + std::to_string(i) + "]", values[i]) && good;
  }
  return good;
}

template <class T>
void ObjectReader::convert_one(const SceneField& field, T& value, Status (*convert)(double, T&), const Node* node) {
  double number_read = 0;
  if (node == nullptr || !number(field, *node, path_of(field.key), number_read)) return;
  if (convert(number_read, value) != Status::ok) {
    reading_.problem(*node, path_of(field.key), written(number_read) + " is out of range");
  }
}

void ObjectReader::repeated() {
  for (const FieldInfo& info : repeat_fields()) {
    if (!given(info.key.c_str())) continue;
    known_.push_back(info.key);
    problem(info.key.c_str(), info.key == "repeat" ? "is for entries of the scene's lists" : "goes with `repeat`");
  }
}

bool ObjectReader::real(const SceneField& field, Real& value) {
  const Node* const node = take(field);
  convert_one<Real>(field, value, real_from_host, node);
  return node != nullptr;
}

bool ObjectReader::scaled(const SceneField& field, Scaled& value) {
  const Node* const node = take(field);
  convert_one<Scaled>(field, value, scaled_from_host, node);
  return node != nullptr;
}

template <class T>
bool ObjectReader::three(const SceneField& field, Vec3<T>& value, Status (*convert)(double, T&)) {
  const Node* const node = take(field);
  double read[3] = {};
  if (node == nullptr || !numbers(field, *node, path_of(field.key), read, 3)) return node != nullptr;
  Vec3<T> result = value;
  T* const part[3] = {&result.x, &result.y, &result.z};
  for (size_t i = 0; i < 3; ++i) {
    if (convert(read[i], *part[i]) == Status::ok) continue;
    reading_.problem(node->items[i], path_of(field.key, i), written(read[i]) + " is out of range");
    return true;
  }
  value = result;
  return true;
}

bool ObjectReader::vector(const SceneField& field, Vec3<Real>& value) {
  return three<Real>(field, value, real_from_host);
}
bool ObjectReader::scaleds(const SceneField& field, Vec3<Scaled>& value) {
  return three<Scaled>(field, value, scaled_from_host);
}
bool ObjectReader::position(const SceneField& field, Position& value) {
  return three<Coord>(field, value, coord_from_host);
}

bool ObjectReader::rotation(const SceneField& field, Quat& value) {
  const Node* const node = take(field);
  if (node == nullptr) return false;
  if (node->kind == NodeKind::object) {
    turned(*node, path_of(field.key), value);
    return true;
  }
  const SceneField part = {field.key, field.doc, within(1)};
  double read[4] = {};
  if (!numbers(part, *node, path_of(field.key), read, 4)) return true;
  const double length = read[0] * read[0] + read[1] * read[1] + read[2] * read[2] + read[3] * read[3];
  if (length < 0.998 || length > 1.002) {
    reading_.problem(*node, path_of(field.key), "the quaternion's length is not 1");
    return true;
  }
  Unit* const component[4] = {&value.x, &value.y, &value.z, &value.w};
  for (size_t i = 0; i < 4; ++i) {
    if (unit_from_host(read[i], *component[i]) != Status::ok) return true;  // never: a component is within 1
  }
  return true;
}

void ObjectReader::turned(const Node& node, const std::string& path, Quat& value) {
  constexpr Quat k_upright = {0.0, 0.0, 0.0, 1.0};
  constexpr double k_axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Range turns = within(36000);
  ObjectReader reader(reading_, node, path);
  double axis[3] = {}, degrees = 0, angles[3] = {};
  if (reader.given("euler_degrees")) {
    const SceneField field = {"euler_degrees", "", turns};
    const Node* const read = reader.take(field);
    if (reader.numbers(field, *read, reader.path_of(field.key), angles, 3)) {
      value = k_upright;
      for (int i = 0; i < 3; ++i) value = turned_about(value, k_axes[i], angles[i]);
    }
  } else {
    const SceneField axis_field = required({"axis", "", within(1e6)}), angle_field = required({"degrees", "", turns});
    const Node* const read = reader.take(axis_field);
    const Node* const angle = reader.take(angle_field);
    if (read != nullptr && angle != nullptr &&
        reader.numbers(axis_field, *read, reader.path_of(axis_field.key), axis, 3) &&
        reader.number(angle_field, *angle, reader.path_of(angle_field.key), degrees)) {
      if (axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2] < 1e-12) {
        reading_.problem(*read, reader.path_of(axis_field.key), "has no direction");
      } else {
        value = turned_about(k_upright, axis, degrees);
      }
    }
  }
  reader.judge_keys();
}

bool ObjectReader::flag(const SceneField& field, bool& value) {
  const Node* const node = take(field);
  if (node != nullptr && is(*node, NodeKind::boolean, path_of(field.key))) value = node->boolean;
  return node != nullptr;
}

bool ObjectReader::text(const SceneField& field, std::string& value) {
  const Node* const node = take(field);
  if (node != nullptr && is(*node, NodeKind::text, path_of(field.key))) value = node->text;
  return node != nullptr;
}

bool ObjectReader::name(const SceneField& field, std::string& value, bool joint) {
  if (!text(field, value)) return false;
  reading_.references.push_back(
      {{node_.items[index_of(field.key)].line, path_of(field.key)}, value, joint, path_.compare(0, 7, "actions") == 0});
  return true;
}

void ObjectReader::asset(Shape& shape) {
  SceneAsset asset;
  asset.type = shape.type;
  text(required({"file", "cooked, from the scene's folder"}), asset.file);
  text({"digest", "16 hexadecimal digits that its content must have"}, asset.digest);
  if (asset.digest.size() != 16 && !asset.digest.empty()) problem("digest", "has not 16 digits");
  std::vector<SceneAsset>& assets = reading_.assets;
  for (shape.asset = 0; shape.asset < assets.size(); ++shape.asset) {
    const SceneAsset& known = assets[shape.asset];
    if (known.type == asset.type && known.file == asset.file && known.digest == asset.digest) return;
  }
  asset.file_origin = origin_of("file");
  asset.digest_origin = origin_of("digest");
  if (assets.size() < k_assets_max) return assets.push_back(asset);
  problem("file", "is one of more than " + std::to_string(k_assets_max) + " cooked files");
}

size_t ObjectReader::find_choice(const Node& node, const std::string& path, const std::vector<const char*>& names) {
  if (!is(node, NodeKind::text, path)) return names.size();
  const auto found = std::find(names.begin(), names.end(), node.text);
  if (found == names.end()) {
    reading_.problem(node, path,
                     quoted(node.text) + " is unknown" + suggestion(node.text, {names.begin(), names.end()}));
  }
  return static_cast<size_t>(found - names.begin());
}

void ObjectReader::judge_keys() {
  if (!judged_) return;
  for (size_t i = 0; i < node_.keys.size(); ++i) {
    const std::string& key = node_.keys[i];
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    reading_.problem(node_.items[i], path_of(key.c_str()), "is unknown here" + suggestion(key, known_));
  }
}

namespace {

/// Checks that each name is defined once and that each reference has a definition.
void judge_names(SceneReading& reading) {
  std::set<std::string> first[2], all[2];
  const auto take = [&](const std::string& name, const SceneOrigin& origin, bool joint, bool action) {
    if (name.empty()) return;
    all[joint].insert(name);
    if (action || first[joint].insert(name).second) return;
    reading.problem({origin.line, origin.path + ".name"}, ObjectReader::quoted(name) + " is taken");
  };
  const SceneText& scene = reading.scene;
  for (const SceneBody& body : scene.bodies) take(body.name, body.origin, false, false);
  for (const SceneJoint& joint : scene.joints) take(joint.name, joint.origin, true, false);
  for (const SceneAction& action : scene.actions) {
    take(action.new_body.name, action.new_body.origin, false, true);
    take(action.new_joint.name, action.new_joint.origin, true, true);
  }
  for (const SceneReference& reference : reading.references) {
    const std::set<std::string>& names = reference.action ? all[reference.joint] : first[reference.joint];
    if (names.count(reference.name) != 0) continue;
    if (reading.is_full()) return;
    reading.problem(reference.origin, std::string("no ") + (reference.joint ? "joint" : "body") + " has the name " +
                                          ObjectReader::quoted(reference.name) +
                                          suggestion(reference.name, {names.begin(), names.end()}));
  }
}

/// Computes the capacities that the file leaves out.
void count_capacity(SceneReading& reading) {
  const SceneText& scene = reading.scene;
  uint32_t bodies = static_cast<uint32_t>(scene.bodies.size()), joints = static_cast<uint32_t>(scene.joints.size());
  bool sensors = false;
  for (const SceneBody& body : scene.bodies) sensors = sensors || body.def.sensor;
  for (const SceneAction& action : scene.actions) {
    const uint32_t times = std::min(action.until - action.tick + 1, k_json_values_max);
    bodies += action.call == Call::create_body ? times : 0;
    joints += action.call == Call::create_joint ? times : 0;
    sensors = sensors || action.new_body.def.sensor || (action.call == Call::set_sensor && action.flag);
    bodies = std::min(bodies, k_json_values_max);
    joints = std::min(joints, k_json_values_max);
  }
  Capacity& capacity = reading.scene.world.capacity;
  const auto fill = [](uint32_t& value, uint32_t count) {
    if (value == k_counted) value = std::min(count, k_json_values_max);
  };
  fill(capacity.bodies, std::max(bodies, 1u));
  fill(capacity.contacts, 64 + 8 * bodies);
  fill(capacity.assets, static_cast<uint32_t>(reading.assets.size()));
  fill(capacity.joints, joints);
  fill(capacity.sensed, sensors ? 64 + 8 * bodies : 0);
}

}  // namespace

void read_scene(const Node& root, SceneReading& reading) {
  reading.scene.world.capacity = {k_counted, k_counted, k_counted, true, k_counted, k_counted};
  ObjectReader::read(reading, root, "", reading.scene);
  if (reading.problems.empty()) judge_names(reading);
  if (reading.problems.empty()) count_capacity(reading);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
