#include "handway/planning/paths/path_optimizer.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace handway::planning {
namespace {

using Point = Objective::Point;

constexpr double kWorthwhile = 1e-3;  // share of the cost that a replacement has to save
constexpr double kWaypoint = 5e-3;    // and for each waypoint that it adds; robots slow down there
constexpr std::size_t kManyWaypoints = 16;  // a path of more is pruned before all else
constexpr double kSame = 1e-6;              // points of a path nearer than this are one
constexpr double kRemovals = 0.3;     // share of waypoints that are taken out instead of moved
constexpr double kLargestMove = 0.2;  // move of a waypoint
constexpr double kSmallestMove = 0.005;
constexpr double kLookSpacing = 0.1;  // configurations checked before certification
constexpr int kRound = 64;            // replacements that are drawn before the best is tried

// For smooth_result().
constexpr std::uint64_t kWaypoints = 16;  // waypoints per number of checks
constexpr double kDistance = 0.01;        // distance of the hand from the subspace per round
constexpr double kDetour = 1.5;           // least detour for more rounds, as long as …
constexpr double kShorter = 0.95;         // … each brings the cost to this share or less

Point between(const Point& from, const Point& to, double share) {
  return {from.q + share * (to.q - from.q), from.joints + share * (to.joints - from.joints),
          from.outside + share * (to.outside - from.outside)};
}

}  // namespace

PathOptimizer::PathOptimizer(PlanningContext& context, const ObjectiveWeights& weights,
                             const Path& path, std::uint64_t seed, int patience)
    : context_(context),
      objective_(context.problem(), weights),
      planned_(context.problem().planned_joints()),
      draw_(seed),
      patience_(patience) {
  std::vector<Point> points;
  std::ranges::transform(path.waypoints, std::back_inserter(points),
                         [&](const Configuration& q) { return objective_.point(q); });
  set_points(std::move(points));
}

Path PathOptimizer::path() const {
  Path path;
  std::ranges::transform(points_, std::back_inserter(path.waypoints), &Point::q);
  path.waypoints = context_.problem().model().in_half_turns(path.waypoints);
  return path;
}

double PathOptimizer::avoidable_distance() const {
  if (!has_subspace() || sum_.length <= 0.0) {
    return 0.0;
  }
  const double forced = objective_.forced_outside(points_.front(), points_.back());
  return (sum_.outside - forced) / sum_.length;
}

double PathOptimizer::detour() const {
  return sum_.length / points_.front().distance_to(points_.back());
}

double PathOptimizer::cost() const { return objective_.cost(sum_); }

bool PathOptimizer::converged() const { return fruitless_ >= patience_; }

std::uint64_t PathOptimizer::spent() const {
  return context_.statistics().checks() + objective_.distance_queries();
}

std::uint64_t PathOptimizer::checks_left() const {
  return last_check_ - std::min(last_check_, spent());
}

bool PathOptimizer::is_over() const {
  return checks_left() == 0 || context_.interruption().has_value();
}

void PathOptimizer::set_points(std::vector<Point> points) {
  points_ = std::move(points);
  is_needed_.assign(points_.size(), false);
  motions_.clear();
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    motions_.push_back(objective_.measure(points_[i], points_[i + 1]));
  }
  add_up();
}

// Sums are recomputed: differences would accumulate rounding errors.
void PathOptimizer::add_up() {
  sum_ = {};
  for (const MotionSums& motion : motions_) {
    sum_.add(motion);
  }
}

bool PathOptimizer::has_subspace() const {
  return context_.problem().basis && objective_.weights().human_likeness > 0.0;
}

// They are as expensive as checks.
bool PathOptimizer::measures_distances() const { return objective_.weights().clearance > 0.0; }

void PathOptimizer::advance(std::uint64_t checks) {
  if (points_.size() < 2) {
    return;
  }
  last_check_ = spent() + checks;
  if (!begun_) {
    begun_ = true;
    if (points_.size() > kManyWaypoints) {
      prune(0, points_.size() - 1);
    }
    if (measures_distances()) {
      shorten(checks / 2);
    }
  }
  while (!is_over() && !converged()) {
    replace_at_random();
  }
}

// Costs are cheap and collision checks expensive: of many replacements the one that saves most is
// tried first.
void PathOptimizer::replace_at_random() {
  const int size = measures_distances() ? 1 : kRound;
  std::vector<Replacement> round;
  for (int i = 0; i < size; ++i) {
    if (std::optional<Replacement> drawn = draw_replacement()) {
      round.push_back(std::move(*drawn));
    }
  }
  std::ranges::stable_sort(round, {}, &Replacement::cost);
  for (const Replacement& replacement : round) {
    if (is_over()) {
      return;  // the round says nothing of what could be gained
    }
    if (apply(replacement)) {
      fruitless_ = 0;
      return;
    }
  }
  fruitless_ += size;
}

// Distances along a long path would use up all checks.
void PathOptimizer::shorten(std::uint64_t checks) {
  PathOptimizer shortest(context_, {}, path(), draw_.fork(1).seed(), patience_);
  shortest.advance(checks);
  std::vector<Point> known = points_;
  const double before = cost();
  set_points(std::move(shortest.points_));
  if (cost() > before) {
    set_points(std::move(known));
  }
}

// Replaces the path between two waypoints by the straight motion, or else the parts between each of
// them and the middle one.
void PathOptimizer::prune(std::size_t first, std::size_t last) {
  if (last - first < 2 || is_over()) {
    return;
  }
  const auto straight = replacement(at_waypoint(first), at_waypoint(last), {});
  if (straight && apply(*straight)) {
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  prune(middle, last);  // before waypoints in front of it go
  prune(first, middle);
}

PathOptimizer::Place PathOptimizer::at_waypoint(std::size_t waypoint) const {
  const std::size_t edge = std::min(waypoint, points_.size() - 2);
  return {edge, points_[waypoint]};
}

PathOptimizer::Place PathOptimizer::place_at(double length_before) const {
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const double length = motions_[i].length;
    if (length_before < length) {
      return {i, between(points_[i], points_[i + 1], length_before / length)};
    }
    length_before -= length;
  }
  return at_waypoint(points_.size() - 1);
}

std::optional<PathOptimizer::Replacement> PathOptimizer::draw_replacement() {
  constexpr double kMoves = 0.3;  // share of waypoints moved among all replacements
  if (points_.size() > 2 && draw_.uniform() < kMoves) {
    return draw_waypoint_move();
  }
  const double whole = sum_.length;
  const double a = draw_.uniform() * whole;
  const double b = draw_.uniform() * whole;
  const Place from = place_at(std::min(a, b));
  const Place to = place_at(std::max(a, b));
  return replacement(from, to, draw_inner(from, to));
}

// Draws the inner points of an alternative stretch, without its ends.
std::vector<Objective::Point> PathOptimizer::draw_inner(const Place& from, const Place& to) {
  constexpr double kHandLaterOrSooner = 0.15;
  const PlanningProblem& problem = context_.problem();
  if (has_subspace() && draw_.uniform() < kHandLaterOrSooner) {
    return {draw_.uniform() < 0.5 ? objective_.with_hand(from.point, to.point)
                                  : objective_.with_hand(to.point, from.point)};
  }
  const double kind = draw_.uniform();
  if (kind < 0.4) {
    return {};
  }
  std::vector<Point> inner(points_.begin() + static_cast<std::ptrdiff_t>(from.edge) + 1,
                           points_.begin() + static_cast<std::ptrdiff_t>(to.edge) + 1);
  if (has_subspace() && kind < 0.7) {
    const double share = draw_.uniform() < 0.5 ? 1.0 : draw_.uniform();
    inner.insert(inner.begin(), from.point);
    inner.push_back(to.point);
    // Half of the trials are beside the closest posture: that one may collide.
    const double size = draw_.uniform() < 0.5 ? 0.0 : kLargestMove * draw_.uniform();
    const Eigen::VectorXd step =
        size * (2.0 * draw_.uniform(objective_.subspace_dimension()).array() - 1.0);
    for (Point& point : inner) {
      point = objective_.moved_along_subspace(objective_.towards_subspace(point, share), step);
    }
    return inner;
  }
  // A straight motion of some joints; the others move as before.
  std::vector<int> joints = draw_.uniform() < 0.5 ? problem.joints.arm : problem.joints.hand;
  if (joints.empty() || draw_.uniform() < 0.5) {
    const std::size_t count = planned_.size();
    const auto drawn = static_cast<std::size_t>(draw_.uniform() * static_cast<double>(count));
    joints = {planned_[std::min(count - 1, drawn)]};
  }
  double whole = 0.0;
  std::vector<double> at;
  const Point* before = &from.point;
  for (const Point& point : inner) {
    whole += before->distance_to(point);
    at.push_back(whole);
    before = &point;
  }
  whole += before->distance_to(to.point);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    Eigen::VectorXd moved = inner[i].joints;
    const double share = at[i] / std::max(whole, kSame);
    for (const int joint : joints) {
      const double begin = from.point.joints[joint];
      moved[joint] = begin + share * (to.point.joints[joint] - begin);
    }
    inner[i] = objective_.point_of_joints(std::move(moved));
  }
  return inner;
}

std::optional<PathOptimizer::Replacement> PathOptimizer::draw_waypoint_move() {
  const auto count = static_cast<double>(points_.size() - 2);
  const auto waypoint =
      1 + std::min(points_.size() - 3, static_cast<std::size_t>(draw_.uniform() * count));
  const Place before = at_waypoint(waypoint - 1);
  const Place after = at_waypoint(waypoint + 1);
  if (draw_.uniform() < kRemovals) {
    return is_needed_[waypoint] ? std::nullopt : replacement(before, after, {});
  }
  const PlanningProblem& problem = context_.problem();
  const double size = kSmallestMove * std::pow(kLargestMove / kSmallestMove, draw_.uniform());
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(problem.model().variable_count());
  direction(planned_) = (2.0 * draw_.uniform(static_cast<int>(planned_.size()))).array() - 1.0;
  const double part = draw_.uniform();
  if (has_subspace() && part < 0.3) {
    const Point& point = points_[waypoint];
    const Eigen::VectorXd step =
        size * (2.0 * draw_.uniform(objective_.subspace_dimension()).array() - 1.0);
    return replacement(
        before, after,
        {objective_.moved_along_subspace(objective_.towards_subspace(point, 1.0), step)});
  }
  if (part < 0.5 && !problem.joints.hand.empty()) {
    direction(problem.joints.hand).setZero();
  } else if (part < 0.7 && !problem.joints.arm.empty()) {
    direction(problem.joints.arm).setZero();
  }
  Eigen::VectorXd joints = geometric::clamped_to_range(
      problem.model(), points_[waypoint].joints + size * direction.normalized());
  return replacement(before, after, {objective_.point_of_joints(std::move(joints))});
}

// The stretch between two places of the path as `inner`, if that costs less. Most do not, so the
// copy comes after the comparison.
std::optional<PathOptimizer::Replacement> PathOptimizer::replacement(
    const Place& from, const Place& to, const std::vector<Point>& inner) {
  const std::size_t last = to.edge + 1;
  std::vector<const Point*> chain{&points_[from.edge]};
  chain.reserve(inner.size() + 4);
  const auto append = [&chain](const Point& point) {
    if (chain.back()->distance_to(point) > kSame) {
      chain.push_back(&point);
    }
  };
  append(from.point);
  const std::size_t first_changed = chain.size() - 1;
  std::ranges::for_each(inner, append);
  append(to.point);
  const std::size_t last_changed = chain.size() - 1;
  append(points_[last]);
  if (last_changed == first_changed) {
    return std::nullopt;
  }
  MotionSums sum = sum_;
  for (std::size_t i = from.edge; i < last; ++i) {
    sum.add(motions_[i], -1.0);
  }
  const double added =
      static_cast<double>(chain.size() - 1) - static_cast<double>(last - from.edge);
  const auto is_worthwhile = [&](const MotionSums& path) {
    return objective_.cost(path) + kWaypoint * added * cost() <= (1.0 - kWorthwhile) * cost();
  };
  MotionSums at_best = sum;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    at_best.length += chain[i]->distance_to(*chain[i + 1]);
  }
  if (!is_worthwhile(at_best)) {
    return std::nullopt;
  }
  std::vector<MotionSums> motions;
  motions.reserve(chain.size() - 1);
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    motions.push_back(objective_.measure(*chain[i], *chain[i + 1]));
    sum.add(motions.back());
  }
  if (!is_worthwhile(sum)) {
    return std::nullopt;
  }
  Replacement made{from.edge,
                   last,
                   {},
                   first_changed,
                   last_changed,
                   std::move(motions),
                   objective_.cost(sum) + kWaypoint * added * cost()};
  made.chain.reserve(chain.size());
  std::ranges::transform(chain, std::back_inserter(made.chain),
                         [](const Point* point) { return *point; });
  return made;
}

// Makes it part of the path if it is free.
bool PathOptimizer::apply(const Replacement& made) {
  const auto at = [](auto& list, std::size_t i) {
    return list.begin() + static_cast<std::ptrdiff_t>(i);
  };
  if (!all_free(made.changed())) {
    if (made.is_removal()) {
      is_needed_[made.first + 1] = true;
    }
    return false;
  }
  points_.erase(at(points_, made.first + 1), at(points_, made.last));
  points_.insert(at(points_, made.first + 1), made.chain.begin() + 1, made.chain.end() - 1);
  motions_.erase(at(motions_, made.first), at(motions_, made.last));
  motions_.insert(at(motions_, made.first), made.motions.begin(), made.motions.end());
  is_needed_.erase(at(is_needed_, made.first + 1), at(is_needed_, made.last));
  is_needed_.insert(at(is_needed_, made.first + 1), made.chain.size() - 2, false);
  is_needed_[made.first] = false;  // it has another neighbour now
  is_needed_[made.first + made.chain.size() - 1] = false;
  add_up();
  return true;
}

// Cheap checks of the whole stretch come before expensive ones of a part of it.
bool PathOptimizer::all_free(std::span<const Point> points) {
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    if (context_.validator().collision(points[i].q)) {
      return false;
    }
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const int looks = static_cast<int>(points[i].distance_to(points[i + 1]) / kLookSpacing);
    if (!context_.validator().edge_plausible(points[i].q, points[i + 1].q, looks)) {
      return false;
    }
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (is_over() || !context_.validator().edge_free(points[i].q, points[i + 1].q, checks_left())) {
      return false;
    }
  }
  return true;
}

void smooth_result(PlanningContext& context, const ObjectiveSettings& objective, int checks,
                   const Path& found, PlanResult& result, int most_rounds) {
  const PhaseClock smoothing_time(result.smoothing_s);
  const PlanningProblem& problem = context.problem();
  const ObjectiveWeights weights = objective.weights(problem);
  PathOptimizer optimizer(context, weights,
                          {problem.model().unwrapped(found.waypoints, problem.start)},
                          context.request().seed);
  const std::uint64_t parts = (found.waypoints.size() + kWaypoints - 1) / kWaypoints;
  const std::uint64_t round = parts * static_cast<std::uint64_t>(checks);
  const bool adapts = most_rounds > 1;
  optimizer.advance(adapts && weights == ObjectiveWeights{} ? round / 2 : round);
  if (adapts) {
    const double more = std::round(optimizer.avoidable_distance() / kDistance);
    optimizer.set_patience(PathOptimizer::kThorough);
    optimizer.advance(round * static_cast<std::uint64_t>(std::clamp(more, 0.0, most_rounds - 1.0)));
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0;
         i < most_rounds && optimizer.detour() > kDetour && optimizer.cost() <= kShorter * before;
         ++i) {
      before = optimizer.cost();
      optimizer.advance(round);
    }
  }
  result.path = optimizer.path();
}

}  // namespace handway::planning
