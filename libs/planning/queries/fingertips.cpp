#include "handway/planning/queries/fingertips.h"

#include "handway/geometric/collision/collision_world.h"

#include <algorithm>

namespace handway::planning {

std::vector<int> fingertips(const geometric::RobotModel& model, const std::vector<int>& hand) {
  std::vector<int> tips;
  for (int leaf = 0; leaf < model.link_count(); ++leaf) {
    bool is_leaf = true;
    for (int link = 1; link < model.link_count(); ++link) {
      is_leaf = is_leaf && model.parent(link) != leaf;
    }
    for (int link = leaf; is_leaf && link > 0; link = model.parent(link)) {
      if (std::ranges::count(hand, model.drive(link).variable) > 0) {
        tips.push_back(leaf);
        break;
      }
    }
  }
  return tips;
}

Eigen::Vector3d middle_of(const geometric::Link& link) {
  const geometric::TriangleMesh shape = geometric::collision_mesh(link);
  return shape.vertices.empty() ? Eigen::Vector3d::Zero() : geometric::bounding_box(shape).centre();
}

}  // namespace handway::planning
