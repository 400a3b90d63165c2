#pragma once
#include <stdint.h>

#include <string>
#include <utility>
#include <vector>

namespace detent_tool {

/// A page of the viewer while it is written: the template of ports/web/build, and the contents to show.
class ViewPage {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  /// Reads the template of this configuration. `path`: the file that the page will show. Returns the problem; empty if
  /// none.
  std::string open(const std::string& path, const std::string& config);
  /// Adds an element of these bytes: a recording, a scene or an asset. The attributes may have any content.
  void add(const std::string& kind, const Attributes& attributes, const uint8_t* bytes, size_t count);
  /// Returns the problem; empty if none.
  std::string write(const std::string& output) const;

 private:
  std::string page_;
  size_t mark_ = 0;
  std::string elements_;
};

}  // namespace detent_tool
