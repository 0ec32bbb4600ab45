#include "robot/damped_least_squares.h"

#include "handway/geometric/robot/jacobian.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace handway::geometric {
namespace {

constexpr double kFirstDamping = 1e-3;    // m²/rad²; about 1e-3 of a large arm's squared reach
constexpr double kLeastDamping = 1e-12;   // keeps the equations solvable
constexpr double kLargestDamping = 1e6;   // beyond it no step helps
constexpr double kDampingDown = 0.2;      // after a good step
constexpr double kDampingUp = 5.0;        // after a bad one
constexpr double kLargestStep = 0.8;      // rad or m; linearisation means nothing beyond
constexpr double kLeastGain = 1e-7;       // relative fall of the cost that counts as progress
constexpr int kStepsWithoutProgress = 3;  // before a start is given up

}  // namespace

DampedLeastSquares::DampedLeastSquares(const RobotModel& model, int tip_link,
                                       const std::vector<int>& variables,
                                       const NumericIkOptions& options, const Pose& X_BT)
    : model_(model),
      tip_link_(tip_link),
      variables_(variables),
      options_(options),
      X_BT_(X_BT),
      X_BL_(static_cast<std::size_t>(model.link_count())) {}

DampedLeastSquares::Miss DampedLeastSquares::descend(Configuration& q, int& iterations,
                                                     const std::function<bool()>& expired) {
  Miss here = miss(q);
  double damping = kFirstDamping;
  int without_progress = 0;
  for (int i = 0; i < options_.max_iterations && !within_tolerance(here) && !expired(); ++i) {
    ++iterations;
    const auto J = error_jacobian();
    const Eigen::VectorXd gradient = J.transpose() * here.error;
    const Eigen::MatrixXd normal = J.transpose() * J;
    find_free(q, gradient);
    if (free_.empty()) {
      break;
    }
    const Configuration before = q;
    Miss there;
    for (;; damping *= kDampingUp) {
      const Eigen::VectorXd delta = step(normal, gradient, damping);
      for (std::size_t k = 0; k < variables_.size(); ++k) {
        const int v = variables_[k];
        const JointLimits& limits = model_.variable(v).limits;
        q[v] =
            std::clamp(before[v] + delta[static_cast<Eigen::Index>(k)], limits.lower, limits.upper);
      }
      there = miss(q);
      if (there.cost < here.cost || damping > kLargestDamping) {
        break;
      }
    }
    if (!(there.cost < here.cost)) {
      q = before;
      break;
    }
    const bool progress = here.cost - there.cost > kLeastGain * here.cost;
    without_progress = progress ? 0 : without_progress + 1;
    here = there;
    damping = std::max(damping * kDampingDown, kLeastDamping);
    if (without_progress >= kStepsWithoutProgress) {
      break;
    }
  }
  return here;
}

bool DampedLeastSquares::within_tolerance(const Miss& miss) const {
  return miss.position <= options_.position_tolerance &&
         miss.orientation <= options_.orientation_tolerance;
}

DampedLeastSquares::Miss DampedLeastSquares::miss(const Configuration& q) {
  model_.forward_kinematics(q, X_BL_);
  const Pose X = X_BL_[static_cast<std::size_t>(tip_link_)] * options_.X_LT;
  Miss result;
  result.error.head<3>() = X_BT_.translation() - X.translation();
  result.position = result.error.head<3>().norm();
  result.error.tail<3>().setZero();
  if (!options_.position_only) {
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_BT_.linear() * X.linear().transpose()));
    result.orientation = std::abs(turn.angle());
    result.error.tail<3>() = options_.orientation_weight * turn.angle() * turn.axis();
  }
  result.cost = 0.5 * result.error.squaredNorm();
  return result;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> DampedLeastSquares::error_jacobian() const {
  const Jacobian full = point_jacobian(model_, X_BL_, tip_link_, options_.X_LT.translation());
  Eigen::Matrix<double, 6, Eigen::Dynamic> J = full(Eigen::all, variables_);
  J.bottomRows<3>() *= options_.position_only ? 0.0 : options_.orientation_weight;
  return J;
}

void DampedLeastSquares::find_free(const Configuration& q, const Eigen::VectorXd& gradient) {
  free_.clear();
  for (std::size_t k = 0; k < variables_.size(); ++k) {
    const int v = variables_[k];
    const double pull = gradient[static_cast<Eigen::Index>(k)];
    const JointLimits& limits = model_.variable(v).limits;
    const bool held = (pull < 0.0 && q[v] <= limits.lower) || (pull > 0.0 && q[v] >= limits.upper);
    if (!held) {
      free_.push_back(static_cast<Eigen::Index>(k));
    }
  }
}

Eigen::VectorXd DampedLeastSquares::step(const Eigen::MatrixXd& normal,
                                         const Eigen::VectorXd& gradient, double damping) const {
  Eigen::MatrixXd damped = normal(free_, free_);
  damped.diagonal().array() += damping;
  Eigen::VectorXd delta = Eigen::VectorXd::Zero(gradient.size());
  delta(free_) = damped.ldlt().solve(Eigen::VectorXd(gradient(free_))).eval();
  const double largest = delta.cwiseAbs().maxCoeff();
  return largest > kLargestStep ? Eigen::VectorXd(delta * (kLargestStep / largest)) : delta;
}

}  // namespace handway::geometric
