#include "grasps/hand_closing.h"

#include "handway/geometric/robot/jacobian.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/queries/palm_ik.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using geometric::RobotModel;

// The tip that is farthest from the middle of all.
Eigen::Index thumb_of(const Eigen::Matrix3Xd& tips) {
  const Vector3d middle = tips.rowwise().mean();
  Eigen::Index thumb = 0;
  (tips.colwise() - middle).colwise().norm().maxCoeff(&thumb);
  return thumb;
}

// Returns the other tips that reach about as far from the palm as the thumb: not fingers that
// are bent away, nor the inner bars of a parallel gripper.
std::vector<Eigen::Index> opposite(Eigen::Index thumb, const Eigen::Matrix3Xd& tips) {
  constexpr double kThumbReachShare = 0.7;
  std::vector<Eigen::Index> others;
  for (Eigen::Index i = 0; i < tips.cols(); ++i) {
    if (i != thumb && tips.col(i).norm() > kThumbReachShare * tips.col(thumb).norm()) {
      others.push_back(i);
    }
  }
  return others;
}

}  // namespace

bool has_directions(const PlanningProblem& problem) {
  return problem.basis && !problem.basis->directions.empty();
}

Vector3d nearest_in(const geometric::Aabb& box, const Vector3d& p) {
  return p.cwiseMax(box.lower).cwiseMin(box.upper);
}

HandClosing::HandClosing(const PlanningProblem& problem)
    : problem_(problem), palm_(problem.hand.palm) {
  std::ranges::transform(problem.hand.fingers, std::back_inserter(fingers_),
                         [this](const auto& finger) { return closing_finger(finger); });
  make_preshapes();
}

std::span<const HandClosing::Preshape> HandClosing::opened_to(double width) const {
  constexpr double kMaxSpareOpening = 0.06;  // m
  const auto first = std::ranges::lower_bound(preshapes_, width, {}, &Preshape::opening);
  const auto last =
      std::ranges::upper_bound(preshapes_, width + kMaxSpareOpening, {}, &Preshape::opening);
  return {first, last};
}

Configuration HandClosing::with_hand(Configuration q, const Eigen::VectorXd& posture) const {
  const RobotModel& model = problem_.model();
  const Eigen::VectorXd lower = model.lower()(problem_.joints.hand);
  const Eigen::VectorXd upper = model.upper()(problem_.joints.hand);
  const Eigen::VectorXd share = posture.cwiseMax(0.0).cwiseMin(1.0);
  q(problem_.joints.hand) = (lower + share.cwiseProduct(upper - lower)).cwiseMin(upper);
  return q;
}

Eigen::VectorXd HandClosing::hand_of(const Configuration& q) const {
  return geometric::normalised(problem_.model(), q)(problem_.joints.hand);
}

Vector3d HandClosing::tip_in_palm(const Finger& finger, const Configuration& q) const {
  return tip_link(finger, link_poses(hand_of(q))) * finger.p_LTip;
}

Eigen::VectorXd HandClosing::towards(const Finger& finger, const Eigen::VectorXd& posture,
                                     const geometric::Aabb& box, const Pose& X_PO) const {
  const RobotModel& model = problem_.model();
  const std::vector<Pose> X_BL = link_poses(posture);
  const Vector3d tip_O = X_PO.inverse() * tip_link(finger, X_BL) * finger.p_LTip;
  const Pose X_BO = X_BL[static_cast<std::size_t>(palm_)] * X_PO;
  const Vector3d direction_B = X_BO.linear() * (nearest_in(box, tip_O) - tip_O).normalized();
  const geometric::Jacobian J = geometric::point_jacobian(model, X_BL, finger.tip, finger.p_LTip);
  const Eigen::VectorXd of_hand =
      (J.topRows<3>().transpose() * direction_B)
          .cwiseProduct(model.upper() - model.lower())(problem_.joints.hand);
  const Eigen::VectorXd rates = of_hand(finger.joints);
  return rates.norm() > 1e-9 ? rates.normalized() : Eigen::VectorXd::Zero(rates.size());
}

HandClosing::Finger HandClosing::closing_finger(const geometric::HandFinger& found) const {
  const RobotModel& model = problem_.model();
  Finger finger{.joints = {}, .links = found.links, .tip = found.tip};
  for (const int joint : found.joints) {
    const auto place = std::ranges::find(problem_.joints.hand, joint);
    finger.joints.push_back(static_cast<int>(place - problem_.joints.hand.begin()));
  }
  finger.p_LTip = middle_of(model.link(finger.tip));
  double length = finger.p_LTip.norm();
  for (const Vector3d& p_L : geometric::collision_mesh(model.link(finger.tip)).vertices) {
    length = std::max(length, p_L.norm());
  }
  finger.p_LEnd = length * finger.p_LTip.normalized();
  return finger;
}

std::vector<Pose> HandClosing::link_poses(const Eigen::VectorXd& posture) const {
  std::vector<Pose> X_BL(static_cast<std::size_t>(problem_.model().link_count()));
  problem_.model().forward_kinematics(with_hand(problem_.start, posture), X_BL);
  return X_BL;
}

// In the palm's frame.
Pose HandClosing::tip_link(const Finger& finger, const std::vector<Pose>& X_BL) const {
  return X_BL[static_cast<std::size_t>(palm_)].inverse() *
         X_BL[static_cast<std::size_t>(finger.tip)];
}

std::optional<HandClosing::Preshape> HandClosing::preshape(Eigen::VectorXd open) const {
  if (fingers_.size() < 2) {
    return std::nullopt;
  }
  const std::vector<Pose> X_BL = link_poses(open);
  Eigen::Matrix3Xd tips(3, std::ssize(fingers_));
  Eigen::Matrix3Xd ends(3, tips.cols());
  for (Eigen::Index i = 0; i < tips.cols(); ++i) {
    const Finger& finger = fingers_[static_cast<std::size_t>(i)];
    const Pose X_PL = tip_link(finger, X_BL);
    tips.col(i) = X_PL * finger.p_LTip;
    ends.col(i) = X_PL * finger.p_LEnd;
  }
  const Eigen::Index thumb = thumb_of(tips);
  const std::vector<Eigen::Index> others = opposite(thumb, tips);
  if (others.empty()) {
    return std::nullopt;
  }
  Preshape shape{.open = std::move(open),
                 .grip = 0.5 * (ends.col(thumb) + ends(Eigen::all, others).rowwise().mean()),
                 .opposition = tips(Eigen::all, others).rowwise().mean() - tips.col(thumb)};
  shape.opening = shape.opposition.norm();
  if (shape.opening < kLeastOpening) {
    return std::nullopt;
  }
  shape.opposition /= shape.opening;
  shape.row = tips.col(others.back()) - tips.col(others.front());
  shape.row -= shape.row.dot(shape.opposition) * shape.opposition;
  if (shape.row.norm() < 1e-3) {  // one finger against the thumb
    shape.row = shape.opposition.unitOrthogonal();
  }
  shape.row.normalize();
  return shape;
}

// Without principal motion directions: somewhere between the neutral posture, in which fingers
// are as their maker drew them, and any other.
Eigen::VectorXd HandClosing::drawn_posture(sampling::RandomStream& random) const {
  if (has_directions(problem_)) {
    return sampling::map_to_posture(*problem_.basis, random.uniform(problem_.basis->dimension()));
  }
  const Eigen::VectorXd rest = hand_of(problem_.model().neutral());
  const double share = random.uniform();
  return rest + share * (random.uniform(static_cast<int>(rest.size())) - rest);
}

void HandClosing::make_preshapes() {
  constexpr int kPreshapeSamples = 400;
  sampling::RandomStream random(1);
  for (int i = 0; i < kPreshapeSamples; ++i) {
    if (auto shape = preshape(drawn_posture(random))) {
      preshapes_.push_back(std::move(*shape));
    }
  }
  std::ranges::stable_sort(preshapes_, {}, &Preshape::opening);
}

}  // namespace handway::planning
