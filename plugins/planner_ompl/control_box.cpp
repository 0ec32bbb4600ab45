#include "control_box.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "joint_cube.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace handway::planner_ompl {
namespace {

using planning::Configuration;
using sampling::PmdBasis;
using sampling::RandomStream;

// Radii of the balls around start and goal: what is a move of a finger's width
// and what takes the hand out of any grasp.
constexpr double kSmallestBall = 0.005;
constexpr double kLargestBall = 0.3;

// Narrower coordinates are left out.
constexpr double kLeastExtent = 1e-9;

PmdBasis with_directions(PmdBasis basis, int most) {
  if (basis.directions.size() > static_cast<std::size_t>(most)) {
    basis.directions.resize(static_cast<std::size_t>(most));
  }
  return basis;
}

std::vector<int> arm_variables(const planning::PlanningProblem& problem) {
  std::vector<int> arm = joints_with_range(problem.model());
  std::erase_if(arm, [&](int v) { return std::ranges::count(problem.hand, v) > 0; });
  return arm;
}

Eigen::VectorXd joints_of(const planning::PlanningProblem& problem, const Configuration& q,
                          const std::vector<int>& variables) {
  return geometric::normalised(problem.model(), q)(variables).cwiseMax(0.0).cwiseMin(1.0);
}

// Orthonormal; the first column along `direction`, if that has a length.
Eigen::MatrixXd frame_along(const Eigen::VectorXd& direction) {
  if (direction.norm() < kLeastExtent) {
    return Eigen::MatrixXd::Identity(direction.size(), direction.size());
  }
  Eigen::MatrixXd frame = Eigen::HouseholderQR<Eigen::MatrixXd>(direction).householderQ();
  if (frame.col(0).dot(direction) < 0.0) {
    frame.col(0) *= -1.0;
  }
  return frame;
}

}  // namespace

ControlBox::ControlBox(const planning::PlanningProblem& problem, const ControlRegion& region)
    : StateMap(problem),
      region_(region),
      basis_(with_directions(*problem.basis, region.max_pmds)),
      arm_(arm_variables(problem)),
      arm_ends_{joints_of(problem, problem.start, arm_), joints_of(problem, problem.goal, arm_)},
      corridor_(arm_ends_[0], arm_ends_[1]),
      frame_(frame_along(arm_ends_[1] - arm_ends_[0])) {
  set_up_hand();
  set_up_box();
}

void ControlBox::set_up_hand() {
  const int dimension = basis_.dimension();
  centre_ = basis_.mean;
  axes_ = Eigen::MatrixXd::Zero(centre_.size(), dimension + 2);
  half_sides_.resize(dimension);
  int axis = 0;
  for (const sampling::FreeJoint& free : basis_.free_joints) {
    centre_[free.joint] = free.centre;
    axes_(free.joint, axis) = 1.0;
    half_sides_[axis++] = free.half_side;
  }
  for (const sampling::PrincipalDirection& direction : basis_.directions) {
    axes_.col(axis) = direction.vector;
    half_sides_[axis++] = direction.half_side;
  }
  for (const int end : {0, 1}) {
    const auto i = static_cast<std::size_t>(end);
    const Eigen::VectorXd posture =
        joints_of(problem(), end == 0 ? problem().start : problem().goal, problem().hand);
    end_hands_[i] = in_hand_box(posture);
    const Eigen::VectorXd deviation = posture - centre_ - axes_.leftCols(dimension) * end_hands_[i];
    deviations_[i] = deviation.norm();
    if (deviations_[i] > kLeastExtent) {
      axes_.col(dimension + end) = deviation / deviations_[i];
    }
  }
}

// The corridor's cubes are as wide across an axis as its components add up to.
void ControlBox::set_up_box() {
  const Eigen::VectorXd width =
      region_.target.rho_max * frame_.cwiseAbs().colwise().sum().transpose();
  const Eigen::Index arm_size = width.size();
  Eigen::VectorXd lower(arm_size + axes_.cols());
  lower << -width, -half_sides_, 0.0, 0.0;
  Eigen::VectorXd upper(lower.size());
  upper << width, half_sides_, deviations_[0], deviations_[1];
  if (arm_size > 0) {
    upper[0] += corridor_.length();
  }
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (upper[i] - lower[i] > kLeastExtent) {
      kept_.push_back(static_cast<int>(i));
    }
  }
  make_space(lower(kept_), upper(kept_));
}

Eigen::VectorXd ControlBox::in_hand_box(const Eigen::VectorXd& posture) const {
  return sampling::project(basis_, posture).cwiseMax(-half_sides_).cwiseMin(half_sides_);
}

Eigen::VectorXd ControlBox::across(const Eigen::VectorXd& arm_joints) const {
  return frame_.transpose() * (arm_joints - arm_ends_[0]);
}

Eigen::VectorXd ControlBox::end_controls(int end, const Eigen::VectorXd& arm,
                                         const Eigen::VectorXd& e, double deviation) const {
  Eigen::VectorXd all(arm.size() + e.size() + 2);
  all << arm, e, (end == 0 ? deviation : 0.0), (end == 1 ? deviation : 0.0);
  return all(kept_);
}

Eigen::VectorXd ControlBox::coordinates(const Configuration& q) const {
  const Eigen::VectorXd arm = across(joints_of(problem(), q, arm_));
  for (const int end : {0, 1}) {
    const auto i = static_cast<std::size_t>(end);
    if (q == (end == 0 ? problem().start : problem().goal)) {
      return end_controls(end, arm, end_hands_[i], deviations_[i]);
    }
  }
  return end_controls(0, arm, in_hand_box(joints_of(problem(), q, problem().hand)), 0.0);
}

Configuration ControlBox::configuration(const Eigen::VectorXd& x) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(frame_.cols() + axes_.cols());
  all(kept_) = x;
  Eigen::VectorXd joints = geometric::normalised(problem().model(), problem().start);
  joints(arm_) = arm_ends_[0] + frame_ * all.head(frame_.cols());
  joints(problem().hand) = centre_ + axes_ * all.tail(axes_.cols());
  return geometric::denormalised(problem().model(), joints.cwiseMax(0.0).cwiseMin(1.0));
}

Eigen::VectorXd ControlBox::random_hand(RandomStream& stream) const {
  const Eigen::VectorXd u = stream.uniform(static_cast<int>(half_sides_.size()));
  return half_sides_.array() * (2.0 * u.array() - 1.0);
}

// Every size of ball is as likely as any other. In half of the draws around an end the
// hand keeps its posture: it holds on to what is between its fingers.
Eigen::VectorXd ControlBox::draw(RandomStream& stream, std::uint64_t sample) const {
  const planning::TargetRegion& target = region_.target;
  const bool near_end = stream.uniform() < target.near_ends;
  if (!near_end) {
    const double widths = std::floor(static_cast<double>(sample) / target.samples_per_width);
    const double rho = std::min(target.rho_max, target.rho_a * std::pow(target.rho_growth, widths));
    const double step = stream.uniform();
    const Eigen::VectorXd arm = corridor_.sample(step, rho, stream.uniform(corridor_.dimension()));
    return end_controls(0, across(arm), random_hand(stream), 0.0);
  }
  const int end = stream.uniform() < 0.5 ? 0 : 1;
  const double rho = std::min(
      target.rho_max, kSmallestBall * std::pow(kLargestBall / kSmallestBall, stream.uniform()));
  const double moved = stream.uniform() < 0.5 ? std::min(1.0, rho / kLargestBall) : 0.0;
  const Eigen::VectorXd arm = corridor_.sample(end, rho, stream.uniform(corridor_.dimension()));
  const auto i = static_cast<std::size_t>(end);
  const Eigen::VectorXd e = end_hands_[i] + moved * (random_hand(stream) - end_hands_[i]);
  return end_controls(end, across(arm), e, (1.0 - moved) * deviations_[i]);
}

}  // namespace handway::planner_ompl
