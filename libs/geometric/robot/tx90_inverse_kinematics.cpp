#include "handway/geometric/robot/tx90_inverse_kinematics.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "robot/tx90_geometry.h"
#include "robot/tx90_postures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;
/// Rounding, in rad, that may put a joint beyond its limit.
constexpr double kLimitTolerance = 1e-10;

/// The values angle + k * 2 pi, first ≤ k ≤ last, of one joint.
struct Turns {
  double angle;
  double first, last;
  JointLimits limits;

  [[nodiscard]] bool empty() const { return first > last; }
  /// A value that is over the limit by rounding is put on it.
  [[nodiscard]] double value(double k) const {
    return std::clamp(angle + k * kFullTurn, limits.lower, limits.upper);
  }
};

Turns turns(double angle, double reference, JointLimits limits, const Tx90IkOptions& options) {
  const double nearest = std::round((reference - angle) / kFullTurn);
  if (!options.respect_limits || std::isinf(limits.lower)) {
    limits.lower = -std::numeric_limits<double>::infinity();
    limits.upper = std::numeric_limits<double>::infinity();
    return {angle, nearest, nearest, limits};
  }
  const double first = std::ceil((limits.lower - kLimitTolerance - angle) / kFullTurn);
  const double last = std::floor((limits.upper + kLimitTolerance - angle) / kFullTurn);
  if (options.full_turn_alternates || first > last) {
    return {angle, first, last, limits};
  }
  const double chosen = std::clamp(nearest, first, last);
  return {angle, chosen, chosen, limits};
}

class Solution : public Tx90InverseKinematics {
 public:
  Solution(std::shared_ptr<const RobotModel> model, int tip_link, const Tx90Chain& chain,
           const Tx90IkOptions& options)
      : Tx90InverseKinematics(std::move(model), tip_link,
                              {chain.variables.begin(), chain.variables.end()}),
        chain_(chain),
        geometry_(tx90_geometry(this->model(), chain, tip_link)),
        options_(options) {
    for (std::size_t k = 0; k < 6; ++k) {
      places_[k] = std::ranges::lower_bound(variables(), chain.variables[k]) - variables().begin();
    }
  }

  [[nodiscard]] ArmBranch branch_of(const Configuration& q) const override {
    return tx90_branch(geometry_, chain_values(q));
  }

 private:
  [[nodiscard]] Tx90Joints chain_values(const Configuration& q) const {
    Tx90Joints joints;
    for (std::size_t k = 0; k < 6; ++k) {
      joints[k] = q[chain_.variables[k]];
    }
    return joints;
  }

  [[nodiscard]] IkResult do_solve(const Pose& X_BT, const Configuration& reference) const override {
    const Tx90Joints near = chain_values(reference);
    Tx90Postures postures = tx90_postures(geometry_, X_BT, near);
    IkResult result;
    for (int i = 0; i < postures.count; ++i) {
      const Tx90Posture& posture = postures.list[static_cast<std::size_t>(i)];
      std::array<Turns, 6> choices;
      bool within = true;
      for (std::size_t k = 0; k < 6 && within; ++k) {
        const Joint& joint = model().joint(chain_.links[k]);
        choices[k] = turns(posture.q[k], near[k], joint.limits, options_);
        within = !choices[k].empty();
        if (!within) {
          result.reason = fmt::format(
              "every posture that reaches the pose is out of limits, the last for joint {} at "
              "{:.2f} degrees",
              joint.name, degrees(std::remainder(posture.q[k], kFullTurn)));
        }
      }
      if (within) {
        IkSolution begun{Configuration(6), posture.branch};
        add_turns(choices, 0, begun, result.solutions);
      }
    }
    if (!result.solutions.empty()) {
      result.reason.clear();
    } else if (postures.count == 0) {
      result.reason = std::move(postures.reason);
    }
    return result;
  }

  /// Adds the solutions with the values that joints k to 5 may take.
  void add_turns(const std::array<Turns, 6>& choices, std::size_t k, IkSolution& begun,
                 std::vector<IkSolution>& solutions) const {
    if (k == choices.size()) {
      solutions.push_back(begun);
      return;
    }
    for (double turn = choices[k].first; turn <= choices[k].last; ++turn) {
      begun.q[places_[k]] = choices[k].value(turn);
      add_turns(choices, k + 1, begun, solutions);
    }
  }

  Tx90Chain chain_;
  Tx90Geometry geometry_;
  Tx90IkOptions options_;
  std::array<Eigen::Index, 6> places_;  ///< Of each joint in a solution.
};

}  // namespace

Tx90InverseKinematics::~Tx90InverseKinematics() = default;

std::optional<Configuration> Tx90InverseKinematics::solve_on(const ArmBranch& branch,
                                                             const Pose& X_BT,
                                                             const Configuration& reference) const {
  for (const IkSolution& solution : solve(X_BT, reference).solutions) {
    if (solution.branch == branch) {
      return solution.q;
    }
  }
  return std::nullopt;
}

std::unique_ptr<Tx90InverseKinematics> make_tx90_inverse_kinematics(
    std::shared_ptr<const RobotModel> model, std::string_view tip_link,
    const Tx90IkOptions& options) {
  const std::optional<int> tip = model->find_link(tip_link);
  if (!tip) {
    throw InputError({"inverse kinematics of " + model->name(), "link " + std::string(tip_link),
                      "no link of this name", "a link of the robot", ""});
  }
  const Tx90Chain chain = tx90_chain(*model, *tip);
  return std::make_unique<Solution>(std::move(model), *tip, chain, options);
}

}  // namespace handway::geometric
