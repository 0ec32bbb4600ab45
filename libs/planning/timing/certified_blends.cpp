#include "handway/planning/timing/certified_blends.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/paths/path_conflict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace handway::planning {
namespace {

constexpr double kLeastDeviation = 1e-4;  // rad or m: smaller arcs save no time
constexpr double kLeastAdvance = 0.05;    // of an arc's clearance: what has to be spare
constexpr double kLimitTolerance = 1e-6;  // rad or m

void check_waypoints(const geometric::RobotModel& model, const Path& path) {
  if (path.empty()) {
    throw geometric::InputError({"the path", "", "no waypoints", "at least one", ""});
  }
  for (std::size_t w = 0; w < path.waypoints.size(); ++w) {
    const Configuration& q = path.waypoints[w];
    const std::string source = fmt::format("waypoint {}", w + 1);
    if (q.size() != model.variable_count()) {
      throw geometric::InputError({source, "", fmt::format("{} values", q.size()),
                                   fmt::format("{}, one a joint", model.variable_count()), ""});
    }
    for (int v = 0; v < model.variable_count(); ++v) {
      const geometric::JointLimits& limits = model.variable(v).limits;
      if (!(q[v] >= limits.lower - kLimitTolerance && q[v] <= limits.upper + kLimitTolerance)) {
        throw geometric::InputError(
            {source, "joint " + model.variable(v).name, fmt::format("{:.6g}", q[v]),
             fmt::format("{:.6g} to {:.6g}", limits.lower, limits.upper), ""});
      }
    }
  }
}

class Blends {
 public:
  Blends(const PlanningProblem& problem, const BlendOptions& options)
      : motion_(problem.motion),
        checker_(problem.checker->clone()),
        arc_clearance_(options.arc_clearance) {}

  /// Conservative advancement: from a configuration with some clearance the arc is
  /// followed as far as no pair can have come closer than allowed, and no constraint be violated.
  bool is_free(const PathPiece& arc) {
    const Eigen::Index pairs = motion_->pair_motions();
    const Eigen::VectorXd rates = motion_->bounds(arc.fastest());
    const double rate = pairs == 0 ? 0.0 : rates.head(pairs).maxCoeff();
    for (double s = 0.0; s < arc.length;) {
      const geometric::NamedPair closest =
          geometric::find_clearance(*checker_, arc.position(s), kFarClearance + arc_clearance_);
      const double spare = closest.distance - arc_clearance_;
      if (spare < kLeastAdvance * arc_clearance_) {
        return false;
      }
      double advance = advance_in(arc.length - s, spare, rate);
      const auto& constraints = checker_->world().constraints();
      for (std::size_t c = 0; c < constraints.size(); ++c) {
        const double slack = constraints[c].slack(checker_->link_poses());
        if (slack < kLeastAdvance * arc_clearance_) {
          return false;
        }
        advance = std::min(advance, advance_in(arc.length - s, slack,
                                               rates[pairs + static_cast<Eigen::Index>(c)]));
      }
      s += advance;
    }
    return true;
  }

 private:
  // How far along the rest of an arc what changes at `rate` can't spend what is spare.
  static double advance_in(double rest, double spare, double rate) {
    return rate * rest <= spare ? rest : spare / rate;
  }

  std::shared_ptr<const geometric::MotionBound> motion_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
  double arc_clearance_;
};

}  // namespace

BlendResult certified_blends(const PlanningProblem& problem, const Path& path,
                             const BlendOptions& options) {
  check_waypoints(problem.model(), path);
  BlendResult result;
  if (const auto conflict = PathConflictSearch(problem, options.resolution).run(path.waypoints)) {
    const std::size_t first = conflict->waypoint + 1;
    result.fault = conflict->share > 0.0 ? fmt::format("{} between waypoints {} and {}.",
                                                       conflict->text, first, first + 1)
                                         : fmt::format("{} at waypoint {}.", conflict->text, first);
    return result;
  }
  Blends blends(problem, options);
  std::vector<double> deviations(path.waypoints.size(), options.deviation);
  std::vector<bool> certain(path.waypoints.size(), false);
  std::vector<bool> smaller(path.waypoints.size(), false);
  BlendedPath blended(path, deviations, options.shape);
  // An arc depends on its own deviation alone: what is free once stays free.
  for (bool changed = true; changed;) {
    changed = false;
    for (const PathPiece& piece : blended.pieces()) {
      if (!piece.is_arc() || certain[piece.waypoint]) {
        continue;
      }
      if (blends.is_free(piece)) {
        certain[piece.waypoint] = true;
        continue;
      }
      const double half = 0.5 * blended.deviations()[piece.waypoint];
      deviations[piece.waypoint] = half < kLeastDeviation ? 0.0 : half;
      smaller[piece.waypoint] = true;
      changed = true;
    }
    if (changed) {
      blended = BlendedPath(path, deviations, options.shape);
    }
  }
  for (const PathPiece& piece : blended.pieces()) {
    result.arcs += piece.is_arc() ? 1 : 0;
    result.stops += piece.ends_in_corner ? 1 : 0;
  }
  result.stops -= blended.pieces().empty() ? 0 : 1;  // the end is none
  result.reduced = static_cast<int>(std::ranges::count(smaller, true));
  result.largest_deviation = *std::ranges::max_element(blended.deviations());
  result.path = std::move(blended);
  return result;
}

}  // namespace handway::planning
