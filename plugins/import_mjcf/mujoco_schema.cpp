#include "mujoco_schema.h"

#include <mujoco/mujoco.h>

#include <map>
#include <set>
#include <sstream>
#include <vector>

namespace handway::import_mjcf {
namespace {

using Schema = std::map<std::string, std::set<std::string>>;  // attributes by element

// MuJoCo prints `element (?)  attribute attribute …`, and more of them on lines of their own. It
// stands for `body` and `worldbody` as `(world)body`.
Schema printed_schema() {
  constexpr std::size_t kRoom = std::size_t{1} << 18;
  std::vector<char> text(kRoom);
  mj_printSchema(nullptr, text.data(), static_cast<int>(kRoom), 0, 0);
  Schema schema;
  std::set<std::string>* attributes = nullptr;
  std::istringstream lines(text.data());
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    if (line.find('(') != std::string::npos) {
      words >> word;
      attributes = &schema[word.substr(word.find(')') + 1)];
      words >> word;
    }
    while (attributes != nullptr && words >> word) {
      attributes->insert(word);
    }
  }
  return schema;
}

}  // namespace

bool knows_attribute(const std::string& element, const std::string& attribute) {
  static const Schema kSchema = printed_schema();
  const auto known = kSchema.find(element);
  return known == kSchema.end() || known->second.contains(attribute);
}

}  // namespace handway::import_mjcf
