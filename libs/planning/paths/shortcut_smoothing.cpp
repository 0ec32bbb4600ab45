#include "handway/planning/paths/shortcut_smoothing.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/paths/roadmap_smoothing.h"
#include "handway/sampling/sequences/random_stream.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

constexpr double kPart = 0.05;        // of the trapezium rule
constexpr double kWorthwhile = 1e-3;  // share of the length that a shortcut has to save
constexpr int kFruitless = 20;        // shortcuts in a row that end the search for more

Eigen::VectorXd posture(const PlanningProblem& problem, const Configuration& q) {
  return geometric::normalised(problem.model(), q)(problem.hand);
}

/// Where a way along a path leads to.
struct PathPoint {
  std::size_t edge = 0;
  Configuration q;
};

PathPoint point_at(const PlanningProblem& problem, const Path& path, double way) {
  for (std::size_t i = 0; i + 1 < path.waypoints.size(); ++i) {
    const Configuration& from = path.waypoints[i];
    const Configuration& to = path.waypoints[i + 1];
    const double length = normalised_distance(problem.model(), from, to);
    if (way < length) {
      return {i, from + (way / length) * (to - from)};
    }
    way -= length;
  }
  return {path.waypoints.size() - 2, path.waypoints.back()};
}

}  // namespace

PathMeasure measure(const PlanningProblem& problem, const sampling::PostureSubspace& subspace,
                    const Path& path) {
  PathMeasure measure;
  for (std::size_t i = 0; i + 1 < path.waypoints.size(); ++i) {
    const double length =
        normalised_distance(problem.model(), path.waypoints[i], path.waypoints[i + 1]);
    const Eigen::VectorXd from = posture(problem, path.waypoints[i]);
    const Eigen::VectorXd to = posture(problem, path.waypoints[i + 1]);
    const int parts = std::max(1, static_cast<int>(std::ceil(length / kPart)));
    double sum = 0.0;
    for (int k = 0; k <= parts; ++k) {
      const double weight = k == 0 || k == parts ? 0.5 : 1.0;
      sum += weight * subspace.distance(from + (static_cast<double>(k) / parts) * (to - from));
    }
    measure.length += length;
    measure.outside += length * sum / parts;
  }
  return measure;
}

ShortcutSmoothing::ShortcutSmoothing(PlanningContext& context, const sampling::PmdBasis& basis,
                                     std::uint64_t checks, std::uint64_t seed)
    : context_(context),
      subspace_(basis),
      last_check_(context.statistics().checks() + checks),
      seed_(seed) {}

std::uint64_t ShortcutSmoothing::checks_left() const {
  const std::uint64_t now = context_.statistics().checks();
  return last_check_ - std::min(last_check_, now);
}

bool ShortcutSmoothing::is_over() const {
  return checks_left() == 0 || context_.interruption().has_value();
}

bool ShortcutSmoothing::improves(const Path& candidate, const Path& path) const {
  const PathMeasure before = measure(context_.problem(), subspace_, path);
  const PathMeasure after = measure(context_.problem(), subspace_, candidate);
  const bool shorter = after.length <= before.length;
  return shorter && after.outside <= before.outside + 1e-9;
}

Path ShortcutSmoothing::smooth(const Path& path) {
  Path smooth = path;
  if (is_over()) {
    return smooth;
  }
  if (Path shortest = smooth_by_roadmap(context_, path, checks_left()); improves(shortest, path)) {
    smooth = std::move(shortest);
  }
  cut_corners(smooth);
  project_postures(smooth);
  return smooth;
}

void ShortcutSmoothing::cut_corners(Path& path) {
  const PlanningProblem& problem = context_.problem();
  sampling::RandomStream draw(seed_);
  for (int fruitless = 0; fruitless < kFruitless && path.waypoints.size() > 2 && !is_over();
       ++fruitless) {
    const double length = measure(problem, subspace_, path).length;
    const double first = draw.uniform() * length;
    const double second = draw.uniform() * length;
    const PathPoint a = point_at(problem, path, std::min(first, second));
    const PathPoint b = point_at(problem, path, std::max(first, second));
    Path candidate;
    const auto at = [&](std::size_t i) {
      return path.waypoints.begin() + static_cast<std::ptrdiff_t>(i);
    };
    candidate.waypoints.assign(path.waypoints.begin(), at(a.edge + 1));
    candidate.waypoints.push_back(a.q);
    candidate.waypoints.push_back(b.q);
    candidate.waypoints.insert(candidate.waypoints.end(), at(b.edge + 1), path.waypoints.end());
    const bool worthwhile = a.edge != b.edge && measure(problem, subspace_, candidate).length <
                                                    (1.0 - kWorthwhile) * length;
    if (worthwhile && improves(candidate, path) && context_.edge_free(a.q, b.q, checks_left())) {
      path = std::move(candidate);
      fruitless = -1;
    }
  }
}

void ShortcutSmoothing::project_postures(Path& path) {
  const PlanningProblem& problem = context_.problem();
  const geometric::RobotModel& model = problem.model();
  for (std::size_t i = 1; i + 1 < path.waypoints.size() && !is_over(); ++i) {
    Eigen::VectorXd joints = geometric::normalised(model, path.waypoints[i]);
    joints(problem.hand) = subspace_.closest(joints(problem.hand));
    Path candidate = path;
    Configuration& q = candidate.waypoints[i];
    q = geometric::denormalised(model, joints);
    const bool better =
        improves(candidate, path) &&
        measure(problem, subspace_, candidate).outside < measure(problem, subspace_, path).outside;
    if (better && !context_.collision(q) &&
        context_.edge_free(path.waypoints[i - 1], q, checks_left()) &&
        context_.edge_free(q, path.waypoints[i + 1], checks_left())) {
      path = std::move(candidate);
    }
  }
}

}  // namespace handway::planning
