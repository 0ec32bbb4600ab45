#include "handway/geometric/robot/numeric_inverse_kinematics.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/jacobian.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

namespace handway::geometric {
namespace {

/// One descent of the numeric inverse kinematics, from a start to where the
/// pose error stops falling. Holds scratch memory: one per thread and call.
class DampedLeastSquares {
 public:
  DampedLeastSquares(const RobotModel& model, int tip_link, const std::vector<int>& variables,
                     const NumericIkOptions& options, const Pose& X_BT);

  /// How a configuration misses the target.
  struct Miss {
    Eigen::Matrix<double, 6, 1> error;  ///< m, weighted rotation in m; base frame.
    double position = 0.0;              ///< m
    double orientation = 0.0;           ///< rad; 0 if it does not count.
    double cost = 0.0;                  ///< Half the error's square, m².
  };

  /// Moves q downhill until it is within the tolerances, at a local minimum, out
  /// of iterations or `expired` says so.
  /// @param[in,out] q of the whole robot, the solved variables within limits.
  /// @param[in,out] iterations is counted up.
  [[nodiscard]] Miss descend(Configuration& q, int& iterations,
                             const std::function<bool()>& expired);

  [[nodiscard]] bool within_tolerance(const Miss& miss) const;

 private:
  [[nodiscard]] Miss miss(const Configuration& q);
  [[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> error_jacobian() const;
  /// Marks the variables that are free to follow the gradient.
  void find_free(const Configuration& q, const Eigen::VectorXd& gradient);
  [[nodiscard]] Eigen::VectorXd step(const Eigen::MatrixXd& normal, const Eigen::VectorXd& gradient,
                                     double damping) const;

  const RobotModel& model_;
  int tip_link_;
  const std::vector<int>& variables_;
  const NumericIkOptions& options_;
  const Pose& X_BT_;
  std::vector<Pose> X_BL_;
  std::vector<Eigen::Index> free_;  ///< Places in variables_.
};

constexpr double kFirstDamping = 1e-3;    // m²/rad²; about 1e-3 of a large arm's squared reach
constexpr double kLeastDamping = 1e-12;   // keeps the equations solvable
constexpr double kLargestDamping = 1e6;   // beyond it no step helps
constexpr double kDampingDown = 0.2;      // after a good step
constexpr double kDampingUp = 5.0;        // after a bad one
constexpr double kLargestStep = 0.8;      // rad or m; linearisation means nothing beyond
constexpr double kLeastGain = 1e-7;       // relative fall of the cost that counts as progress
constexpr int kStepsWithoutProgress = 3;  // before a start is given up

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

[[noreturn]] void refuse_name(const RobotModel& model, const std::string& element,
                              const std::string& found, const std::string& expected) {
  throw InputError({"inverse kinematics of " + model.name(), element, found, expected, ""});
}

int link_named(const RobotModel& model, std::string_view name) {
  const std::optional<int> link = model.find_link(name);
  if (!link) {
    refuse_name(model, "link " + std::string(name), "no link of this name", "a link of the robot");
  }
  return *link;
}

std::vector<int> variables_named(const RobotModel& model, int tip_link,
                                 const std::vector<std::string>& joints) {
  std::vector<int> chain = chain_variables(model, tip_link);
  if (joints.empty()) {
    return chain;
  }
  std::vector<int> variables;
  for (const std::string& joint : joints) {
    const std::optional<int> variable = model.find_variable(joint);
    if (!variable || !std::ranges::binary_search(chain, *variable)) {
      refuse_name(model, "joint " + joint, "nothing that moves " + model.link(tip_link).name,
                  "a joint between the root and the tip link that moves on its own");
    }
    variables.push_back(*variable);
  }
  return variables;
}

void check_options(const RobotModel& model, const NumericIkOptions& options) {
  const auto need = [&](bool holds, const char* option, double value, const char* expected) {
    if (!holds) {
      refuse_name(model, option, fmt::format("{}", value), expected);
    }
  };
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  need(positive(options.position_tolerance), "position_tolerance", options.position_tolerance,
       "a positive length (m)");
  need(positive(options.orientation_tolerance), "orientation_tolerance",
       options.orientation_tolerance, "a positive angle (rad)");
  need(positive(options.orientation_weight), "orientation_weight", options.orientation_weight,
       "a positive number (m/rad)");
  need(options.max_iterations >= 1, "max_iterations", options.max_iterations, "1 or more");
  need(options.max_restarts >= 0, "max_restarts", options.max_restarts, "0 or more");
  need(options.time_limit_s > 0.0, "time_limit_s", options.time_limit_s, "a positive time (s)");
  need(options.X_LT.matrix().allFinite(), "X_LT", NAN, "finite numbers");
}

/// Uniform in [0, 1), the same on every C++ library.
double unit(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1p-53; }

std::string failure(const NumericIkResult& result, const NumericIkOptions& options, bool expired) {
  std::string text = expired ? fmt::format("the time limit of {} s passed", options.time_limit_s)
                             : fmt::format("no posture found from {} starts", result.restarts + 1);
  text += fmt::format("; the nearest misses by {:.3g} mm", millimetres(result.position_residual));
  if (!options.position_only) {
    text += fmt::format(" and {:.3g} degrees", degrees(result.orientation_residual));
  }
  return text;
}

}  // namespace

NumericInverseKinematics::NumericInverseKinematics(const std::shared_ptr<const RobotModel>& model,
                                                   std::string_view tip_link,
                                                   const std::vector<std::string>& joints,
                                                   const NumericIkOptions& options)
    : InverseKinematics(model, link_named(*model, tip_link),
                        variables_named(*model, link_named(*model, tip_link), joints)),
      options_(options) {
  check_options(*model, options_);
}

NumericIkResult NumericInverseKinematics::find(const Pose& X_BT,
                                               const Configuration& reference) const {
  check(X_BT, reference);
  const auto start = std::chrono::steady_clock::now();
  bool late = false;
  const auto expired = [&] {
    if (std::isfinite(options_.time_limit_s) && !late) {
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
      late = spent.count() > options_.time_limit_s;
    }
    return late;
  };
  std::mt19937_64 engine(options_.seed);
  DampedLeastSquares search(model(), tip_link(), variables(), options_, X_BT);
  NumericIkResult result;
  double least_cost = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt <= options_.max_restarts; ++attempt) {
    Configuration q = reference;
    for (const int v : variables()) {
      const double lower = model().lower()[v];
      const double upper = model().upper()[v];
      const JointLimits& limits = model().variable(v).limits;
      q[v] = attempt == 0 ? std::clamp(reference[v], limits.lower, limits.upper)
                          : lower + unit(engine) * (upper - lower);
    }
    const DampedLeastSquares::Miss miss = search.descend(q, result.iterations, expired);
    result.restarts = attempt;
    result.converged = search.within_tolerance(miss);
    if (miss.cost < least_cost || result.converged) {
      least_cost = miss.cost;
      result.q = model().nearest_equivalent(reference, q);
      result.position_residual = miss.position;
      result.orientation_residual = miss.orientation;
    }
    if (result.converged || expired()) {
      break;
    }
  }
  if (!result.converged) {
    result.reason = failure(result, options_, late);
  }
  return result;
}

IkResult NumericInverseKinematics::do_solve(const Pose& X_BT,
                                            const Configuration& reference) const {
  NumericIkResult found = find(X_BT, reference);
  if (!found.converged) {
    return {{}, std::move(found.reason)};
  }
  return {{{found.q(variables()), std::nullopt}}, ""};
}

}  // namespace handway::geometric
