#include "grasps/hand_closing.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/queries/fingertips.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

using Eigen::Vector3d;

// The tip that is farthest from the middle of all others.
std::size_t thumb_of(const std::vector<Vector3d>& tips) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& tip : tips) {
    sum += tip;
  }
  std::size_t thumb = 0;
  double farthest = -1.0;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const Vector3d others = (sum - tips[i]) / static_cast<double>(tips.size() - 1);
    if (const double distance = (tips[i] - others).norm(); distance > farthest) {
      farthest = distance;
      thumb = i;
    }
  }
  return thumb;
}

}  // namespace

Vector3d nearest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double length = (b - a).squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return a + t * (b - a);
}

using geometric::Pose;
using geometric::RobotModel;

HandClosing::HandClosing(const PlanningProblem& problem, int palm)
    : problem_(problem), palm_(palm) {
  find_fingers();
  make_preshapes();
}

void HandClosing::find_fingers() {
  const RobotModel& model = problem_.model();
  std::map<int, Finger> by_root;  // the palm's child that everything of a finger hangs from
  const auto root_of = [&](int link) {
    while (link >= 0 && model.parent(link) != palm_) {
      link = model.parent(link);
    }
    return link;
  };
  for (std::size_t j = 0; j < problem_.hand.size(); ++j) {
    if (const int root = root_of(model.variable_link(problem_.hand[j])); root >= 0) {
      by_root[root].joints.push_back(static_cast<int>(j));
    }
  }
  for (int link = 0; link < model.link_count(); ++link) {
    if (const auto found = by_root.find(root_of(link)); found != by_root.end()) {
      found->second.links.push_back(link);
    }
  }
  for (auto& [root, finger] : by_root) {
    finger.p_LTip = middle_of(model.link(finger.links.back()));
    fingers_.push_back(std::move(finger));
  }
}

Vector3d HandClosing::tip(const Finger& finger, const Eigen::VectorXd& posture) const {
  const RobotModel& model = problem_.model();
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(with_hand(problem_.start, posture), X_BL);
  return X_BL[static_cast<std::size_t>(palm_)].inverse() *
         (X_BL[static_cast<std::size_t>(finger.links.back())] * finger.p_LTip);
}

std::optional<HandClosing::Preshape> HandClosing::preshape(Eigen::VectorXd open) const {
  constexpr double kLeastOpening = 0.04;  // m
  std::vector<Vector3d> tips;
  tips.reserve(fingers_.size());
  for (const Finger& finger : fingers_) {
    tips.push_back(tip(finger, open));
  }
  if (tips.size() < 2) {
    return std::nullopt;
  }
  const std::size_t thumb = thumb_of(tips);
  const Vector3d p_thumb = tips[thumb];
  tips.erase(tips.begin() + static_cast<std::ptrdiff_t>(thumb));
  Vector3d others = Vector3d::Zero();
  for (const Vector3d& other : tips) {
    others += other / static_cast<double>(tips.size());
  }
  Preshape shape{std::move(open), 0.5 * (p_thumb + others), others - p_thumb, {}, 0.0};
  shape.opening = shape.opposition.norm();
  if (shape.opening < kLeastOpening) {
    return std::nullopt;
  }
  shape.opposition /= shape.opening;
  shape.row = tips.back() - tips.front();
  shape.row -= shape.row.dot(shape.opposition) * shape.opposition;
  if (shape.row.norm() < 1e-3) {  // one finger against the thumb
    shape.row = shape.opposition.unitOrthogonal();
  }
  shape.row.normalize();
  return shape;
}

void HandClosing::make_preshapes() {
  constexpr int kDrawn = 400;
  sampling::RandomStream random(1);
  for (int i = 0; i < kDrawn; ++i) {
    if (auto shape = preshape(sampling::map_to_posture(
            *problem_.basis, random.uniform(problem_.basis->dimension())))) {
      preshapes_.push_back(std::move(*shape));
    }
  }
  std::ranges::stable_sort(preshapes_, std::greater(), &Preshape::opening);
}

Eigen::VectorXd HandClosing::towards(const Finger& finger, const Eigen::VectorXd& posture,
                                     const Vector3d& a, const Vector3d& b) const {
  constexpr double kStep = 1e-3;  // normalised
  const auto distance = [&](const Eigen::VectorXd& at) {
    const Vector3d p = tip(finger, at);
    return (p - nearest_on_segment(p, a, b)).norm();
  };
  const double before = distance(posture);
  Eigen::VectorXd rates(static_cast<Eigen::Index>(finger.joints.size()));
  for (Eigen::Index k = 0; k < rates.size(); ++k) {
    const int joint = finger.joints[static_cast<std::size_t>(k)];
    Eigen::VectorXd moved = posture;
    const double step = moved[joint] < 0.5 ? kStep : -kStep;
    moved[joint] += step;
    rates[k] = (before - distance(moved)) / step;
  }
  const double length = rates.norm();
  return length > 1e-9 ? Eigen::VectorXd(rates / length) : Eigen::VectorXd::Zero(rates.size());
}

Configuration HandClosing::with_hand(Configuration q, const Eigen::VectorXd& posture) const {
  const RobotModel& model = problem_.model();
  for (std::size_t j = 0; j < problem_.hand.size(); ++j) {
    const int v = problem_.hand[j];
    const double share = std::clamp(posture[static_cast<Eigen::Index>(j)], 0.0, 1.0);
    q[v] = std::min(model.lower()[v] + share * (model.upper()[v] - model.lower()[v]),
                    model.upper()[v]);
  }
  return q;
}

Eigen::VectorXd HandClosing::hand_of(const Configuration& q) const {
  return geometric::normalised(problem_.model(), q)(problem_.hand);
}

}  // namespace handway::planning
