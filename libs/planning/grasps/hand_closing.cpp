#include "grasps/hand_closing.h"

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace handway::planning {
namespace {

// The middle between the tip that is farthest from all others, the thumb's, and those; and
// how wide the hand is open there, less how far the others are apart.
std::pair<Eigen::Vector3d, double> opposition(const std::vector<Eigen::Vector3d>& tips) {
  std::pair<Eigen::Vector3d, double> best{Eigen::Vector3d::Zero(), -1.0};
  for (std::size_t thumb = 0; thumb < tips.size() && tips.size() > 1; ++thumb) {
    Eigen::Vector3d others = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < tips.size(); ++i) {
      others += i == thumb ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : tips[i];
    }
    others /= static_cast<double>(tips.size() - 1);
    double spread = 0.0;
    for (std::size_t i = 0; i < tips.size(); ++i) {
      spread = std::max(spread, i == thumb ? 0.0 : (tips[i] - others).norm());
    }
    const double opening = (tips[thumb] - others).norm() - spread;
    if (opening > best.second) {
      best = {0.5 * (tips[thumb] + others), opening};
    }
  }
  return best;
}

}  // namespace

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
    const geometric::TriangleMesh tip = geometric::collision_mesh(model.link(finger.links.back()));
    if (!tip.vertices.empty()) {
      finger.p_LTip = geometric::bounding_box(tip).centre();
    }
    fingers_.push_back(std::move(finger));
  }
}

std::vector<Eigen::Vector3d> HandClosing::tips(const Eigen::VectorXd& posture) const {
  const RobotModel& model = problem_.model();
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(with_hand(problem_.start, posture), X_BL);
  const Pose X_PB = X_BL[static_cast<std::size_t>(palm_)].inverse();
  std::vector<Eigen::Vector3d> points;
  for (const Finger& finger : fingers_) {
    points.emplace_back(X_PB * X_BL[static_cast<std::size_t>(finger.links.back())] * finger.p_LTip);
  }
  return points;
}

// Of all that are drawn from the hand's box, those with a thumb farthest from fingers that
// stay together.
void HandClosing::make_preshapes() {
  constexpr int kDrawn = 1000;
  constexpr std::size_t kKept = 40;
  sampling::RandomStream random(1);
  std::vector<std::pair<double, Preshape>> drawn;
  for (int i = 0; i < kDrawn; ++i) {
    Preshape shape;
    shape.open =
        sampling::map_to_posture(*problem_.basis, random.uniform(problem_.basis->dimension()));
    const std::vector<Eigen::Vector3d> points = tips(shape.open);
    const auto [grip, opening] = opposition(points);
    shape.grip = grip;
    drawn.emplace_back(opening, std::move(shape));
  }
  std::ranges::stable_sort(drawn, std::greater(), &std::pair<double, Preshape>::first);
  drawn.resize(std::min(drawn.size(), kKept));
  for (auto& [opening, shape] : drawn) {
    shape.closing = closing_of(shape);
    preshapes_.push_back(std::move(shape));
  }
}

// Every finger down the gradient of its tip's distance from the grip.
Eigen::VectorXd HandClosing::closing_of(const Preshape& shape) const {
  constexpr double kStep = 1e-3;   // normalised
  constexpr double kStroke = 1.2;  // of a finger's joints together, normalised
  Eigen::VectorXd closing = Eigen::VectorXd::Zero(shape.open.size());
  const std::vector<Eigen::Vector3d> before = tips(shape.open);
  for (std::size_t f = 0; f < fingers_.size(); ++f) {
    for (const int joint : fingers_[f].joints) {
      Eigen::VectorXd moved = shape.open;
      const double step = moved[joint] < 0.5 ? kStep : -kStep;
      moved[joint] += step;
      closing[joint] =
          ((before[f] - shape.grip).norm() - (tips(moved)[f] - shape.grip).norm()) / step;
    }
    if (const double length = closing(fingers_[f].joints).norm(); length > 0.0) {
      closing(fingers_[f].joints) *= kStroke / length;
    }
  }
  return closing;
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
