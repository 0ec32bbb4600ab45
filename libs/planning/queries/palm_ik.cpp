#include "handway/planning/queries/palm_ik.h"

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/arm_inverse_kinematics.h"
#include "handway/geometric/robot/jacobian.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace handway::planning {
namespace {

using geometric::JointIndices;
using geometric::Pose;
using geometric::RobotModel;

constexpr std::ptrdiff_t kPoseFreedoms = 6;
constexpr double kBend = 0.05;   // rad
constexpr double kBetter = 0.9;  // share of the remaining distance that justifies a jump

// Returns those of the variables that move the link.
JointIndices that_move(const RobotModel& model, int link, const JointIndices& variables) {
  JointIndices moving = geometric::chain_variables(model, link);
  std::erase_if(moving, [&](int one) { return std::ranges::count(variables, one) == 0; });
  return moving;
}

// Solutions near to the reference only.
geometric::NumericIkOptions from_the_reference(const RobotModel& model, int palm,
                                               const JointIndices& arm) {
  geometric::NumericIkOptions options;
  options.position_only = std::ssize(that_move(model, palm, arm)) < kPoseFreedoms;
  options.position_tolerance = geometric::metres(0.1);
  options.orientation_tolerance = geometric::radians(0.01);
  options.max_restarts = 0;
  options.max_iterations = 60;
  return options;
}

// Several postures, from some other starts.
geometric::NumericIkOptions from_anywhere(geometric::NumericIkOptions options) {
  options.max_restarts = 8;
  return options;
}

}  // namespace

PalmIk::PalmIk(std::shared_ptr<const RobotModel> model, int palm, const JointIndices& arm)
    : model_(std::move(model)),
      palm_(palm),
      arm_(arm),
      closed_form_(geometric::closed_form_inverse_kinematics(model_, palm, arm)),
      iterative_(geometric::iterative_inverse_kinematics(model_, palm, arm,
                                                         from_the_reference(*model_, palm, arm))),
      searching_(geometric::iterative_inverse_kinematics(model_, palm, arm,
                                                         from_anywhere(iterative_->options()))) {}

PalmIk::~PalmIk() = default;
PalmIk::PalmIk(PalmIk&&) noexcept = default;

Pose PalmIk::pose(const Configuration& q) const {
  std::vector<Pose> X_BL(static_cast<std::size_t>(model_->link_count()));
  model_->forward_kinematics(q, X_BL);
  return X_BL[static_cast<std::size_t>(palm_)];
}

PalmMove PalmIk::moved(const Configuration& q, const Pose& X_BP) const {
  if (closed_form_) {
    const geometric::IkResult found = closed_form_->solve(X_BP, q);
    if (!found.solutions.empty()) {
      return {closed_form_->placed(found.solutions.front(), q), true};
    }
  }
  geometric::NumericIkResult found = iterative_->find(X_BP, q);
  for (const double bend : {kBend, -kBend}) {  // a stretched arm does not fold by itself
    if (found.converged) {
      break;
    }
    Configuration bent = q;
    for (const int v : iterative_->variables()) {
      bent[v] += bend;
    }
    bent = model_->clamped(std::move(bent));
    geometric::NumericIkResult other = iterative_->find(X_BP, bent);
    if (other.converged || other.position_residual < kBetter * found.position_residual) {
      found = std::move(other);
    }
  }
  return {found.q, found.converged};
}

std::vector<Configuration> PalmIk::all(const Configuration& q, const Pose& X_BP, int most) const {
  if (!closed_form_) {
    return geometric::reach_ball(*model_, palm_, arm_, q).contains(X_BP.translation())
               ? searching_->find_several(X_BP, q, most)
               : std::vector<Configuration>();
  }
  std::vector<Configuration> postures;
  for (const geometric::IkSolution& solution : closed_form_->solve(X_BP, q).solutions) {
    postures.push_back(closed_form_->placed(solution, q));
  }
  return postures;
}

bool PalmIk::is_redundant() const {
  const std::ptrdiff_t freedoms = iterative_->options().position_only ? 3 : kPoseFreedoms;
  return std::ssize(iterative_->variables()) > freedoms;
}

Eigen::VectorXd PalmIk::null_space_direction(const Configuration& q,
                                             const Eigen::VectorXd& last) const {
  constexpr double kNone = 1e-3;
  std::vector<Pose> X_BL(static_cast<std::size_t>(model_->link_count()));
  model_->forward_kinematics(q, X_BL);
  const Eigen::Index rows = iterative_->options().position_only ? 3 : kPoseFreedoms;
  const Eigen::MatrixXd J = geometric::point_jacobian(*model_, X_BL, palm_)
                                .topRows(rows)(Eigen::all, iterative_->variables());
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(J.cols());
  if (last.size() == J.cols()) {
    direction = geometric::null_space_motion(J, last);
  } else {  // of the joint that can move most
    for (Eigen::Index joint = 0; joint < J.cols(); ++joint) {
      const Eigen::VectorXd motion =
          geometric::null_space_motion(J, Eigen::VectorXd::Unit(J.cols(), joint));
      direction = motion.norm() > direction.norm() ? motion : direction;
    }
  }
  return direction.norm() > kNone ? Eigen::VectorXd(direction.normalized()) : Eigen::VectorXd();
}

Configuration PalmIk::swung(const Configuration& q, const Pose& X_BP, double by,
                            Eigen::VectorXd& direction) const {
  constexpr double kStep = 0.02;     // rad
  constexpr double kProgress = 0.3;  // of a step, or a limit is in the way
  Configuration now = q;
  if (!is_redundant()) {
    return now;
  }
  const JointIndices& joints = iterative_->variables();
  const int steps = static_cast<int>(std::ceil(std::abs(by) / kStep));
  for (int s = 0; s < steps; ++s) {
    const Eigen::VectorXd next = null_space_direction(now, direction);
    if (next.size() == 0) {
      break;
    }
    Configuration moved = now;
    moved(joints) += by / steps * next;
    const geometric::NumericIkResult held = iterative_->find(X_BP, model_->clamped(moved));
    const double progress = (held.q - now)(joints).dot(next) * (by < 0.0 ? -1.0 : 1.0);
    if (!held.converged || progress < kProgress * std::abs(by) / steps) {
      break;
    }
    direction = next;
    now = held.q;
  }
  return now;
}

std::optional<ReachFigures> reach_figures(const RobotModel& model, int link,
                                          const JointIndices& arm, const Configuration& q) {
  const JointIndices moving = that_move(model, link, arm);
  if (moving.empty()) {
    return std::nullopt;
  }
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(q, X_BL);
  const Eigen::MatrixXd J =
      geometric::point_jacobian(model, X_BL, link).topRows(3)(Eigen::all, moving);
  const geometric::ReachBall ball = geometric::reach_ball(model, link, moving, q);
  const Eigen::Vector3d p_B = X_BL[static_cast<std::size_t>(link)].translation();
  return ReachFigures{geometric::manipulability(J),
                      ball.radius > 0.0 ? (p_B - ball.centre).norm() / ball.radius : 0.0};
}

Eigen::Vector3d middle_of(const geometric::Link& link) {
  const geometric::TriangleMesh shape = geometric::collision_mesh(link);
  return shape.vertices.empty() ? Eigen::Vector3d::Zero() : geometric::bounding_box(shape).centre();
}

}  // namespace handway::planning
