#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/spaces/state_space.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <vector>

namespace handway::planning {
namespace {

// Shorter vectors have no direction.
constexpr double kLeastExtent = 1e-9;

sampling::PmdBasis with_directions(sampling::PmdBasis basis, int most) {
  basis.directions.resize(std::min(basis.directions.size(), static_cast<std::size_t>(most)));
  return basis;
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

class ControlSpace final : public StateSpace {
 public:
  ControlSpace(const PlanningProblem& problem, const sampling::PmdBasis& basis, double half_width)
      : StateSpace(problem),
        arm_start_(joints_of(problem.start, arm())),
        frame_(frame_along(joints_of(problem.goal, arm()) - arm_start_)),
        centre_(sampling::centre_of(basis)),
        axes_(centre_.size(), basis.dimension() + 2) {
    // Size of the corridor's cubes across an axis: the sum of its components.
    const Eigen::VectorXd width = half_width * frame_.cwiseAbs().colwise().sum().transpose();
    const Eigen::VectorXd half_sides = sampling::half_sides_of(basis);
    axes_ << sampling::axes_of(basis), Eigen::MatrixXd::Zero(centre_.size(), 2);
    const Eigen::Vector2d deviations(add_deviation(basis, half_sides, 0),
                                     add_deviation(basis, half_sides, 1));
    Eigen::VectorXd lower(frame_.cols() + axes_.cols());
    lower << -width, -half_sides, 0.0, 0.0;
    Eigen::VectorXd upper(lower.size());
    upper << width, half_sides, deviations;
    if (frame_.cols() > 0) {
      upper[0] += (joints_of(problem.goal, arm()) - arm_start_).norm();
    }
    set_bounds(lower, upper);
  }

  [[nodiscard]] Eigen::VectorXd coordinates(const Configuration& q) const override {
    Eigen::VectorXd x(frame_.cols() + axes_.cols());
    x << frame_.transpose() * (joints_of(q, arm()) - arm_start_),
        hand_coordinates(joints_of(q, problem().joints.hand));
    return x.cwiseMax(lower()).cwiseMin(upper());
  }

  [[nodiscard]] std::optional<Configuration> configuration(
      const Eigen::VectorXd& x, const Configuration& reference) const override {
    Eigen::VectorXd joints = geometric::normalised(problem().model(), reference);
    joints(arm()) = arm_start_ + frame_ * x.head(frame_.cols());
    joints(problem().joints.hand) = centre_ + axes_ * x.tail(axes_.cols());
    return geometric::denormalised(problem().model(),
                                   geometric::clamped_to_range(problem().model(), joints));
  }

 private:
  [[nodiscard]] Eigen::VectorXd joints_of(const Configuration& q,
                                          const std::vector<int>& variables) const {
    const geometric::RobotModel& model = problem().model();
    return geometric::clamped_to_range(model, geometric::normalised(model, q))(variables);
  }

  // Coordinates of the nearest posture, within the box: the axes may be dependent, as when the
  // ends deviate in the same direction. One axis after the other is set to its best value for the
  // rest.
  [[nodiscard]] Eigen::VectorXd hand_coordinates(const Eigen::VectorXd& posture) const {
    constexpr int kMostSweeps = 100;
    constexpr double kStill = 1e-14;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(axes_.cols());
    Eigen::VectorXd rest = posture - centre_;
    double moved = 1.0;
    for (int sweep = 0; sweep < kMostSweeps && moved > kStill; ++sweep) {
      moved = 0.0;
      for (Eigen::Index axis = 0; axis < axes_.cols(); ++axis) {
        const Eigen::Index i = frame_.cols() + axis;
        const double length = axes_.col(axis).squaredNorm();
        const double best = x[axis] + (length > 0.0 ? axes_.col(axis).dot(rest) / length : 0.0);
        const double step = std::clamp(best, lower()[i], upper()[i]) - x[axis];
        x[axis] += step;
        rest -= step * axes_.col(axis);
        moved = std::max(moved, std::abs(step));
      }
    }
    return x;
  }

  // Length of the vector from the nearest posture in the box to the posture at an end (0: start, 1:
  // goal).
  double add_deviation(const sampling::PmdBasis& basis, const Eigen::VectorXd& half_sides,
                       int end) {
    const Eigen::VectorXd posture =
        joints_of(end == 0 ? problem().start : problem().goal, problem().joints.hand);
    const Eigen::VectorXd nearest =
        sampling::project(basis, posture).cwiseMax(-half_sides).cwiseMin(half_sides);
    const Eigen::VectorXd deviation =
        posture - centre_ - axes_.leftCols(half_sides.size()) * nearest;
    const double length = deviation.norm();
    if (length <= kLeastExtent) {
      return 0.0;
    }
    axes_.col(half_sides.size() + end) = deviation / length;
    return length;
  }

  Eigen::VectorXd arm_start_;  ///< Normalised joints.
  Eigen::MatrixXd frame_;      ///< Columns: the corridor's direction, then others across it.
  Eigen::VectorXd centre_;
  Eigen::MatrixXd axes_;  ///< Columns: those of the subspace, then the deviations at the ends.
};

}  // namespace

std::unique_ptr<StateSpace> make_control_space(const PlanningProblem& problem, int most_pmds,
                                               double half_width) {
  return std::make_unique<ControlSpace>(
      problem, with_directions(hand_basis(problem, HandSpace::kPrincipalDirections), most_pmds),
      half_width);
}

}  // namespace handway::planning
