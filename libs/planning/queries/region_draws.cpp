#include "handway/planning/queries/region_draws.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/hand_structure.h"
#include "handway/planning/queries/palm_ik.h"
#include "handway/sampling/postures/quantile.h"
#include "handway/sampling/sequences/random_stream.h"
#include "planners/built_in.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdint>
#include <map>

namespace handway::planning {
namespace {

using geometric::Pose;
using geometric::RobotModel;

constexpr int kMotionPieces = 64;
constexpr int kMostCentres = 65;
constexpr double kMostPalms = 0.9;  // share within RegionDraws::palm_reach

constexpr int kMostCornerDimensions = 7;  // 128 corners; of more dimensions the first are taken

// The box around points along the axes of their spread.
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

std::optional<SamplingRegion> first_region(Planner& planner, int directions) {
  SamplingRegion region;
  region.pmds = directions;
  if (!planner.capabilities().uses_pmds) {
    region.hand = HandSpace::kAllJoints;
  }
  const std::vector<geometric::Parameter> parameters = planner.parameters();
  const geometric::Parameter* rho = parameter_called(parameters, "rho_a");
  if (!rho) {
    return planner.capabilities().uses_pmds ? std::optional(region) : std::nullopt;
  }
  region.rho_a = std::get<double>(rho->value);
  if (const geometric::Parameter* corridor = parameter_called(parameters, "corridor")) {
    region.corridor = static_cast<CorridorForm>(std::get<geometric::Choice>(corridor->value).index);
  }
  if (const geometric::Parameter* pmds = parameter_called(parameters, "max_pmds")) {
    region.pmds = std::min(directions, std::get<int>(pmds->value));
  }
  return region;
}

std::vector<SamplingRegion> first_regions(Planner& planner, int directions) {
  const std::optional<SamplingRegion> first = first_region(planner, directions);
  if (!first) {
    return {};
  }
  std::vector<SamplingRegion> regions{*first};
  if (planner.name() == kAutoPlanner) {
    regions.clear();
    for (const TargetRegion& region : regions_of_auto_planner()) {
      regions.push_back(*first);
      regions.back().corridor = static_cast<CorridorForm>(region.corridor);
      regions.back().rho_a = region.rho_a;
    }
  }
  return regions;
}

RegionDraws draw_region(const PlanningProblem& problem, int palm, const SamplingRegion& region,
                        int configurations, const std::stop_token& stop) {
  if (region.hand == HandSpace::kPrincipalDirections) {
    require_directions(problem, "sampling regions");
  }
  const HandArmRegion hand_arm(problem, region.hand, region.corridor);
  const CorridorSpace& space = hand_arm.space();
  const RobotModel& model = problem.model();
  const Pose& X_WB = problem.scene->robots.front().X_WB;
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  const auto place = [&](int link, const Eigen::Vector3d& p_L) -> Eigen::Vector3d {
    return X_WB * X_BL[static_cast<std::size_t>(link)] * p_L;
  };
  const Eigen::VectorXd middle = Eigen::VectorXd::Constant(space.corridor_dimension(), 0.5);
  const auto on_motion = [&](double step) -> std::optional<Eigen::Vector3d> {
    const std::optional<Configuration> q = hand_arm.arm_at(step, 0.0, middle);
    if (!q) {
      return std::nullopt;
    }
    model.forward_kinematics(*q, X_BL);
    return place(palm, Eigen::Vector3d::Zero());
  };
  const auto along_motion = [&](int parts) {
    std::vector<Eigen::Vector3d> places;
    for (int i = 0; i <= parts; ++i) {
      if (const auto reached = on_motion(static_cast<double>(i) / parts)) {
        places.push_back(*reached);
      }
    }
    return places;
  };

  RegionDraws result;
  const int pieces = space.steps(region.rho_a);
  result.hypercubes = pieces + 1;
  if (result.hypercubes <= kMostCentres) {
    result.centres = along_motion(pieces);
  }
  result.motion = along_motion(kMotionPieces);
  const int free_joints = static_cast<int>(hand_arm.basis().free_joints.size());
  const int axes = region.hand == HandSpace::kAllJoints
                       ? hand_arm.basis().dimension()
                       : std::min(hand_arm.basis().dimension(), free_joints + region.pmds);
  std::map<int, Eigen::Vector3d> tips;  // middles of their shapes, by link
  for (const int link : geometric::fingertips(problem.model(), problem.joints.hand)) {
    tips[link] = middle_of(problem.model().link(link));
  }
  std::vector<double> distances;
  for (int i = 0; i < configurations && !stop.stop_requested(); ++i) {
    sampling::RandomStream draw = sampling::RandomStream(1).fork(static_cast<std::uint64_t>(i));
    const double step = draw.uniform();
    const auto arm = hand_arm.arm_at(step, region.rho_a, draw.uniform(space.corridor_dimension()));
    const auto centre = on_motion(step);
    if (!arm || !centre) {
      continue;
    }
    model.forward_kinematics(hand_arm.with_hand(*arm, draw.uniform(axes)), X_BL);
    result.palms.push_back(place(palm, Eigen::Vector3d::Zero()));
    distances.push_back((result.palms.back() - *centre).norm());
    for (const auto& [link, p_LTip] : tips) {
      result.fingertips.push_back(place(link, p_LTip));
    }
  }
  if (!distances.empty()) {
    result.palm_reach = sampling::quantile_of(std::move(distances), kMostPalms);
  }
  return result;
}

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
