#pragma once
#include <detent/config.h>

#include <map>
#include <string>
#include <utility>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The names of the bodies or joints that exist. Id: BodyId or JointId.
template <class Id>
class SceneNames {
 public:
  /// An object with an empty name is called by its kind and slot: "body 7".
  explicit SceneNames(const char* kind) : kind_(kind) {}
  /// Null if no existing object has the name.
  Id find(const std::string& name) const {
    const auto found = ids_.find(name);
    return found == ids_.end() ? Id{} : found->second;
  }
  void add(const std::string& name, Id id) {
    if (name.empty()) return;
    ids_[name] = id;
    names_[id.slot] = {id, name};
  }
  std::string of(Id id) const {
    const auto found = names_.find(id.slot);
    if (found != names_.end() && found->second.first == id) return found->second.second;
    return std::string(kind_) + " " + std::to_string(id.slot);
  }

 private:
  const char* kind_;
  std::map<std::string, Id> ids_;
  std::map<uint32_t, std::pair<Id, std::string>> names_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
