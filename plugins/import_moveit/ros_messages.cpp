#include "ros_messages.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <optional>

namespace handway::import_moveit {
namespace {

using geometric::Pose;
using geometric::YamlElement;

constexpr double kUnitTolerance = 0.01;
constexpr double kSmallest = 1e-6;  // norm of a quaternion

Remarks*& innermost() {
  thread_local Remarks* remarks = nullptr;
  return remarks;
}

}  // namespace

Remarks::Remarks() : outer_(std::exchange(innermost(), this)) {}

Remarks::~Remarks() { innermost() = outer_; }

std::vector<std::string> Remarks::warnings() const {
  std::vector<std::string> warnings;
  for (const auto& [kind, place] : kinds_) {
    const auto& [where, count] = place;
    warnings.push_back(count == 1 ? fmt::format("{}: {}", where, kind)
                                  : fmt::format("{} and {} more: {}", where, count - 1, kind));
  }
  return warnings;
}

void remark(const std::string& kind, const std::string& where) {
  if (innermost() != nullptr) {
    ++innermost()->kinds_.try_emplace(kind, where, 0).first->second.second;
  }
}

Eigen::Quaterniond read_rotation(const YamlElement& element) {
  Eigen::Vector4d q;  // x, y, z, w
  if (element.is_list()) {
    q = element.numbers(4);
  } else {
    element.allow_keys({"x", "y", "z", "w"});
    q = {element.number_or("x", 0.0), element.number_or("y", 0.0), element.number_or("z", 0.0),
         element.number_or("w", 0.0)};
  }
  if (q.norm() < kSmallest) {
    remark("orientations of zeros, which were never filled in, are taken for the identity",
           element.where());
    return Eigen::Quaterniond::Identity();
  }
  if (std::abs(q.norm() - 1.0) > kUnitTolerance) {
    remark("quaternions of another length than 1 are normalised", element.where());
  }
  q.normalize();
  return {q[3], q[0], q[1], q[2]};
}

Eigen::Vector3d read_point(const YamlElement& element) {
  if (element.is_list()) {
    return element.numbers(3);
  }
  element.allow_keys({"x", "y", "z"});
  return {element.number_or("x", 0.0), element.number_or("y", 0.0), element.number_or("z", 0.0)};
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

Pose read_transform(const YamlElement& element) {
  Pose X = Pose::Identity();
  if (const auto rotation = element.find("rotation")) {
    X.linear() = read_rotation(*rotation).toRotationMatrix();
  }
  if (const auto translation = element.find("translation")) {
    X.translation() = read_point(*translation);
  }
  return X;
}

std::map<std::string, Pose> read_multi_dof_joint_state(const YamlElement& element) {
  std::map<std::string, Pose> poses;
  const std::optional<YamlElement> names = element.find("joint_names");
  if (!names) {
    return poses;
  }
  const std::vector<YamlElement> items = names->items();
  const YamlElement list = element.need("transforms");
  const std::vector<YamlElement> transforms = list.items();
  if (items.size() != transforms.size()) {
    list.refuse(fmt::format("{} transforms", transforms.size()),
                fmt::format("{}, one for each name", items.size()));
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    poses[items[i].text()] = read_transform(transforms[i]);
  }
  return poses;
}

}  // namespace handway::import_moveit
