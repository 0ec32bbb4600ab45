#include "handway/geometric/setup/placing.h"

#include <cmath>

namespace handway::geometric {

using Eigen::Vector3d;

std::optional<Pose> link_pose(const Scene& scene, const Configuration& q, std::string_view robot,
                              std::string_view link) {
  const RobotInstance* instance = find_robot(scene, robot);
  const auto index = instance ? instance->model->find_link(std::string(link)) : std::nullopt;
  if (!index) {
    return std::nullopt;
  }
  std::vector<Pose> X_BL(static_cast<std::size_t>(instance->model->link_count()));
  const bool is_first = instance == &scene.robots.front();
  instance->model->forward_kinematics(is_first ? q : instance->configuration, X_BL);
  return instance->X_WB * X_BL[static_cast<std::size_t>(*index)];
}

Pose object_pose(const Scene& scene, const Configuration& q, const SceneObject& object) {
  if (!object.attachment) {
    return object.X_PO;
  }
  const auto X_WL = link_pose(scene, q, object.attachment->robot, object.attachment->link);
  return X_WL ? *X_WL * object.X_PO : object.X_PO;
}

Pose in_parent(const Scene& scene, const Configuration& q, const SceneObject& object,
               const Pose& X_WO) {
  if (!object.attachment) {
    return X_WO;
  }
  const auto X_WL = link_pose(scene, q, object.attachment->robot, object.attachment->link);
  return X_WL ? X_WL->inverse() * X_WO : X_WO;
}

namespace {

Aabb box_of(const Scene& scene, const Configuration& q, const SceneObject& object) {
  return bounding_box(transformed(*tessellate(object.shape), object_pose(scene, q, object)));
}

}  // namespace

Aabb bounds(const Scene& scene, const Configuration& q, const std::vector<std::string>& names) {
  Aabb whole{Vector3d::Constant(HUGE_VAL), Vector3d::Constant(-HUGE_VAL)};
  for (const std::string& name : names) {
    if (const SceneObject* object = find_object(scene, name)) {
      const Aabb box = box_of(scene, q, *object);
      whole.lower = whole.lower.cwiseMin(box.lower);
      whole.upper = whole.upper.cwiseMax(box.upper);
    }
  }
  return whole;
}

}  // namespace handway::geometric
