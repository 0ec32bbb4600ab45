#include "handway/device/glove/guided_poses.h"

#include "glove/sensor_names.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/math/units.h"

#include <algorithm>
#include <limits>

namespace handway::device {
namespace {

using geometric::YamlElement;

PoseInstruction read_pose(const YamlElement& item) {
  item.allow_keys({"name", "instruction", "degrees", "motion"});
  PoseInstruction pose;
  pose.name = item.need("name").text();
  pose.instruction = item.text_or("instruction", "");
  pose.angles.fill(std::numeric_limits<double>::quiet_NaN());
  if (const auto motion = item.find("motion")) {
    pose.motion = motion->number();
    if (!(pose.motion > 0.0)) {
      motion->refuse(motion->found(), "seconds above 0");
    }
  }
  const YamlElement degrees = item.need("degrees");
  for (const auto& [name, angle] : degrees.entries()) {
    pose.angles.at(static_cast<std::size_t>(named_sensor(angle, name))) =
        angle.number() * geometric::kDegree;
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
