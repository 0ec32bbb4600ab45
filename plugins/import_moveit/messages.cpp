#include "messages.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace handway::import_moveit {
namespace {

using geometric::Pose;
using geometric::YamlElement;

constexpr double kUnitTolerance = 0.01;

double coordinate(const YamlElement& map, const char* key, double missing) {
  const std::optional<YamlElement> value = map.find(key);
  return value ? value->number() : missing;
}

}  // namespace

Eigen::Quaterniond read_rotation(const YamlElement& element) {
  Eigen::Vector4d q;  // x, y, z, w
  if (element.is_list()) {
    q = element.numbers(4);
  } else {
    element.allow_keys({"x", "y", "z", "w"});
    q = {coordinate(element, "x", 0.0), coordinate(element, "y", 0.0),
         coordinate(element, "z", 0.0), coordinate(element, "w", 0.0)};
  }
  if (std::abs(q.norm() - 1.0) > kUnitTolerance) {
    element.refuse(fmt::format("a quaternion of length {:.3g}", q.norm()),
                   "x, y, z, w of length 1");
  }
  q.normalize();
  return {q[3], q[0], q[1], q[2]};
}

Eigen::Vector3d read_point(const YamlElement& element) {
  if (element.is_list()) {
    return element.numbers(3);
  }
  element.allow_keys({"x", "y", "z"});
  return {coordinate(element, "x", 0.0), coordinate(element, "y", 0.0),
          coordinate(element, "z", 0.0)};
}

Pose read_pose(const YamlElement& element) {
  element.allow_keys({"position", "orientation"});
  Pose X = Pose::Identity();
  if (const auto orientation = element.find("orientation")) {
    X.linear() = read_rotation(*orientation).toRotationMatrix();
  }
  if (const auto position = element.find("position")) {
    X.translation() = read_point(*position);
  }
  return X;
}

std::map<std::string, double> read_joint_state(const YamlElement& element) {
  std::map<std::string, double> values;
  const std::optional<YamlElement> names = element.find("name");
  if (!names) {
    return values;
  }
  const std::vector<YamlElement> items = names->items();
  const YamlElement list = element.need("position");
  const std::vector<YamlElement> positions = list.items();
  if (items.size() != positions.size()) {
    list.refuse(fmt::format("{} positions", positions.size()),
                fmt::format("{}, one for each name", items.size()));
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    values[items[i].text()] = positions[i].number();
  }
  return values;
}

}  // namespace handway::import_moveit
