#include "handway/device/glove/guided_poses.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "yaml_text.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace handway::device {
namespace {

using geometric::YamlElement;

PoseInstruction read_pose(const YamlElement& item) {
  item.allow_keys({"name", "instruction", "degrees"});
  PoseInstruction pose;
  pose.name = item.need("name").text();
  pose.instruction = optional_text(item, "instruction");
  pose.angles.fill(std::numeric_limits<double>::quiet_NaN());
  const YamlElement degrees = item.need("degrees");
  for (const auto& [name, angle] : degrees.entries()) {
    const std::optional<int> sensor = find_sensor(name);
    if (!sensor) {
      angle.refuse("no sensor of that name", "a sensor of the glove",
                   geometric::advise_name(name, sensor_names()));
    }
    pose.angles.at(static_cast<std::size_t>(*sensor)) = angle.number() * geometric::kDegree;
  }
  return pose;
}

}  // namespace

std::vector<PoseInstruction> read_guided_poses(const std::filesystem::path& file) {
  const YamlElement top = YamlElement::read(file, "poses to calibrate a glove with");
  top.allow_keys({"poses"});
  std::vector<PoseInstruction> poses;
  for (const YamlElement& item : top.need("poses").items()) {
    poses.push_back(read_pose(item));
    if (std::ranges::count(poses, poses.back().name, &PoseInstruction::name) > 1) {
      item.refuse("pose " + poses.back().name + " for the second time", "every name once");
    }
  }
  if (poses.empty()) {
    top.need("poses").refuse("no poses", "at least one");
  }
  return poses;
}

}  // namespace handway::device
