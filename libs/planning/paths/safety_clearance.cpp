#include "handway/planning/paths/safety_clearance.h"

#include "handway/geometric/collision/continuous/motion_bound.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace handway::planning {
namespace {

constexpr double kAssumedTurn = 0.01;    // rad
constexpr double kAssumedSlide = 0.001;  // m
constexpr double kPathStep = 1e-3;       // m, that a point of the robot moves between two looks

bool slides(const geometric::RobotModel& model, int variable) {
  return model.joint(model.variable_link(variable)).type == geometric::JointType::kPrismatic;
}

}  // namespace

Eigen::VectorXd assumed_following_error(const geometric::RobotModel& model) {
  Eigen::VectorXd error(model.variable_count());
  for (int v = 0; v < model.variable_count(); ++v) {
    error[v] = slides(model, v) ? kAssumedSlide : kAssumedTurn;
  }
  return error;
}

double ClearanceShortfall::suggested_margin() const {
  const double needed_mm = geometric::millimetres(following) + geometric::millimetres(margin);
  return geometric::metres(std::max(1.0, std::ceil(needed_mm)));
}

SafetyClearance::SafetyClearance(const PlanningProblem& problem, double margin)
    : checker_(problem.checker->clone()), motion_(problem.motion), margin_(margin) {}

double SafetyClearance::displacement(int body, int frame, const Eigen::VectorXd& error) const {
  const geometric::RobotModel& model = motion_->model();
  const geometric::MotionBound::Ball& ball = motion_->ball(body);
  const std::vector<geometric::Pose>& X_BL = checker_->link_poses();
  const Eigen::Vector3d centre = X_BL[static_cast<std::size_t>(ball.link)] * ball.centre;
  double sum = 0.0;
  for (int i = ball.link; i != frame; i = model.parent(i)) {
    const geometric::RobotModel::MimicMapping& drive = model.mimic_mapping(i);
    if (drive.variable < 0) {
      continue;
    }
    double reach = 1.0;
    if (model.joint(i).type != geometric::JointType::kPrismatic) {
      const geometric::Pose& X_BJ = X_BL[static_cast<std::size_t>(i)];
      const Eigen::Vector3d axis = X_BJ.linear() * model.joint(i).axis;
      const double now = axis.cross(centre - X_BJ.translation()).norm() + ball.radius;
      reach = std::min(now, motion_->reach(i, body));
    }
    sum += std::abs(drive.multiplier) * error[drive.variable] * reach;
  }
  return sum;
}

double SafetyClearance::approach(int pair, const Eigen::VectorXd& error) const {
  const geometric::MotionBound::PairFrame& frame = motion_->pair_frame(pair);
  const double now = displacement(frame.a, frame.link, error) +
                     (frame.b_moves ? displacement(frame.b, frame.link, error) : 0.0);
  return std::min(now, motion_->bound(pair, error));
}

void SafetyClearance::look(const Configuration& q, const Eigen::VectorXd& error, double place) {
  const geometric::CollisionWorld& world = checker_->world();
  if (world.pairs().empty()) {
    return;
  }
  checker_->place(q);
  const double farthest = motion_->bounds(error).head(motion_->pair_motions()).maxCoeff() + margin_;
  checker_->near_pairs(share_ * farthest, near_);
  for (const int pair : near_) {
    const double needed = approach(pair, error) + margin_;
    const double enough = share_ * needed;  // what is not worse than the worst is not asked for
    if (!(enough > 0.0)) {
      continue;
    }
    const double clearance = checker_->pair_distance(pair, enough);
    if (clearance >= enough) {
      continue;
    }
    share_ = clearance / needed;
    const geometric::NamedPair bodies = geometric::named_pair(world, pair, clearance);
    worst_ = {bodies.a,
              bodies.b,
              place,
              clearance,
              needed - margin_,
              margin_,
              error.size() > 0 ? error.maxCoeff() : 0.0};
  }
}

std::optional<ClearanceShortfall> path_shortfall(const PlanningProblem& problem, const Path& path,
                                                 double margin) {
  SafetyClearance clearance(problem, margin);
  const Eigen::VectorXd error =
      Eigen::VectorXd::Constant(problem.model().variable_count(), kErrorAtRest);
  for (std::size_t w = 0; w < path.waypoints.size(); ++w) {
    clearance.look(path.waypoints[w], error, static_cast<double>(w + 1));
    if (w + 1 == path.waypoints.size()) {
      break;
    }
    const Configuration delta = path.waypoints[w + 1] - path.waypoints[w];
    const int steps =
        static_cast<int>(std::ceil(problem.motion->any_point(delta.cwiseAbs()) / kPathStep));
    for (int s = 1; s < steps; ++s) {
      clearance.look(path.waypoints[w] + (static_cast<double>(s) / steps) * delta, error,
                     static_cast<double>(w + 1));
    }
  }
  return clearance.worst();
}

std::string to_string(const ClearanceShortfall& shortfall) {
  std::string text = fmt::format(
      "{} with {}: clearance {:.3f} mm, {:.2f} mm are needed ({:.2f} mm for joint errors of "
      "{:.2f}°",
      shortfall.a, shortfall.b, geometric::millimetres(shortfall.clearance),
      geometric::millimetres(shortfall.needed()), geometric::millimetres(shortfall.following),
      geometric::degrees(shortfall.following_error));
  if (shortfall.margin > 0.0) {
    text += fmt::format(", {:.2f} mm margin", geometric::millimetres(shortfall.margin));
  }
  return text + ")";
}

}  // namespace handway::planning
