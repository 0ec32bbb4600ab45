#include "handway/planning/queries/palm_boxes.h"

#include "handway/planning/spaces/hand_arm_region.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace handway::planning {
namespace {

constexpr int kMostCornerDimensions = 7;  // 128 corners; of more dimensions the first are taken

// The box around points whose axes are those of their spread.
PalmBox box_around(const Eigen::Matrix3Xd& points, double step) {
  const Eigen::Vector3d mean = points.rowwise().mean();
  const Eigen::Matrix3Xd centred = points.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(centred * centred.transpose());
  Eigen::Matrix3d axes = spread.eigenvectors();
  if (axes.determinant() < 0.0) {
    axes.col(0) = -axes.col(0);
  }
  const Eigen::Matrix3Xd inside = axes.transpose() * points;
  const Eigen::Vector3d least = inside.rowwise().minCoeff();
  const Eigen::Vector3d most = inside.rowwise().maxCoeff();
  PalmBox box;
  box.X_WC = geometric::Pose::Identity();
  box.X_WC.linear() = axes;
  box.X_WC.translation() = axes * (0.5 * (least + most));
  box.half_size = 0.5 * (most - least);
  box.step = step;
  return box;
}

// A hypercube's middle and corners in [0, 1]^dimension, one a column.
Eigen::MatrixXd middle_and_corners(int dimension) {
  const int varied = std::min(dimension, kMostCornerDimensions);
  const Eigen::Index corners = Eigen::Index{1} << varied;
  Eigen::MatrixXd places = Eigen::MatrixXd::Constant(dimension, corners + 1, 0.5);
  for (Eigen::Index corner = 0; corner < corners; ++corner) {
    for (int axis = 0; axis < varied; ++axis) {
      places(axis, corner + 1) = static_cast<double>((corner >> axis) & 1);
    }
  }
  return places;
}

}  // namespace

std::vector<PalmBox> palm_boxes(const PlanningProblem& problem, int palm,
                                const SamplingRegion& region, int most,
                                const std::stop_token& stop) {
  // Only the arm moves the palm: the hand's axes don't matter.
  const HandArmRegion hand_arm(problem, HandSpace::kAllJoints, region.corridor);
  const CorridorSpace& space = hand_arm.space();
  const geometric::RobotModel& model = problem.model();
  const geometric::Pose& X_WB = problem.scene->robots.front().X_WB;
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  const Eigen::MatrixXd places = middle_and_corners(space.corridor_dimension());
  const int pieces = space.steps(region.rho_a);
  const int stride = std::max(1, (pieces + most) / std::max(1, most));
  std::vector<PalmBox> boxes;
  for (int i = 0; i <= pieces && !stop.stop_requested(); i += stride) {
    const double step = static_cast<double>(i) / pieces;
    Eigen::Matrix3Xd points(3, places.cols());
    Eigen::Index count = 0;
    for (const auto& place : places.colwise()) {
      if (const auto q = hand_arm.arm_at(step, region.rho_a, place)) {
        model.forward_kinematics(*q, X_BL);
        points.col(count++) = X_WB * X_BL[static_cast<std::size_t>(palm)].translation();
      }
    }
    if (count > 1) {
      boxes.push_back(box_around(points.leftCols(count), step));
    }
  }
  return boxes;
}

}  // namespace handway::planning
