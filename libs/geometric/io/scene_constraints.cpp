#include "io/scene_constraints.h"

#include "handway/geometric/io/nearest_name.h"
#include "handway/geometric/math/units.h"
#include "io/scene_objects.h"

#include <algorithm>

namespace handway::geometric {
namespace {

std::string body_of(const YamlElement& element, const Scene& scene) {
  std::string name = element.text();
  const std::vector<std::string> bodies = constrainable_bodies(scene);
  if (std::ranges::find(bodies, name) == bodies.end()) {
    element.refuse(
        element.found() + (find_object(scene, name) ? ", which no link of the robot carries" : ""),
        "an object on a link of " + scene.robots.front().name + ", or one of its links",
        advise_name(name, bodies));
  }
  return name;
}

Eigen::Vector3d direction_of(const YamlElement& map, const std::string& key) {
  const std::optional<YamlElement> element = map.find(key);
  if (!element) {
    return Eigen::Vector3d::UnitZ();
  }
  const Eigen::Vector3d direction = element->numbers(3);
  if (direction.norm() < 1e-6) {
    element->refuse("the direction 0", "a vector that is not 0");
  }
  return direction;
}

OrientationConstraint orientation_of(const YamlElement& element) {
  element.allow_keys({"axis", "direction", "angle_deg"});
  const YamlElement angle = element.need("angle_deg");
  if (angle.number() <= 0.0 || angle.number() > 180.0) {
    angle.refuse(angle.found(), "an angle above 0 and up to 180 degrees");
  }
  return {direction_of(element, "axis"), direction_of(element, "direction"),
          radians(angle.number())};
}

PositionConstraint position_of(const YamlElement& element) {
  element.allow_keys({"point", "size", "pose"});
  PositionConstraint position;
  if (const std::optional<YamlElement> point = element.find("point")) {
    position.point = point->numbers(3);
  }
  const YamlElement size = element.need("size");
  position.size = size.numbers(3);
  for (const YamlElement& edge : size.items()) {
    if (edge.number() <= 0.0) {
      edge.refuse(edge.found(), "a size above 0 m");
    }
  }
  if (const std::optional<YamlElement> pose = element.find("pose")) {
    position.X_WR = pose_of(*pose);
  }
  return position;
}

}  // namespace

PathConstraint constraint_of(const YamlElement& element, const Scene& scene) {
  element.allow_keys({"name", "body", "upright", "region"});
  PathConstraint constraint;
  const YamlElement name = element.need("name");
  constraint.name = name.text();
  if (constraint.name.empty() ||
      std::ranges::count(scene.constraints, constraint.name, &PathConstraint::name) > 0) {
    name.refuse(name.found() + (constraint.name.empty() ? "" : " a second time"),
                "a name that no other constraint has");
  }
  constraint.body = body_of(element.need("body"), scene);
  const std::optional<YamlElement> upright = element.find("upright");
  const std::optional<YamlElement> region = element.find("region");
  if (upright.has_value() == region.has_value()) {
    element.refuse(upright ? "both upright and region" : "neither upright nor region",
                   "one of upright and region", "Make one constraint for each");
  }
  if (upright) {
    constraint.what = orientation_of(*upright);
  } else {
    constraint.what = position_of(*region);
  }
  return constraint;
}

}  // namespace handway::geometric
