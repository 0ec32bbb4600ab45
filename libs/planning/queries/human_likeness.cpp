#include "handway/planning/queries/human_likeness.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace handway::planning {
namespace {

constexpr double kStep = 0.01;  // normalised joints

// Takes a distance at points with weights.
class Average {
 public:
  void add(double distance, double weight) {
    sum_ += weight * distance;
    weight_ += weight;
    largest_ = std::max(largest_, distance);
  }
  [[nodiscard]] DistanceAlong result() const { return {sum_ / weight_, largest_}; }

 private:
  double sum_ = 0.0;
  double weight_ = 0.0;
  double largest_ = 0.0;
};

}  // namespace

HumanLikeness::HumanLikeness(const geometric::RobotModel& model, std::vector<int> hand,
                             const sampling::PmdBasis& basis,
                             std::shared_ptr<const sampling::RecordedPostures> postures)
    : model_(model), hand_(std::move(hand)), subspace_(basis), postures_(std::move(postures)) {
  if (hand_.size() != basis.joints.size()) {
    throw std::invalid_argument("a hand needs a variable for every joint of its basis");
  }
}

Eigen::VectorXd HumanLikeness::hand_posture(const Configuration& q) const {
  return geometric::normalised(model_, q)(hand_);
}

HandLikeness HumanLikeness::at(const Configuration& q) const {
  const Eigen::VectorXd posture = hand_posture(q);
  HandLikeness result{subspace_.distance(posture), std::nullopt};
  if (postures_) {
    result.to_recorded = postures_->nearest(posture).distance;
  }
  return result;
}

std::optional<Configuration> HumanLikeness::nearest_recorded(const Configuration& q) const {
  if (!postures_) {
    return std::nullopt;
  }
  Configuration p = geometric::normalised(model_, q);
  p(hand_) = postures_->nearest(p(hand_)).joints;
  return geometric::denormalised(model_, p);
}

PathLikeness path_likeness(const geometric::RobotModel& model, const HumanLikeness& likeness,
                           const Path& path) {
  if (path.empty()) {
    throw std::invalid_argument("a path without waypoints has no hand to look at");
  }
  Average to_subspace;
  Average to_recorded;
  bool has_recorded = false;
  const auto look = [&](const Configuration& q, double weight) {
    const HandLikeness here = likeness.at(q);
    to_subspace.add(here.to_subspace, weight);
    if (here.to_recorded) {
      to_recorded.add(*here.to_recorded, weight);
      has_recorded = true;
    }
  };
  double length = 0.0;
  for (std::size_t w = 0; w + 1 < path.waypoints.size(); ++w) {
    const Configuration& from = path.waypoints[w];
    const Configuration& to = path.waypoints[w + 1];
    const double piece = normalised_distance(model, from, to);
    const int steps = std::max(1, static_cast<int>(std::ceil(piece / kStep)));
    for (int s = 0; s <= steps; ++s) {
      const double weight = (s == 0 || s == steps ? 0.5 : 1.0) * piece / steps;
      look(from + (static_cast<double>(s) / steps) * (to - from), weight);
    }
    length += piece;
  }
  if (length == 0.0) {
    look(path.waypoints.front(), 1.0);
  }
  PathLikeness result{to_subspace.result(), std::nullopt};
  if (has_recorded) {
    result.to_recorded = to_recorded.result();
  }
  return result;
}

}  // namespace handway::planning
