#include "handway/planning/queries/human_likeness.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace handway::planning {
namespace {

constexpr double kStep = 0.01;  // normalised joints

void add(double distance, double weight, DistanceAlong& sum) {
  sum.mean += weight * distance;
  sum.largest = std::max(sum.largest, distance);
}

}  // namespace

HumanLikeness::HumanLikeness(const geometric::RobotModel& model, std::vector<int> hand,
                             const sampling::PmdBasis& basis,
                             std::shared_ptr<const sampling::RecordedPostures> postures)
    : model_(model), hand_(std::move(hand)), subspace_(basis), postures_(std::move(postures)) {
  if (hand_.size() != basis.joints.size()) {
    throw std::invalid_argument("a hand needs a variable for every joint of its basis");
  }
}

HandLikeness HumanLikeness::at(const Configuration& q) const {
  const Eigen::VectorXd posture = geometric::normalised(model_, q)(hand_);
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
  PathLikeness result;
  double weights = 0.0;
  const auto look = [&](const Configuration& q, double weight) {
    const HandLikeness here = likeness.at(q);
    weights += weight;
    add(here.to_subspace, weight, result.to_subspace);
    if (here.to_recorded) {
      result.to_recorded = result.to_recorded.value_or(DistanceAlong());
      add(*here.to_recorded, weight, *result.to_recorded);
    }
  };
  for (std::size_t w = 0; w + 1 < path.waypoints.size(); ++w) {
    const Configuration& from = path.waypoints[w];
    const Configuration& to = path.waypoints[w + 1];
    const double piece = normalised_distance(model, from, to);
    const int steps = std::max(1, static_cast<int>(std::ceil(piece / kStep)));
    for (int s = 0; s <= steps; ++s) {
      const double weight = (s == 0 || s == steps ? 0.5 : 1.0) * piece / steps;
      look(from + (static_cast<double>(s) / steps) * (to - from), weight);
    }
  }
  if (weights == 0.0) {
    look(path.waypoints.front(), 1.0);
  }
  result.to_subspace.mean /= weights;
  if (result.to_recorded) {
    result.to_recorded->mean /= weights;
  }
  return result;
}

}  // namespace handway::planning
