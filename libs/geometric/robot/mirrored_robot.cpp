#include "handway/geometric/robot/robot_description.h"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

const Eigen::Vector3d kMirror(1.0, -1.0, 1.0);

/// The frame's mirror image, with its y axis reversed so that it is right-handed again.
Pose mirrored(const Pose& X) {
  Pose result = Pose::Identity();
  result.linear() = kMirror.asDiagonal() * X.linear() * kMirror.asDiagonal();
  result.translation() = kMirror.cwiseProduct(X.translation());
  return result;
}

// Boxes and round shapes are their own mirror images in their frames.
void mirror(LinkGeometry& geometry) {
  geometry.X_LG = mirrored(geometry.X_LG);
  if (auto* mesh = std::get_if<Mesh>(&geometry.shape)) {
    mesh->scale = kMirror.cwiseProduct(mesh->scale);
    mesh->triangles = std::make_shared<const TriangleMesh>(
        transformed(*mesh->triangles, Pose::Identity(), kMirror));
  }
}

std::string mirrored_name(const std::string& name) {
  constexpr std::array<std::pair<const char*, const char*>, 6> kSides{{{"right", "left"},
                                                                       {"left", "right"},
                                                                       {"Right", "Left"},
                                                                       {"Left", "Right"},
                                                                       {"RIGHT", "LEFT"},
                                                                       {"LEFT", "RIGHT"}}};
  for (const auto& [side, other] : kSides) {
    if (const std::size_t at = name.find(side); at != std::string::npos) {
      return std::string(name).replace(at, std::string(side).size(), other);
    }
  }
  return name + "_mirrored";
}

}  // namespace

RobotDescription mirrored(RobotDescription robot) {
  robot.name = mirrored_name(robot.name);
  for (Link& link : robot.links) {
    for (std::vector<LinkGeometry>* shapes : {&link.visual, &link.collision}) {
      for (LinkGeometry& geometry : *shapes) {
        mirror(geometry);
      }
    }
  }
  for (Joint& joint : robot.joints) {
    joint.X_PJ = mirrored(joint.X_PJ);
    // The mirror image of a rotation has the reverse direction.
    const double sense = joint.type == JointType::kRevolute ? -1.0 : 1.0;
    joint.axis = sense * kMirror.cwiseProduct(joint.axis);
  }
  return robot;
}

}  // namespace handway::geometric
