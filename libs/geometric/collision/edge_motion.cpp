#include "handway/geometric/collision/edge_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace handway::geometric {

EdgeMotion::EdgeMotion(std::shared_ptr<const MotionBound> motion) : motion_(std::move(motion)) {
  const auto links = static_cast<std::size_t>(motion_->model().link_count());
  rates_.resize(links);
  w_BL_.resize(links, Eigen::Vector3d::Zero());
  v_BL_.resize(links, Eigen::Vector3d::Zero());
}

void EdgeMotion::set_edge(const Configuration& delta) {
  const RobotModel& model = motion_->model();
  travel_ = motion_->bounds(delta.cwiseAbs());
  most_ = motion_->pair_motions() > 0 ? travel_.head(motion_->pair_motions()).maxCoeff() : 0.0;
  for (int i = 1; i < model.link_count(); ++i) {
    const RobotModel::Drive& drive = model.drive(i);
    rates_[static_cast<std::size_t>(i)] =
        drive.variable < 0 ? 0.0 : drive.multiplier * delta[drive.variable];
  }
}

void EdgeMotion::set_middle(const std::vector<Pose>& X_BL) {
  const RobotModel& model = motion_->model();
  X_BL_ = &X_BL;
  for (std::size_t i = 1; i < X_BL.size(); ++i) {
    const int link = static_cast<int>(i);
    const auto parent = static_cast<std::size_t>(model.parent(link));
    w_BL_[i] = w_BL_[parent];
    v_BL_[i] =
        v_BL_[parent] + w_BL_[parent].cross(X_BL[i].translation() - X_BL[parent].translation());
    if (rates_[i] != 0.0) {
      const Eigen::Vector3d motion = rates_[i] * (X_BL[i].linear() * model.joint(link).axis);
      (model.joint(link).type == JointType::kPrismatic ? v_BL_[i] : w_BL_[i]) += motion;
    }
  }
}

double EdgeMotion::within(int pair, double half) const {
  const double coarse = over_edge(pair) * half;
  const MotionBound::PairFrame& frame = motion_->pair_frame(pair);
  double fine = way(frame.a, frame.link, half);
  if (fine < coarse && frame.b_moves) {
    fine += way(frame.b, frame.link, half);
  }
  return std::min(coarse, fine);
}

// The velocity in the middle, of the point that is fastest, and what it can gain.
double EdgeMotion::way(int body, int frame, double half) const {
  const RobotModel& model = motion_->model();
  const MotionBound::Ball& ball = motion_->ball(body);
  const auto link = static_cast<std::size_t>(ball.link);
  const auto base = static_cast<std::size_t>(frame);
  // Second derivatives of a point's way by two joints: the outer one's, turned by the inner one.
  double bend = 0.0;
  double outer = 0.0;  // the sum of the ways by the joints from the body inwards
  for (int i = ball.link; i != frame; i = model.parent(i)) {
    const double rate = std::abs(rates_[static_cast<std::size_t>(i)]);
    if (rate == 0.0) {
      continue;
    }
    const double own = rate * motion_->reach(i, body);
    if (model.joint(i).type == JointType::kRevolute) {
      bend += rate * (own + 2.0 * outer);
    }
    outer += own;
  }
  const Eigen::Vector3d w = w_BL_[link] - w_BL_[base];  // all in the robot's base
  if (ball.is_direction) {
    const double turn = w.cross((*X_BL_)[link].linear() * ball.centre).norm();
    return half * (turn + 0.5 * half * bend);
  }
  const Eigen::Vector3d p = (*X_BL_)[link] * ball.centre;
  const Eigen::Vector3d v = v_BL_[link] + w_BL_[link].cross(p - (*X_BL_)[link].translation()) -
                            v_BL_[base] - w_BL_[base].cross(p - (*X_BL_)[base].translation());
  const double velocity = v.norm() + w.norm() * ball.radius;
  return half * (velocity + 0.5 * half * bend);
}

}  // namespace handway::geometric
