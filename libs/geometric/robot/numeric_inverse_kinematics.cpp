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
#include <numbers>
#include <optional>
#include <random>
#include <utility>

namespace handway::geometric {
namespace {

/// One descent of the numeric inverse kinematics, from a start until the pose error stops falling.
/// Holds scratch memory: one per thread and call.
class DampedLeastSquares {
 public:
  DampedLeastSquares(const RobotModel& model, int tip_link, const JointIndices& variables,
                     const NumericIkOptions& options, const Pose& X_BT);

  /// Errors of a configuration against the target.
  struct Miss {
    Eigen::Matrix<double, 6, 1> error;  ///< m, weighted rotation in m; target's frame.
    double position = 0.0;              ///< m, beyond the slack.
    double orientation = 0.0;           ///< rad, beyond the slack; 0 if it does not count.
    double cost = 0.0;                  ///< Half the error's square, m².
  };

  /// Moves q downhill until it is within the tolerances, at a local minimum, out of iterations or
  /// `expired` returns true.
  /// @param[in,out] q of the whole robot, the solved variables within limits.
  /// @param[in,out] iterations is counted up.
  [[nodiscard]] Miss descend(Configuration& q, int& iterations,
                             const std::function<bool()>& expired);

  /// Moves a solution through the null space to the point nearest to the reference.
  /// @param[in,out] q within the tolerances, before and after. @param[in,out] miss of q.
  void draw_near(const Configuration& reference, Configuration& q, Miss& miss, int& iterations,
                 const std::function<bool()>& expired);

  [[nodiscard]] bool within_tolerance(const Miss& miss) const;

 private:
  [[nodiscard]] Miss miss(const Configuration& q);
  /// Jacobian of the error in the configuration of the last miss(). @param error its error:
  /// components within the slack are free to move.
  [[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> error_jacobian(
      const Eigen::Matrix<double, 6, 1>& error) const;
  /// Marks the variables that are free to follow the gradient.
  void find_free(const Configuration& q, const Eigen::VectorXd& gradient);
  [[nodiscard]] Eigen::VectorXd step(const Eigen::MatrixXd& normal, const Eigen::VectorXd& gradient,
                                     double damping) const;
  /// `q` moved by `delta`, shape [variables], within limits.
  [[nodiscard]] Configuration moved(const Configuration& q, const Eigen::VectorXd& delta) const;
  [[nodiscard]] double distance(const Configuration& a, const Configuration& b) const {
    return (a - b)(variables_).norm();
  }

  const RobotModel& model_;
  int tip_link_;
  const JointIndices& variables_;
  const NumericIkOptions& options_;
  const Pose& X_BT_;
  std::vector<Pose> X_BL_;
  std::vector<Eigen::Index> free_;                  ///< Places in variables_.
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();  ///< Rotation vector from the target to T.
};

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kFirstDamping = 1e-3;     // m²/rad²; about 1e-3 of a large arm's squared reach
constexpr double kLeastDamping = 1e-12;    // keeps the equations solvable
constexpr double kLargestDamping = 1e6;    // beyond it no step helps
constexpr double kDampingDown = 0.2;       // after a good step
constexpr double kDampingUp = 5.0;         // after a bad one
constexpr double kLargestStep = 0.8;       // rad or m; linearisation means nothing beyond
constexpr double kLeastGain = 1e-7;        // relative fall of the cost that counts as progress
constexpr int kStepsWithoutProgress = 3;   // before a start is given up
constexpr int kNearingSteps = 30;          // through the null space, at most
constexpr double kLeastNearing = 1e-3;     // share of the distance that a step has to gain
constexpr double kShortestNearing = 0.05;  // share of the requested step

DampedLeastSquares::DampedLeastSquares(const RobotModel& model, int tip_link,
                                       const JointIndices& variables,
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
    const auto J = error_jacobian(here.error);
    const Eigen::VectorXd gradient = J.transpose() * here.error;
    const Eigen::MatrixXd normal = J.transpose() * J;
    find_free(q, gradient);
    if (free_.empty()) {
      break;
    }
    const Configuration before = q;
    Miss there;
    for (;; damping *= kDampingUp) {
      q = moved(before, step(normal, gradient, damping));
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

void DampedLeastSquares::draw_near(const Configuration& reference, Configuration& q, Miss& here,
                                   int& iterations, const std::function<bool()>& expired) {
  for (int i = 0; i < kNearingSteps && !expired(); ++i) {
    here = miss(q);
    const Eigen::VectorXd wanted = (reference - q)(variables_);
    Eigen::VectorXd motion = null_space_motion(error_jacobian(here.error), wanted);
    if (const double largest = motion.lpNorm<Eigen::Infinity>(); largest > kLargestStep) {
      motion *= kLargestStep / largest;
    }
    const double least = (1.0 - kLeastNearing) * distance(reference, q);
    bool is_nearer = false;
    for (double share = 1.0; share > kShortestNearing && !is_nearer; share *= 0.5) {
      Configuration q_there = moved(q, share * motion);
      const Miss there = descend(q_there, iterations, expired);
      is_nearer = within_tolerance(there) && distance(reference, q_there) < least;
      if (is_nearer) {
        q = std::move(q_there);
        here = there;
      }
    }
    if (!is_nearer) {
      break;
    }
  }
}

bool DampedLeastSquares::within_tolerance(const Miss& miss) const {
  return miss.position <= options_.position_tolerance &&
         miss.orientation <= options_.orientation_tolerance;
}

/// `error` minus the slack each way, and whether a rest remains.
Eigen::Vector3d beyond(const Eigen::Vector3d& error, const Eigen::Vector3d& slack) {
  return error - error.cwiseMax(-slack).cwiseMin(slack);
}

/// Derivative of the rotation vector `turn` as the frame that it leads to turns, both in the frame
/// that it begins at: the inverse of SO(3)'s left Jacobian.
Eigen::Matrix3d rate_of_rotation_vector(const Eigen::Vector3d& turn) {
  constexpr double kSmall = 1e-4;  // rad; the series is exact to rounding below
  const double angle = turn.norm();
  Eigen::Matrix3d cross;
  cross << 0.0, -turn.z(), turn.y(), turn.z(), 0.0, -turn.x(), -turn.y(), turn.x(), 0.0;
  const double second = angle < kSmall
                            ? 1.0 / 12.0
                            : 1.0 / (angle * angle) - 1.0 / (2.0 * angle * std::tan(0.5 * angle));
  return Eigen::Matrix3d::Identity() - 0.5 * cross + second * cross * cross;
}

DampedLeastSquares::Miss DampedLeastSquares::miss(const Configuration& q) {
  model_.forward_kinematics(q, X_BL_);
  const Pose X_GT = X_BT_.inverse() * X_BL_[static_cast<std::size_t>(tip_link_)] * options_.X_LT;
  Miss result;
  result.error.head<3>() = -beyond(X_GT.translation(), options_.position_slack);
  result.position = result.error.head<3>().norm();
  result.error.tail<3>().setZero();
  if (!options_.position_only) {
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_GT.linear()));
    turn_ = turn.angle() * turn.axis();
    const Eigen::Vector3d missing = -beyond(turn_, options_.rotation_slack);
    result.orientation = missing.norm();
    result.error.tail<3>() = options_.orientation_weight * missing;
  }
  result.cost = 0.5 * result.error.squaredNorm();
  return result;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> DampedLeastSquares::error_jacobian(
    const Eigen::Matrix<double, 6, 1>& error) const {
  const Jacobian full = point_jacobian(model_, X_BL_, tip_link_, options_.X_LT.translation());
  const Eigen::Matrix3d R_GB = X_BT_.linear().transpose();
  Eigen::Matrix<double, 6, Eigen::Dynamic> J = full(Eigen::all, variables_);
  J.topRows<3>() = R_GB * J.topRows<3>();
  if (options_.position_only) {
    J.bottomRows<3>().setZero();
  } else {
    J.bottomRows<3>() =
        options_.orientation_weight * rate_of_rotation_vector(turn_) * R_GB * J.bottomRows<3>();
  }
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double slack = i < 3 ? options_.position_slack[i] : options_.rotation_slack[i - 3];
    if (slack > 0.0 && error[i] == 0.0) {
      J.row(i).setZero();
    }
  }
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
  const double largest = delta.lpNorm<Eigen::Infinity>();
  return largest > kLargestStep ? Eigen::VectorXd(delta * (kLargestStep / largest)) : delta;
}

Configuration DampedLeastSquares::moved(const Configuration& q,
                                        const Eigen::VectorXd& delta) const {
  Configuration there = q;
  for (std::size_t k = 0; k < variables_.size(); ++k) {
    const int v = variables_[k];
    const JointLimits& limits = model_.variable(v).limits;
    there[v] = std::clamp(q[v] + delta[static_cast<Eigen::Index>(k)], limits.lower, limits.upper);
  }
  return there;
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

JointIndices variables_named(const RobotModel& model, int tip_link,
                             const std::vector<std::string>& joints) {
  JointIndices chain = chain_variables(model, tip_link);
  if (joints.empty()) {
    return chain;
  }
  JointIndices variables;
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
  need(options.position_slack.minCoeff() >= 0.0, "position_slack",
       options.position_slack.minCoeff(), "0 or more (m)");
  need(options.rotation_slack.minCoeff() >= 0.0, "rotation_slack",
       options.rotation_slack.minCoeff(), "0 or more (rad)");
}

/// Uniform in [0, 1), the same on every C++ library.
double unit(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1p-53; }

std::string failure(const NumericIkResult& result, const NumericIkOptions& options, bool expired) {
  if (result.refused > 0) {
    return fmt::format("{} posture{} the pose, and none of them is accepted", result.refused,
                       result.refused == 1 ? " reaches" : "s reach");
  }
  std::string text = expired ? fmt::format("the time limit of {} s passed", options.time_limit_s)
                             : fmt::format("no posture found from {} starts", result.restarts + 1);
  text += fmt::format("; the nearest misses by {:.3g} mm", millimetres(result.position_residual));
  if (!options.position_only) {
    text += fmt::format(" and {:.3g} degrees", degrees(result.orientation_residual));
  }
  return text;
}

/// Returns the variables that may move by whole turns, as far as limits let them, without effect on
/// the robot: no coupled joint follows them.
JointIndices turning_variables(const RobotModel& model, const JointIndices& variables) {
  JointIndices turning;
  for (const int v : variables) {
    bool comes_round = true;
    for (int link = 1; link < model.link_count(); ++link) {
      const RobotModel::MimicMapping& drive = model.mimic_mapping(link);
      comes_round = comes_round &&
                    (drive.variable != v || (model.joint(link).type == JointType::kRevolute &&
                                             drive.multiplier == std::round(drive.multiplier)));
    }
    if (comes_round) {
      turning.push_back(v);
    }
  }
  return turning;
}

/// `q` with `turning` variables moved by whole turns to the values nearest to the reference within
/// their limits.
Configuration with_nearest_turns(const RobotModel& model, const JointIndices& turning,
                                 const Configuration& reference, Configuration q) {
  for (const int v : turning) {
    const JointLimits& limits = model.variable(v).limits;
    const double least = std::ceil((limits.lower - q[v]) / kTurn);
    const double most = std::floor((limits.upper - q[v]) / kTurn);
    const double turns = std::clamp(std::round((reference[v] - q[v]) / kTurn), std::min(0.0, least),
                                    std::max(0.0, most));
    q[v] = turns == 0.0 ? q[v] : std::clamp(q[v] + turns * kTurn, limits.lower, limits.upper);
  }
  return q;
}

double squared_miss(const NumericIkResult& result, const NumericIkOptions& options) {
  const double turned =
      options.position_only ? 0.0 : options.orientation_weight * result.orientation_residual;
  return result.position_residual * result.position_residual + turned * turned;
}

}  // namespace

NumericInverseKinematics::NumericInverseKinematics(const std::shared_ptr<const RobotModel>& model,
                                                   std::string_view tip_link,
                                                   const std::vector<std::string>& joints,
                                                   const NumericIkOptions& options)
    : InverseKinematics(model, link_named(*model, tip_link),
                        variables_named(*model, link_named(*model, tip_link), joints)),
      options_(options),
      turning_(turning_variables(*model, variables())) {
  check_options(*model, options_);
}

bool NumericInverseKinematics::search(
    const Pose& X_BT, const Configuration& reference,
    const std::function<bool(const NumericIkResult&)>& take) const {
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
  DampedLeastSquares descent(model(), tip_link(), variables(), options_, X_BT);
  NumericIkResult result;
  for (int attempt = 0; attempt <= options_.max_restarts; ++attempt) {
    Configuration q = reference;
    for (const int v : variables()) {
      const double lower = model().lower()[v];
      const double upper = model().upper()[v];
      const JointLimits& limits = model().variable(v).limits;
      q[v] = attempt == 0 ? std::clamp(reference[v], limits.lower, limits.upper)
                          : lower + unit(engine) * (upper - lower);
    }
    DampedLeastSquares::Miss miss = descent.descend(q, result.iterations, expired);
    result.converged = descent.within_tolerance(miss);
    result.q = with_nearest_turns(model(), turning_, reference, std::move(q));
    if (result.converged && options_.stay_near) {
      descent.draw_near(reference, result.q, miss, result.iterations, expired);
    }
    result.restarts = attempt;
    result.position_residual = miss.position;
    result.orientation_residual = miss.orientation;
    if (take(result) || expired()) {
      break;
    }
  }
  return late;
}

NumericIkResult NumericInverseKinematics::find(const Pose& X_BT, const Configuration& reference,
                                               const ConfigurationPredicate& accept) const {
  NumericIkResult best;
  int refused = 0;
  bool is_first = true;
  const bool late = search(X_BT, reference, [&](const NumericIkResult& found) {
    const bool is_refused = found.converged && accept && !accept(found.q);
    refused += is_refused ? 1 : 0;
    if (is_first || squared_miss(found, options_) < squared_miss(best, options_) ||
        (found.converged && !is_refused)) {
      best = found;
      best.converged = found.converged && !is_refused;
    }
    is_first = false;
    best.iterations = found.iterations;
    best.restarts = found.restarts;
    best.refused = refused;
    return best.converged;
  });
  if (!best.converged) {
    best.reason = failure(best, options_, late);
  }
  return best;
}

std::vector<Configuration> NumericInverseKinematics::find_several(
    const Pose& X_BT, const Configuration& reference, int most,
    const ConfigurationPredicate& accept) const {
  constexpr double kSame = 0.1;  // rad or m
  const auto distance = [&](const Configuration& q) { return (q - reference).norm(); };
  const auto is_same = [&](const Configuration& a, const Configuration& b) {
    Eigen::VectorXd difference = a - b;
    for (const int v : turning_) {
      difference[v] = std::remainder(difference[v], kTurn);
    }
    return difference.norm() < kSame;
  };
  std::vector<Configuration> postures;
  search(X_BT, reference, [&](const NumericIkResult& found) {
    if (found.converged && (!accept || accept(found.q))) {
      const auto same = std::ranges::find_if(
          postures, [&](const Configuration& q) { return is_same(q, found.q); });
      if (same == postures.end()) {
        postures.push_back(found.q);
      } else if (distance(found.q) < distance(*same)) {
        *same = found.q;
      }
    }
    return static_cast<int>(postures.size()) >= most;
  });
  std::ranges::stable_sort(postures, {}, distance);
  return postures;
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
