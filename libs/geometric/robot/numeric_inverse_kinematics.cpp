#include "handway/geometric/robot/numeric_inverse_kinematics.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "robot/damped_least_squares.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <utility>

namespace handway::geometric {
namespace {

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
