#include "handway/geometric/collision/motion_bound.h"

#include <algorithm>
#include <cmath>

namespace handway::geometric {
namespace {

double distance_from_axis(const Eigen::Vector3d& point, const Eigen::Vector3d& axis) {
  return axis.cross(point).norm();
}

// How far `link`'s origin can be from its parent's beyond |X_PJ.translation|.
double slide(const RobotModel& model, int link) {
  if (model.joint(link).type != JointType::kPrismatic) {
    return 0.0;
  }
  // A coupled slide goes where its leader's limits let it, whatever its own say.
  const RobotModel::Drive& drive = model.drive(link);
  return std::max(std::abs(drive.multiplier * model.lower()[drive.variable] + drive.offset),
                  std::abs(drive.multiplier * model.upper()[drive.variable] + drive.offset));
}

// The farthest that a point of `body` can be from the axis of the joint of `link`,
// an ancestor of the body's link (or that link itself).
double reach(const RobotModel& model, const CollisionBody& body, int link) {
  const Eigen::Vector3d& axis = model.joint(link).axis;
  double radius = 0.0;
  for (const Eigen::Vector3d& vertex : body.mesh->vertices) {
    const Eigen::Vector3d p = body.X_FB * vertex;
    radius = std::max(radius, body.link == link ? distance_from_axis(p, axis) : p.norm());
  }
  for (int at = body.link; at != link; at = model.parent(at)) {
    const Eigen::Vector3d& offset = model.joint(at).X_PJ.translation();
    // Next to the axis only the part of the offset across it counts.
    radius += slide(model, at) +
              (model.parent(at) == link ? distance_from_axis(offset, axis) : offset.norm());
  }
  return radius;
}

bool is_above(const RobotModel& model, int ancestor, const CollisionBody& body) {
  int link = body.link;
  while (link > ancestor) {
    link = model.parent(link);
  }
  return link == ancestor;
}

}  // namespace

MotionBound::MotionBound(const CollisionWorld& world) {
  const RobotModel& model = world.model();
  const auto bodies = static_cast<Eigen::Index>(world.bodies().size());
  // Travel of each body's points per unit of each joint above it.
  Eigen::MatrixXd of_link = Eigen::MatrixXd::Zero(model.link_count(), bodies);
  for (int i = 1; i < model.link_count(); ++i) {
    for (int b = 0; b < static_cast<int>(bodies); ++b) {
      if (model.drive(i).variable >= 0 && is_above(model, i, world.body(b))) {
        const bool turns = model.joint(i).type == JointType::kRevolute;
        of_link(i, b) =
            std::abs(model.drive(i).multiplier) * (turns ? reach(model, world.body(b), i) : 1.0);
      }
    }
  }
  reach_ = Eigen::MatrixXd::Zero(model.variable_count(),
                                 static_cast<Eigen::Index>(world.pairs().size()));
  farthest_ = Eigen::VectorXd::Zero(model.variable_count());
  for (int i = 1; i < model.link_count(); ++i) {
    const int variable = model.drive(i).variable;
    if (variable < 0) {
      continue;
    }
    farthest_[variable] += of_link.row(i).maxCoeff();
    for (std::size_t p = 0; p < world.pairs().size(); ++p) {
      const auto [a, b] = world.pairs()[p];
      if (is_above(model, i, world.body(a)) != is_above(model, i, world.body(b))) {
        reach_(variable, static_cast<Eigen::Index>(p)) += of_link(i, a) + of_link(i, b);
      }
    }
  }
}

}  // namespace handway::geometric
