#include "view3d/scene_extent.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handway::gui {
namespace {

using geometric::Aabb;
using geometric::Configuration;
using geometric::Pose;
using Points = std::vector<Eigen::Vector3d>;

constexpr double kAround = 0.12;  // m

void add_corners(Points& points, const Aabb& box, const Pose& X) {
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p((corner & 1) ? box.upper.x() : box.lower.x(),
                            (corner & 2) ? box.upper.y() : box.lower.y(),
                            (corner & 4) ? box.upper.z() : box.lower.z());
    points.push_back(X * p);
  }
}

void add_shape(Points& points, const geometric::Shape& shape, const Pose& X) {
  const auto mesh = geometric::tessellate(shape);
  if (mesh && !mesh->vertices.empty()) {
    add_corners(points, geometric::bounding_box(*mesh), X);
  }
}

std::vector<Pose> link_poses(const geometric::RobotInstance& robot, const Configuration& q) {
  std::vector<Pose> X_WL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(q, X_WL);
  for (Pose& X : X_WL) {
    X = robot.X_WB * X;
  }
  return X_WL;
}

void add_robot(Points& points, const geometric::RobotInstance& robot, const Configuration& q) {
  const std::vector<Pose> X_WL = link_poses(robot, q);
  for (int i = 0; i < robot.model->link_count(); ++i) {
    const geometric::Link& link = robot.model->link(i);
    for (const auto& geometry : link.visual.empty() ? link.collision : link.visual) {
      add_shape(points, geometry.shape, X_WL[static_cast<std::size_t>(i)] * geometry.X_LG);
    }
  }
}

Aabb box_around(const Points& points) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Aabb box{Eigen::Vector3d::Constant(kFar), Eigen::Vector3d::Constant(-kFar)};
  for (const Eigen::Vector3d& point : points) {
    box.lower = box.lower.cwiseMin(point);
    box.upper = box.upper.cwiseMax(point);
  }
  return box;
}

Points robot_points(const geometric::Scene& scene) {
  Points points;
  for (const geometric::RobotInstance& robot : scene.robots) {
    add_robot(points, robot, robot.configuration);
  }
  for (const auto& q : {scene.start, scene.goal}) {
    if (q && !scene.robots.empty()) {
      add_robot(points, scene.robots.front(), *q);
    }
  }
  return points;
}

}  // namespace

Points points_of_interest(const geometric::Scene& scene) {
  Points points = robot_points(scene);
  const bool has_robot = !points.empty();
  Aabb near = box_around(points);
  near.lower.array() -= kAround;
  near.upper.array() += kAround;
  for (const geometric::SceneObject& object : scene.objects) {
    Points corners;
    if (!object.attachment) {
      add_shape(corners, object.shape, object.X_PO);
    }
    if (has_robot && !corners.empty()) {
      const Aabb box = box_around(corners);
      const Aabb part{box.lower.cwiseMax(near.lower), box.upper.cwiseMin(near.upper)};
      corners.clear();
      if ((part.lower.array() <= part.upper.array()).all()) {
        add_corners(corners, part, Pose::Identity());
      }
    }
    points.insert(points.end(), corners.begin(), corners.end());
  }
  return points;
}

double lowest_point(const geometric::Scene& scene) {
  Points points = robot_points(scene);
  for (const geometric::SceneObject& object : scene.objects) {
    if (!object.attachment) {
      add_shape(points, object.shape, object.X_PO);
    }
  }
  return points.empty() ? 0.0 : box_around(points).lower.z();
}

double task_azimuth(const geometric::Scene& scene) {
  if (scene.robots.empty()) {
    return 0.0;
  }
  const geometric::RobotInstance& robot = scene.robots.front();
  const std::vector<Pose> X_WL = link_poses(robot, scene.goal.value_or(robot.configuration));
  const Eigen::Vector3d reach = X_WL.back().translation() - robot.X_WB.translation();
  return reach.head<2>().norm() > 0.05 ? std::atan2(reach.y(), reach.x()) : 0.0;
}

}  // namespace handway::gui
