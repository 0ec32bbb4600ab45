#include "handway/planning/spaces/state_space.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/arm_inverse_kinematics.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/geometric/robot/robot_state.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

using geometric::Pose;

/// Arm coordinates are its joints normalised to [0, 1].
class JointSpace final : public CorridorSpace {
 public:
  explicit JointSpace(const PlanningProblem& problem)
      : CorridorSpace(problem),
        start_(arm_coordinates(problem.start)),
        goal_(arm_coordinates(problem.goal)) {
    set_arm_coordinates(arm());
  }

  [[nodiscard]] int corridor_dimension() const override { return static_cast<int>(start_.size()); }
  [[nodiscard]] Eigen::VectorXd corridor_point(double step, double rho,
                                               const Eigen::VectorXd& u) const override {
    const Eigen::VectorXd centre = start_ + step * (goal_ - start_);
    return (centre.array() + rho * (2.0 * u.array() - 1.0))
        .max(lower().head(u.size()).array())
        .min(upper().head(u.size()).array());
  }

 private:
  [[nodiscard]] double corridor_length() const override { return (goal_ - start_).norm(); }

  [[nodiscard]] Eigen::VectorXd arm_coordinates(const Configuration& q) const override {
    return geometric::normalised(problem().model(), q)(arm());
  }

  [[nodiscard]] std::optional<Configuration> with_arm(const Configuration& q,
                                                      const Eigen::VectorXd& x) const override {
    Eigen::VectorXd joints = geometric::normalised(problem().model(), q);
    joints(arm()) = x;
    return geometric::denormalised(problem().model(), joints);
  }

  Eigen::VectorXd start_;
  Eigen::VectorXd goal_;
};

[[noreturn]] void refuse(const PlanningProblem& problem, const std::string& found) {
  throw geometric::InputError({problem.scene->file.string(), "robot " + problem.model().name(),
                               found, "an arm of six or more joints, to plan in tool poses",
                               "Set corridor to joint, or choose another planner"});
}

int last_arm_link(const PlanningProblem& problem) {
  if (problem.joints.arm.empty()) {
    refuse(problem, "no arm: all its joints are of the hand");
  }
  return problem.model().variable_link(*std::ranges::max_element(problem.joints.arm));
}

// Iterations from the arm's present posture: for nodes that are near to each other.
geometric::NumericIkOptions tracking() {
  geometric::NumericIkOptions options;
  options.max_iterations = 30;
  options.max_restarts = 0;
  return options;
}

// Scales of ρ_a, which is in normalised joints, to Cartesian space.
constexpr double kPositionScale = 1.0;     // m
constexpr double kOrientationScale = 3.0;  // rad

/// Arm coordinates are the pose of the last arm link, the tool that carries the hand. On the
/// straight motion it rotates evenly about one axis: a second reading of section 5.1. Positions are
/// perturbed along the base's axes, orientations by a rotation vector in the tool's frame.
class ToolSpace final : public CorridorSpace {
 public:
  explicit ToolSpace(const PlanningProblem& problem)
      : CorridorSpace(problem),
        link_(last_arm_link(problem)),
        ik_(geometric::make_arm_inverse_kinematics(problem.scene->robots.front().model, link_,
                                                   problem.joints.arm, tracking())),
        p_BS_(tool_pose(problem.start).translation()),
        p_BG_(tool_pose(problem.goal).translation()),
        q_BS_(tool_pose(problem.start).linear()),
        q_BG_(tool_pose(problem.goal).linear()),
        q_BM_(q_BS_.slerp(0.5, q_BG_)) {
    std::vector<int> arm = problem.joints.arm;
    std::ranges::sort(arm);
    if (ik_->variables() != arm) {
      refuse(problem, "an arm of other joints than those before its last link");
    }
    if (arm.size() < 6) {
      refuse(problem, "an arm of " + geometric::plural(arm.size(), "joint"));
    }
    set_arm_coordinates(std::vector<int>(corridor_dimension(), -1));
  }

  [[nodiscard]] int corridor_dimension() const override { return 6; }
  [[nodiscard]] Eigen::VectorXd corridor_point(double step, double rho,
                                               const Eigen::VectorXd& u) const override {
    const Eigen::Matrix<double, 6, 1> e = rho * (2.0 * u.array() - 1.0);
    const Eigen::Quaterniond q_BT =
        q_BS_.slerp(step, q_BG_) *
        Eigen::Quaterniond(geometric::turn_from_rotation_vector(kOrientationScale * e.tail<3>()));
    return chart(p_BS_ + step * (p_BG_ - p_BS_) + kPositionScale * e.head<3>(),
                 q_BT.toRotationMatrix());
  }

 private:
  [[nodiscard]] double corridor_length() const override {
    return std::max((p_BG_ - p_BS_).norm() / kPositionScale,
                    q_BS_.angularDistance(q_BG_) / kOrientationScale);
  }

  [[nodiscard]] Eigen::VectorXd arm_coordinates(const Configuration& q) const override {
    const Pose X_BT = tool_pose(q);
    return chart(X_BT.translation(), X_BT.linear());
  }

  // Returns the posture nearest to that of `q` over all branches.
  [[nodiscard]] std::optional<Configuration> with_arm(const Configuration& q,
                                                      const Eigen::VectorXd& x) const override {
    Pose X_BT = Pose::Identity();
    X_BT.translation() = kPositionScale * x.head<3>();
    X_BT.linear() =
        q_BM_.toRotationMatrix() *
        geometric::turn_from_rotation_vector(kOrientationScale * x.tail<3>()).toRotationMatrix();
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

  // Position, and the rotation vector from the orientation midway between start and goal, so that
  // the chart's border, half a turn, is far.
  [[nodiscard]] Eigen::VectorXd chart(const Eigen::Vector3d& p_BT,
                                      const Eigen::Matrix3d& R_BT) const {
    const Eigen::AngleAxisd turn(q_BM_.conjugate() * Eigen::Quaterniond(R_BT));
    Eigen::VectorXd x(corridor_dimension());
    x << p_BT / kPositionScale, turn.angle() * turn.axis() / kOrientationScale;
    return x;
  }

  int link_;
  std::unique_ptr<geometric::InverseKinematics> ik_;
  Eigen::Vector3d p_BS_;
  Eigen::Vector3d p_BG_;
  Eigen::Quaterniond q_BS_;
  Eigen::Quaterniond q_BG_;
  Eigen::Quaterniond q_BM_;  ///< Midway.
};

}  // namespace

void require_directions(const PlanningProblem& problem, const std::string& user) {
  if (problem.basis || !problem.joints.holding.empty()) {
    return;
  }
  throw geometric::InputError(
      {problem.scene->file.string(), "hand_basis", "nothing", "a PMD basis for " + user,
       problem.scene->group.empty() ? "Name one in the scene, or choose another planner"
                                    : "Let the whole hand move by the scene's group, or choose "
                                      "another planner"});
}

sampling::PmdBasis hand_basis(const PlanningProblem& problem, HandSpace space) {
  if (space == HandSpace::kPrincipalDirections && problem.basis) {
    return *problem.basis;
  }
  std::vector<std::string> joints;
  joints.reserve(problem.joints.hand.size());
  for (const int v : problem.joints.hand) {
    joints.push_back(problem.model().variable(v).name);
  }
  return sampling::full_joint_basis(problem.model().name(), std::move(joints));
}

StateSpace::StateSpace(const PlanningProblem& problem)
    : problem_(problem), arm_(problem.joints.arm) {
  for (const int v : problem.planned_joints()) {
    if (std::ranges::count(arm_, v) + std::ranges::count(problem.joints.hand, v) == 0) {
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

void CorridorSpace::set_arm_coordinates(geometric::JointIndices joints) {
  joints.insert(joints.end(), problem().joints.hand.begin(), problem().joints.hand.end());
  const auto size = static_cast<Eigen::Index>(joints.size());
  Eigen::VectorXd lower = Eigen::VectorXd::Zero(size);
  Eigen::VectorXd upper = Eigen::VectorXd::Ones(size);
  Eigen::VectorXd periods = Eigen::VectorXd::Zero(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const int v = joints[static_cast<std::size_t>(i)];
    periods[i] = v >= 0 && problem().model().is_continuous(v) ? 1.0 : 0.0;
    if (v < 0 || periods[i] > 0.0) {
      lower[i] = -std::numeric_limits<double>::infinity();
      upper[i] = std::numeric_limits<double>::infinity();
    }
  }
  set_bounds(std::move(lower), std::move(upper), geometric::Periods(std::move(periods)));
}

int CorridorSpace::steps(double rho) const {
  constexpr int kMost = 1 << 20;
  int count = 1;
  while (count < kMost && corridor_length() / count > rho) {
    count *= 2;
  }
  return count;
}

Eigen::VectorXd CorridorSpace::coordinates(const Configuration& q) const {
  const Eigen::VectorXd arm = arm_coordinates(q);
  Eigen::VectorXd x(arm.size() + static_cast<Eigen::Index>(problem().joints.hand.size()));
  x << arm, geometric::normalised(problem().model(), q)(problem().joints.hand);
  return x;
}

std::optional<Configuration> CorridorSpace::configuration(const Eigen::VectorXd& x,
                                                          const Configuration& reference) const {
  const auto hand_size = static_cast<Eigen::Index>(problem().joints.hand.size());
  Eigen::VectorXd joints = geometric::normalised(problem().model(), reference);
  joints(problem().joints.hand) = x.tail(hand_size);
  return with_arm(geometric::denormalised(problem().model(), joints), x.head(x.size() - hand_size));
}

bool has_closed_form_kinematics(const PlanningProblem& problem) {
  return !problem.joints.arm.empty() &&
         geometric::closed_form_inverse_kinematics(problem.scene->robots.front().model,
                                                   last_arm_link(problem), problem.joints.arm);
}

std::unique_ptr<CorridorSpace> make_corridor_space(const PlanningProblem& problem,
                                                   CorridorForm form) {
  if (form == CorridorForm::kCartesian) {
    return std::make_unique<ToolSpace>(problem);
  }
  return std::make_unique<JointSpace>(problem);
}

HandArmRegion::HandArmRegion(const PlanningProblem& problem, HandSpace hand, CorridorForm form)
    : problem_(problem),
      basis_(hand_basis(problem, hand)),
      space_(make_corridor_space(problem, form)) {}

std::optional<Configuration> HandArmRegion::arm_at(double step, double rho,
                                                   const Eigen::VectorXd& u) const {
  Configuration on_segment = problem_.start;
  on_segment(problem_.joints.arm) += step * (problem_.goal - problem_.start)(problem_.joints.arm);
  const Eigen::VectorXd arm = space_->corridor_point(step, rho, u);
  const Eigen::VectorXd hand =
      geometric::normalised(problem_.model(), problem_.start)(problem_.joints.hand);
  Eigen::VectorXd x(arm.size() + hand.size());
  x << arm, hand;
  return space_->configuration(x, on_segment);
}

Configuration HandArmRegion::with_hand(Configuration q, const Eigen::VectorXd& u) const {
  const geometric::RobotModel& model = problem_.model();
  const Eigen::VectorXd range = (model.upper() - model.lower())(problem_.joints.hand);
  q(problem_.joints.hand) =
      model.lower()(problem_.joints.hand) + sampling::map_to_posture(basis_, u).cwiseProduct(range);
  return q;
}

}  // namespace handway::planning
