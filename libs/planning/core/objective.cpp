#include "handway/planning/core/objective.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/core/plan_result.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

// The weights of presets. That of human-likeness is for a length in multiples of the straight
// motion's from start to goal: lowering the hand's mean distance by 0.05 may lengthen the path by
// about that motion.
constexpr double kHumanLikenessWeight = 21.0;
constexpr double kShortMotion = 0.25;  // a shorter one counts as this
constexpr double kClearanceWeight = 4.0;
constexpr double kDurationWeight = 1.0;
constexpr double kTieBreak = 0.01;  // weight of length, if it is not the objective

constexpr double kClearanceSpacing = 0.05;  // between distance queries of a cost
constexpr double kQualitySpacing = 0.02;    // between those of path_quality(), and its postures
constexpr double kEndSlope = 0.5;           // slope of an end's stretch, see path_quality()

// Distance from obstacles, m, at most kFarClearance. Fingers of one hand are always near each
// other.
double clearance_at(geometric::CollisionChecker& checker, const Configuration& q) {
  const geometric::CollisionWorld& world = checker.world();
  checker.place(q);
  std::vector<int> near;
  checker.near_pairs_closest_first(kFarClearance, near);
  double least = kFarClearance;
  for (const int pair : near) {
    if (!world.constraint(pair) &&
        !world.is_self_pair(world.pairs()[static_cast<std::size_t>(pair)])) {
      least = std::min(least, checker.pair_distance(pair, least));
    }
  }
  return std::max(least, 0.0);
}

// The mean of |a + t (b - a)| over t in [0, 1], by Simpson's rule on four parts.
double mean_norm(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  constexpr std::array<double, 9> kWeights = {1, 4, 2, 4, 2, 4, 2, 4, 1};
  const double aa = a.squaredNorm();
  const double ab = a.dot(b);
  const double bb = b.squaredNorm();
  double sum = 0.0;
  for (std::size_t i = 0; i < kWeights.size(); ++i) {
    const double t = static_cast<double>(i) / 8.0;
    const double squared = (1 - t) * (1 - t) * aa + 2 * t * (1 - t) * ab + t * t * bb;
    sum += kWeights.at(i) * std::sqrt(std::max(0.0, squared));
  }
  return sum / 24.0;
}

/// A property at places along a path, with the length of the path for each place.
class Profile {
 public:
  void add(double value, double length) {
    values_.push_back(value);
    lengths_.push_back(length);
  }

  [[nodiscard]] double mean() const {
    double sum = 0.0;
    double length = 0.0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      sum += values_[i] * lengths_[i];
      length += lengths_[i];
    }
    return length > 0.0 ? sum / length : values_.front();
  }
  [[nodiscard]] double least() const { return *std::ranges::min_element(values_); }
  [[nodiscard]] double largest() const { return *std::ranges::max_element(values_); }

  /// Removes the stretches at both ends on which values fall towards the middle, by `slope` at
  /// least.
  [[nodiscard]] Profile without_ends(double slope) const {
    std::size_t first = 0;
    std::size_t last = values_.size() - 1;
    while (first < last && values_[first] - values_[first + 1] > slope * lengths_[first + 1]) {
      ++first;
    }
    while (last > first && values_[last] - values_[last - 1] > slope * lengths_[last - 1]) {
      --last;
    }
    Profile middle;
    for (std::size_t i = first; i <= last; ++i) {
      middle.add(values_[i], lengths_[i]);
    }
    return middle;
  }

  /// Length whose value is above `bound`.
  [[nodiscard]] double length_above(double bound) const {
    double length = 0.0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      length += values_[i] > bound ? lengths_[i] : 0.0;
    }
    return length;
  }

 private:
  std::vector<double> values_;
  std::vector<double> lengths_;
};

// The Mahalanobis distance of a posture's coordinates along the principal directions.
double recorded_distance(const sampling::PmdBasis& basis, const Eigen::VectorXd& posture) {
  const Eigen::VectorXd e = sampling::project(basis, posture);
  auto axis = static_cast<Eigen::Index>(basis.free_joints.size());
  double squared = 0.0;
  for (const sampling::PrincipalDirection& direction : basis.directions) {
    squared += direction.variance > 0.0 ? e[axis] * e[axis] / direction.variance : 0.0;
    ++axis;
  }
  return std::sqrt(squared);
}

double straight(const PlanningProblem& problem) {
  return std::max(kShortMotion, normalised_distance(problem.model(), problem.start, problem.goal));
}

}  // namespace

ObjectiveWeights ObjectiveSettings::weights(const PlanningProblem& problem) const {
  switch (static_cast<ObjectivePreset>(preset)) {
    case ObjectivePreset::kHumanLike:
      return {.human_likeness = problem.basis ? kHumanLikenessWeight * straight(problem) : 0.0};
    case ObjectivePreset::kSafest:
      return {.clearance = kClearanceWeight};
    case ObjectivePreset::kFastest:
      return {.length = kTieBreak, .duration = kDurationWeight};
    case ObjectivePreset::kCustom:
      return custom;
    default:
      return {};
  }
}

double least_duration(const geometric::RobotModel& model, const Configuration& from,
                      const Configuration& to) {
  double longest = 0.0;
  for (int v = 0; v < model.variable_count(); ++v) {
    const double limit = model.variable(v).limits.velocity;
    const double velocity = std::isfinite(limit) && limit > 0.0 ? limit : kDefaultVelocity;
    longest = std::max(longest, std::abs(to[v] - from[v]) / velocity);
  }
  return longest;
}

Objective::Objective(const PlanningProblem& problem, const ObjectiveWeights& weights)
    : problem_(problem), weights_(weights) {
  if (problem.basis) {
    subspace_.emplace(*problem.basis);
    axes_ =
        sampling::axes_of(*problem.basis) * sampling::half_sides_of(*problem.basis).asDiagonal();
  }
  if (weights.clearance > 0.0) {
    checker_ = problem.checker->clone();
  }
}

Objective::Point Objective::point_at(Configuration q, Eigen::VectorXd joints) const {
  Eigen::VectorXd outside;
  if (subspace_) {
    outside = subspace_->outside(joints(problem_.joints.hand));
  }
  return {std::move(q), std::move(joints), std::move(outside)};
}

Objective::Point Objective::point(const Configuration& q) const {
  return point_at(q, geometric::normalised(problem_.model(), q));
}

Objective::Point Objective::point_of_joints(Eigen::VectorXd joints) const {
  Configuration q = geometric::denormalised(problem_.model(), joints);
  return point_at(std::move(q), std::move(joints));
}

MotionSums& MotionSums::add(const MotionSums& other, double times) {
  length += times * other.length;
  outside += times * other.outside;
  missing_clearance += times * other.missing_clearance;
  duration += times * other.duration;
  return *this;
}

MotionSums Objective::measure(const Point& from, const Point& to) {
  MotionSums sums;
  sums.length = from.distance_to(to);
  if (subspace_ && weights_.human_likeness > 0.0) {
    sums.outside = sums.length * mean_norm(from.outside, to.outside);
  }
  if (weights_.duration > 0.0) {
    sums.duration = least_duration(problem_.model(), from.q, to.q);
  }
  if (checker_) {
    sums.missing_clearance = sums.length * missing_clearance(from, to, sums.length);
  }
  return sums;
}

double Objective::cost(const MotionSums& path) const {
  const double means =
      weights_.human_likeness * path.outside + weights_.clearance * path.missing_clearance;
  return weights_.length * path.length + (path.length > 0.0 ? means / path.length : 0.0) +
         weights_.duration * path.duration;
}

// 0: kFarClearance or more everywhere, 1: in contact; the mean along the motion.
double Objective::missing_clearance(const Point& from, const Point& to, double length) {
  const int parts = std::max(1, static_cast<int>(std::ceil(length / kClearanceSpacing)));
  double sum = 0.0;
  for (int i = 0; i < parts; ++i) {
    const Configuration q = from.q + (i + 0.5) / parts * (to.q - from.q);
    sum += 1.0 - clearance_at(*checker_, q) / kFarClearance;
  }
  distance_queries_ += static_cast<std::uint64_t>(parts);
  return sum / parts;
}

double Objective::cost(const Path& path) {
  MotionSums sums;
  for (std::size_t i = 0; i + 1 < path.waypoints.size(); ++i) {
    sums.add(measure(point(path.waypoints[i]), point(path.waypoints[i + 1])));
  }
  return cost(sums);
}

Objective::Point Objective::towards_subspace(const Point& at, double share) const {
  Eigen::VectorXd joints = at.joints;
  const Eigen::VectorXd hand = at.joints(problem_.joints.hand);
  joints(problem_.joints.hand) = hand + share * (subspace_->closest(hand) - hand);
  return point_of_joints(std::move(joints));
}

Objective::Point Objective::moved_along_subspace(const Point& at,
                                                 const Eigen::VectorXd& step) const {
  Eigen::VectorXd joints = at.joints;
  joints(problem_.joints.hand) =
      (at.joints(problem_.joints.hand) + axes_ * step).cwiseMax(0.0).cwiseMin(1.0).eval();
  return point_of_joints(std::move(joints));
}

Objective::Point Objective::with_hand(const Point& at, const Point& hand) const {
  Point point = at;
  point.q(problem_.joints.hand) = hand.q(problem_.joints.hand);
  point.joints(problem_.joints.hand) = hand.joints(problem_.joints.hand);
  point.outside = hand.outside;
  return point;
}

double Objective::forced_outside(const Point& start, const Point& goal) {
  return 0.5 * (start.outside.squaredNorm() + goal.outside.squaredNorm());
}

double Objective::least_cost(const Configuration& start, const Configuration& goal) const {
  const Configuration to = problem_.model().nearest_equivalent(start, goal);
  const Point from = point(start);
  const Point end = point(to);
  double length = from.distance_to(end);
  const double outside = subspace_ ? weights_.human_likeness * forced_outside(from, end) : 0.0;
  if (weights_.length > 0.0) {
    length = std::max(length, std::sqrt(outside / weights_.length));
  }
  const double mean = weights_.length > 0.0 && length > 0.0 ? outside / length : 0.0;
  return weights_.length * length + mean +
         weights_.duration * least_duration(problem_.model(), start, to);
}

PathQuality path_quality(const PlanningProblem& problem, const Path& path) {
  if (path.empty()) {
    throw std::invalid_argument("a path without waypoints has no properties");
  }
  Objective objective(problem, {});
  const std::unique_ptr<geometric::CollisionChecker> checker = problem.checker->clone();
  Profile clearance;
  Profile distance;
  Profile mahalanobis;
  const auto look = [&](const Objective::Point& at, double length) {
    clearance.add(clearance_at(*checker, at.q), length);
    if (problem.basis) {
      distance.add(at.distance(), length);
      mahalanobis.add(recorded_distance(*problem.basis, at.joints(problem.joints.hand)), length);
    }
  };
  PathQuality quality;
  std::vector<Objective::Point> waypoints;
  std::ranges::transform(path.waypoints, std::back_inserter(waypoints),
                         [&](const Configuration& q) { return objective.point(q); });
  double before = 0.0;  // half of what the last place stands for
  for (std::size_t w = 0; w + 1 < waypoints.size(); ++w) {
    const Objective::Point& from = waypoints[w];
    const Objective::Point& to = waypoints[w + 1];
    const double length = (to.joints - from.joints).norm();
    const int parts = std::max(1, static_cast<int>(std::ceil(length / kQualitySpacing)));
    for (int i = 0; i < parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      look(objective.point(from.q + share * (to.q - from.q)),
           i == 0 ? before + 0.5 * length / parts : length / parts);
    }
    before = 0.5 * length / parts;
    quality.length += length;
    quality.duration += least_duration(problem.model(), from.q, to.q);
  }
  look(waypoints.back(), before);
  quality.least_clearance = clearance.least();
  quality.mean_clearance = clearance.mean();
  if (problem.basis) {
    const Profile middle = distance.without_ends(kEndSlope);
    const double whole = std::max(quality.length, 1e-12);
    quality.human_likeness = {
        .mean = distance.mean(),
        .largest = middle.largest(),
        .share_beyond = middle.length_above(kNearSubspace) / whole,
        .forced = Objective::forced_outside(waypoints.front(), waypoints.back()) / whole,
        .mahalanobis_mean = mahalanobis.mean(),
        .mahalanobis_largest = mahalanobis.largest()};
  }
  return quality;
}

}  // namespace handway::planning
