#include "handway/planning/queries/motion_likeness.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/timing/blended_path.h"
#include "handway/planning/timing/kinematic_limits.h"
#include "handway/planning/timing/time_parameterization.h"
#include "handway/sampling/postures/motion_components.h"
#include "handway/sampling/postures/quantile.h"
#include "handway/sampling/postures/recorded_motions.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using geometric::JointIndices;
using geometric::RobotModel;

constexpr double kLikenessPeriod = 0.01;       // s
constexpr double kDerivativeStep = 1e-4;       // s
constexpr Eigen::Index kStraightPoints = 101;  // of the straight motion

Eigen::VectorXd times_of(const Trajectory& trajectory) {
  Eigen::VectorXd times(std::ssize(trajectory.points));
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    times[i] = trajectory.points[static_cast<std::size_t>(i)].time;
  }
  return times;
}

// Normalised joints, shape [points, joints].
Eigen::MatrixXd normalised_rows(const RobotModel& model, const Trajectory& trajectory,
                                const JointIndices& joints) {
  Eigen::MatrixXd rows(std::ssize(trajectory.points), std::ssize(joints));
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const TrajectoryPoint& point = trajectory.points[static_cast<std::size_t>(i)];
    rows.row(i) = geometric::normalised(model, point.position)(joints).transpose();
  }
  return rows;
}

template <typename SpeedAt>
std::optional<MovementSmoothness> smoothness_of(const Trajectory& trajectory,
                                                const SpeedAt& speed_at) {
  if (trajectory.points.size() < 2) {
    return std::nullopt;
  }
  SpeedProfile profile{trajectory.points[1].time - trajectory.points[0].time,
                       Eigen::VectorXd(std::ssize(trajectory.points))};
  std::ranges::transform(trajectory.points, profile.speed.begin(), speed_at);
  return movement_smoothness(profile);
}

std::optional<MovementSmoothness> hand_smoothness(const PlanningProblem& problem,
                                                  const Trajectory& trajectory) {
  const Eigen::VectorXd range = problem.model().upper() - problem.model().lower();
  const JointIndices& hand = problem.joints.hand;
  return smoothness_of(trajectory, [&](const TrajectoryPoint& point) {
    double squares = 0.0;
    for (const int joint : hand) {
      squares += range[joint] > 0.0 ? std::pow(point.velocity[joint] / range[joint], 2) : 0.0;
    }
    return std::sqrt(squares);
  });
}

/// Positions of the palm in the robot's base frame.
class PalmPositions {
 public:
  PalmPositions(const RobotModel& model, int palm)
      : model_(model), palm_(palm), X_BL_(static_cast<std::size_t>(model.link_count())) {}

  Eigen::Vector3d at(const Configuration& q) {
    model_.forward_kinematics(q, X_BL_);
    return X_BL_[static_cast<std::size_t>(palm_)].translation();
  }

  double speed(const TrajectoryPoint& point) {
    const Configuration step = kDerivativeStep * point.velocity;
    return (at(point.position + step) - at(point.position - step)).norm() / (2.0 * kDerivativeStep);
  }

 private:
  const RobotModel& model_;
  int palm_;
  std::vector<geometric::Pose> X_BL_;
};

template <typename Vector>
double distance_to_segment(const Vector& point, const Vector& from, const Vector& to) {
  const Vector along = to - from;
  const double squared = along.squaredNorm();
  const double share =
      squared > 0.0 ? std::clamp((point - from).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - from - share * along).norm();
}

double arm_deviation(const PlanningProblem& problem, const Trajectory& trajectory) {
  const Eigen::MatrixXd rows = normalised_rows(problem.model(), trajectory, problem.joints.arm);
  const Eigen::VectorXd from = rows.row(0).transpose();
  const Eigen::VectorXd to = rows.row(rows.rows() - 1).transpose();
  double largest = 0.0;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Eigen::VectorXd here = rows.row(i).transpose();
    largest = std::max(largest, distance_to_segment(here, from, to));
  }
  return largest;
}

double palm_deviation(const Trajectory& trajectory, PalmPositions palm) {
  const Configuration& from = trajectory.points.front().position;
  const Configuration& to = trajectory.points.back().position;
  std::vector<Eigen::Vector3d> straight;
  for (Eigen::Index i = 0; i < kStraightPoints; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kStraightPoints - 1);
    straight.push_back(palm.at(from + share * (to - from)));
  }
  double largest = 0.0;
  for (const TrajectoryPoint& point : trajectory.points) {
    const Eigen::Vector3d here = palm.at(point.position);
    double nearest = (here - straight.front()).norm();
    for (std::size_t i = 1; i < straight.size(); ++i) {
      nearest = std::min(nearest, distance_to_segment(here, straight[i - 1], straight[i]));
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

// RMS over the joints of errors in normalised joints, in rad.
double joint_rms(const Eigen::VectorXd& errors, const Eigen::VectorXd& ranges) {
  return errors.cwiseProduct(ranges).norm() / std::sqrt(static_cast<double>(errors.size()));
}

ComponentError component_error(const sampling::MotionComponents& components,
                               const sampling::HandMotion& motion,
                               const Eigen::VectorXd& hand_ranges) {
  constexpr double kUsual = 0.95;
  const Eigen::VectorXd ranges = hand_ranges(components.joints());
  std::vector<double> recorded;
  for (const auto& errors : components.held_out_errors().rowwise()) {
    recorded.push_back(joint_rms(errors.transpose(), ranges));
  }
  return {joint_rms(components.errors(motion.joints), ranges), sampling::quantile_of(recorded, 0.5),
          sampling::quantile_of(recorded, kUsual), components.motions(),
          static_cast<std::size_t>(components.count())};
}

void compare_with_recorded(const PlanningProblem& problem, const Trajectory& trajectory,
                           const sampling::RecordedPostures* recorded, MotionLikeness& likeness) {
  if (recorded == nullptr) {
    likeness.no_components = "There are no recorded postures of the hand.";
    return;
  }
  if (recorded->motions() == nullptr) {
    likeness.no_components = recorded->motions_fault();
    return;
  }
  const JointIndices& hand = problem.joints.hand;
  const sampling::HandJointIndices& counting = recorded->motions()->joints();
  // Joints that don't count don't tell when a motion begins, either.
  Eigen::MatrixXd rows = normalised_rows(problem.model(), trajectory, hand);
  for (int joint = 0; joint < rows.cols(); ++joint) {
    if (std::ranges::count(counting, joint) == 0) {
      rows.col(joint).setZero();
    }
  }
  const std::optional<sampling::HandMotion> motion =
      sampling::whole_motion(times_of(trajectory), rows);
  if (!motion) {
    likeness.no_components = "The hand does not move.";
    return;
  }
  const Eigen::VectorXd ranges = problem.model().upper() - problem.model().lower();
  likeness.components = component_error(*recorded->motions(), *motion, ranges(hand));
}

}  // namespace

std::variant<Trajectory, std::string> likeness_trajectory(const PlanningProblem& problem,
                                                          const Path& path,
                                                          const std::stop_token& stop) {
  BlendOptions options;
  options.shape = ArcShape::kSmooth;
  options.stop = stop;
  const BlendResult blends = certified_blends(problem, path, options);
  if (!blends.path) {
    return blends.fault;
  }
  const TimeParameterization law =
      align_stops(jerk_limited(*blends.path, rate_limits(problem.model()), stop), kLikenessPeriod);
  return sample(*blends.path, law, kLikenessPeriod);
}

MotionLikeness motion_likeness(const PlanningProblem& problem, const Trajectory& trajectory,
                               const sampling::RecordedPostures* recorded) {
  MotionLikeness likeness;
  if (trajectory.empty()) {
    likeness.no_components = "There is no motion.";
    return likeness;
  }
  likeness.duration = trajectory.duration();
  likeness.hand = hand_smoothness(problem, trajectory);
  if (!problem.joints.arm.empty() && problem.hand.palm >= 0) {
    PalmPositions palm(problem.model(), problem.hand.palm);
    likeness.palm =
        smoothness_of(trajectory, [&](const TrajectoryPoint& point) { return palm.speed(point); });
    likeness.deviation = {arm_deviation(problem, trajectory), palm_deviation(trajectory, palm)};
  }
  compare_with_recorded(problem, trajectory, recorded, likeness);
  return likeness;
}

Eigen::MatrixXd comparable_motion(const PlanningProblem& problem, const Trajectory& trajectory) {
  return sampling::time_normalised(
      times_of(trajectory), normalised_rows(problem.model(), trajectory, problem.planned_joints()),
      sampling::kMotionPoints);
}

}  // namespace handway::planning
