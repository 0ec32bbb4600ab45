#include "handway/planning/spaces/state_space.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/arm_inverse_kinematics.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway/sampling/regions/arm_corridor.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using geometric::Pose;

/// Arm coordinates are its joints normalised to [0, 1].
class JointSpace final : public CorridorSpace {
 public:
  explicit JointSpace(const PlanningProblem& problem)
      : CorridorSpace(problem),
        corridor_(arm_coordinates(problem.start), arm_coordinates(problem.goal)) {
    set_arm_coordinates(arm());
  }

  [[nodiscard]] int steps(double rho) const override { return corridor_.steps(rho); }
  [[nodiscard]] int corridor_dimension() const override { return corridor_.dimension(); }
  [[nodiscard]] Eigen::VectorXd corridor_point(double step, double rho,
                                               const Eigen::VectorXd& u) const override {
    return corridor_.sample(step, rho, u)
        .cwiseMax(lower().head(u.size()))
        .cwiseMin(upper().head(u.size()));
  }

 private:
  [[nodiscard]] Eigen::VectorXd arm_coordinates(const Configuration& q) const override {
    return geometric::normalised(problem().model(), q)(arm());
  }

  [[nodiscard]] std::optional<Configuration> with_arm(const Configuration& q,
                                                      const Eigen::VectorXd& x) const override {
    Eigen::VectorXd joints = geometric::normalised(problem().model(), q);
    joints(arm()) = x;
    return geometric::denormalised(problem().model(), joints);
  }

  sampling::ArmCorridor corridor_;
};

[[noreturn]] void refuse(const PlanningProblem& problem, const std::string& found) {
  throw geometric::InputError({problem.scene->file.string(), "robot " + problem.model().name(),
                               found, "an arm of six or more joints, to plan in tool poses",
                               "Set corridor to joint, or choose another planner"});
}

int last_arm_link(const PlanningProblem& problem) {
  if (problem.arm.empty()) {
    refuse(problem, "no arm: all its joints are of the hand");
  }
  return problem.model().variable_link(*std::ranges::max_element(problem.arm));
}

// Iterations from where the arm is: between nodes that are near to each other.
geometric::NumericIkOptions tracking() {
  geometric::NumericIkOptions options;
  options.max_iterations = 30;
  options.max_restarts = 0;
  return options;
}

/// Arm coordinates are the pose of the last arm link, the tool that carries the hand.
class ToolSpace final : public CorridorSpace {
 public:
  explicit ToolSpace(const PlanningProblem& problem)
      : CorridorSpace(problem),
        link_(last_arm_link(problem)),
        ik_(geometric::make_arm_inverse_kinematics(problem.scene->robots.front().model, link_,
                                                   problem.arm, tracking())),
        corridor_(tool_pose(problem.start), tool_pose(problem.goal), scale_),
        q_BM_(Eigen::Quaterniond(tool_pose(problem.start).linear())
                  .slerp(0.5, Eigen::Quaterniond(tool_pose(problem.goal).linear()))) {
    std::vector<int> arm = problem.arm;
    std::ranges::sort(arm);
    if (ik_->variables() != arm) {
      refuse(problem, "an arm of other joints than those before its last link");
    }
    if (arm.size() < 6) {
      refuse(problem, fmt::format("an arm of {} joint{}", arm.size(), arm.size() == 1 ? "" : "s"));
    }
    set_arm_coordinates(std::vector<int>(6, -1));
  }

  [[nodiscard]] int steps(double rho) const override { return corridor_.steps(rho); }
  [[nodiscard]] int corridor_dimension() const override {
    return sampling::CartesianCorridor::kDimension;
  }
  [[nodiscard]] Eigen::VectorXd corridor_point(double step, double rho,
                                               const Eigen::VectorXd& u) const override {
    return chart(corridor_.pose(step, rho, u));
  }

 private:
  [[nodiscard]] Eigen::VectorXd arm_coordinates(const Configuration& q) const override {
    return chart(tool_pose(q));
  }

  // Of all branches the posture nearest to that of `q`.
  [[nodiscard]] std::optional<Configuration> with_arm(const Configuration& q,
                                                      const Eigen::VectorXd& x) const override {
    Pose X_BT = Pose::Identity();
    X_BT.translation() = scale_.position * x.head<3>();
    X_BT.linear() =
        q_BM_.toRotationMatrix() *
        geometric::turn_from_rotation_vector(scale_.orientation * x.tail<3>()).toRotationMatrix();
    const geometric::IkResult found = ik_->solve(X_BT, q);
    return found.solutions.empty() ? std::nullopt
                                   : std::optional(ik_->placed(found.solutions.front(), q));
  }

  // X_BT in the robot's base.
  [[nodiscard]] Pose tool_pose(const Configuration& q) const {
    geometric::RobotState state(problem().scene->robots.front().model);
    state.set_configuration(q);
    return state.link_pose(link_);
  }

  // Position, and the rotation vector from the orientation midway between start
  // and goal, so that the chart's border, half a turn, is far.
  [[nodiscard]] Eigen::VectorXd chart(const Pose& X_BT) const {
    const Eigen::AngleAxisd turn(q_BM_.conjugate() * Eigen::Quaterniond(X_BT.linear()));
    Eigen::VectorXd x(6);
    x << X_BT.translation() / scale_.position, turn.angle() * turn.axis() / scale_.orientation;
    return x;
  }

  int link_;
  std::unique_ptr<geometric::InverseKinematics> ik_;
  sampling::CartesianScale scale_;
  sampling::CartesianCorridor corridor_;
  Eigen::Quaterniond q_BM_;
};

}  // namespace

StateSpace::StateSpace(const PlanningProblem& problem) : problem_(problem), arm_(problem.arm) {
  for (int v = 0; v < problem.model().variable_count(); ++v) {
    const bool is_listed = std::ranges::count(arm_, v) + std::ranges::count(problem.hand, v) > 0;
    if (!is_listed && problem.start[v] != problem.goal[v]) {
      arm_.push_back(v);
    }
  }
}

StateSpace::~StateSpace() = default;

void StateSpace::set_bounds(Eigen::VectorXd lower, Eigen::VectorXd upper,
                            geometric::Periods periods) {
  lower_ = std::move(lower);
  upper_ = std::move(upper);
  periods_ = std::move(periods);
}

void CorridorSpace::set_arm_coordinates(const std::vector<int>& arm_variables) {
  std::vector<int> variables = arm_variables;
  variables.insert(variables.end(), problem().hand.begin(), problem().hand.end());
  const auto size = static_cast<Eigen::Index>(variables.size());
  Eigen::VectorXd lower = Eigen::VectorXd::Zero(size);
  Eigen::VectorXd upper = Eigen::VectorXd::Ones(size);
  Eigen::VectorXd periods = Eigen::VectorXd::Zero(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const int v = variables[static_cast<std::size_t>(i)];
    periods[i] = v >= 0 && problem().model().is_continuous(v) ? 1.0 : 0.0;
    if (v < 0 || periods[i] > 0.0) {
      lower[i] = -std::numeric_limits<double>::infinity();
      upper[i] = std::numeric_limits<double>::infinity();
    }
  }
  set_bounds(std::move(lower), std::move(upper), geometric::Periods(std::move(periods)));
}

Eigen::VectorXd CorridorSpace::coordinates(const Configuration& q) const {
  const Eigen::VectorXd arm = arm_coordinates(q);
  Eigen::VectorXd x(arm.size() + static_cast<Eigen::Index>(problem().hand.size()));
  x << arm, geometric::normalised(problem().model(), q)(problem().hand);
  return x;
}

std::optional<Configuration> CorridorSpace::configuration(const Eigen::VectorXd& x,
                                                          const Configuration& reference) const {
  const auto hand_size = static_cast<Eigen::Index>(problem().hand.size());
  Eigen::VectorXd joints = geometric::normalised(problem().model(), reference);
  joints(problem().hand) = x.tail(hand_size);
  return with_arm(geometric::denormalised(problem().model(), joints), x.head(x.size() - hand_size));
}

bool has_closed_form_kinematics(const PlanningProblem& problem) {
  return !problem.arm.empty() &&
         geometric::closed_form_inverse_kinematics(problem.scene->robots.front().model,
                                                   last_arm_link(problem), problem.arm);
}

std::unique_ptr<CorridorSpace> make_corridor_space(const PlanningProblem& problem,
                                                   CorridorForm form) {
  if (form == CorridorForm::kCartesian) {
    return std::make_unique<ToolSpace>(problem);
  }
  return std::make_unique<JointSpace>(problem);
}

}  // namespace handway::planning
