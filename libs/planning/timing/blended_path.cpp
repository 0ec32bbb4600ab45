#include "handway/planning/timing/blended_path.h"

#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/paths/path_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace handway::planning {
namespace {

using geometric::Configuration;

constexpr double kSamePlace = 1e-12;   // rad or m: shorter edges are none
constexpr double kSameLine = 1e-6;     // rad or m: waypoints so near to a line are on it
constexpr double kStraightOn = 1e-9;   // rad: a smaller turn is no corner
constexpr double kTurnsBack = 1e-6;    // rad short of turning back: no room for an arc
constexpr double kLeastLength = 1e-9;  // rad or m: shorter arcs are corners

/// A straight part of the path from corner to corner, and the waypoints that it passes.
struct Edge {
  Configuration from;
  Configuration direction;
  double length;
  std::size_t end;                                          ///< Waypoint.
  std::vector<std::pair<std::size_t, double>> passed = {};  ///< Passed waypoints, with their
                                                            ///< places.
  double offset = 0.0;  ///< Their largest offset from the line, rad or m.
};

// Extends `edge` to a waypoint if that is straight ahead, and all passed waypoints stay on the
// line.
bool prolong(const Path& path, std::size_t waypoint, Edge& edge) {
  const Configuration& corner = path.waypoints[edge.end];
  const Configuration& to = path.waypoints[waypoint];
  const double length = (to - edge.from).norm();
  const Configuration direction = (to - edge.from) / std::max(length, kSamePlace);
  // Turning the line about its beginning moves farther points by more.
  const Configuration to_corner = corner - edge.from;
  const double offset = edge.offset + (to_corner - to_corner.dot(direction) * direction).norm();
  if (!(offset <= kSameLine) || length < edge.length + 0.5 * (to - corner).norm()) {
    return false;
  }
  edge.passed.emplace_back(edge.end, edge.length);
  edge.direction = direction;
  edge.length = length;
  edge.end = waypoint;
  edge.offset = offset;
  return true;
}

std::vector<Edge> edges_of(const Path& path) {
  std::vector<Edge> edges;
  const Configuration* last = &path.waypoints.front();
  for (std::size_t w = 1; w < path.waypoints.size(); ++w) {
    const Configuration delta = path.waypoints[w] - *last;
    if (delta.norm() <= kSamePlace) {
      continue;
    }
    if (edges.empty() || !prolong(path, w, edges.back())) {
      edges.push_back({*last, delta.normalized(), delta.norm(), w});
    }
    last = &path.waypoints[w];
  }
  return edges;
}

/// Rounding of the corner between two edges.
struct Corner {
  double cut = 0.0;  ///< Length of either edge that the arc takes.
  double angle = 0.0;
  double deviation = 0.0;
  bool stop = false;
};

// Distance of an arc of this shape from its waypoint, per length of the edges that it takes.
double deviation_by_cut(ArcShape shape, double angle) {
  // (1 - cos h) / sin h = tan(h / 2); x³ - x⁴/2 is 3/32 in the middle, and |u - t| = 2 sin h.
  return shape == ArcShape::kCircular ? std::tan(0.25 * angle) : 0.375 * std::sin(0.5 * angle);
}

Corner corner_between(const Edge& in, const Edge& out, double deviation, ArcShape shape) {
  Corner corner;
  // The angle of two unit vectors, exact for small ones too.
  corner.angle = 2.0 * std::atan2((in.direction - out.direction).norm(),
                                  (in.direction + out.direction).norm());
  if (corner.angle < kStraightOn) {
    return corner;
  }
  const double half = 0.5 * corner.angle;
  const double rate = deviation_by_cut(shape, corner.angle);
  corner.cut = std::min({0.5 * in.length, 0.5 * out.length, deviation / rate});
  corner.deviation = corner.cut * rate;
  const double radius = corner.cut / std::tan(half);
  if (corner.angle > std::numbers::pi - kTurnsBack || radius * corner.angle < kLeastLength) {
    corner.cut = 0.0;
    corner.deviation = 0.0;
    corner.stop = true;
  }
  return corner;
}

}  // namespace

Configuration PathPiece::derivative(int order, double s) const {
  if (is_arc() && !is_smooth_arc()) {
    const double angle = s / radius;
    const double half = std::sin(0.5 * angle);
    switch (order) {
      case 0:
        return origin + (radius * std::sin(angle)) * tangent +
               (2.0 * radius * half * half) * normal;
      case 1:
        return std::cos(angle) * tangent + std::sin(angle) * normal;
      case 2:
        return (std::cos(angle) * normal - std::sin(angle) * tangent) / radius;
      default:
        return -(std::cos(angle) * tangent + std::sin(angle) * normal) / (radius * radius);
    }
  }
  Configuration along = Configuration::Zero(tangent.size());
  if (order < 2) {
    along = order == 0 ? Configuration(origin + s * tangent) : tangent;
  }
  if (!is_smooth_arc()) {
    return along;
  }
  const double x = s / length;
  const std::array turned{length * x * x * x * (1.0 - 0.5 * x), x * x * (3.0 - 2.0 * x),
                          6.0 * x * (1.0 - x) / length, (6.0 - 12.0 * x) / (length * length)};
  return along + turned.at(static_cast<std::size_t>(order)) * turn;
}

Configuration PathPiece::fastest() const {
  if (is_smooth_arc()) {
    return tangent.cwiseAbs().cwiseMax((tangent + turn).cwiseAbs());
  }
  return (tangent.cwiseAbs2() + normal.cwiseAbs2()).cwiseSqrt();
}

BlendedPath::BlendedPath(const Path& path, const std::vector<double>& deviations, ArcShape shape)
    : polyline_(path),
      deviations_(path.waypoints.size(), 0.0),
      passages_(path.waypoints.size(), 0.0) {
  if (path.empty() || deviations.size() != path.waypoints.size()) {
    throw std::invalid_argument("a path needs a waypoint, and every waypoint a deviation");
  }
  for (std::size_t w = 0; w < path.waypoints.size(); ++w) {
    if (path.waypoints[w].size() != path.waypoints.front().size() ||
        !path.waypoints[w].allFinite() || !std::isfinite(deviations[w]) || deviations[w] < 0.0) {
      throw std::invalid_argument("waypoints of one size and finite numbers are needed");
    }
  }
  const std::vector<Edge> edges = edges_of(path);
  double begin = 0.0;  // of what an arc left of the edge
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Edge& edge = edges[e];
    const bool last = e + 1 == edges.size();
    const Corner corner =
        last ? Corner{} : corner_between(edge, edges[e + 1], deviations[edge.end], shape);
    const double straight = edge.length - begin - corner.cut;
    const Configuration zeros = Configuration::Zero(edge.direction.size());
    for (const auto& [waypoint, along] : edge.passed) {
      passages_[waypoint] = length() + std::clamp(along - begin, 0.0, std::max(straight, 0.0));
    }
    if (straight > kLeastLength || corner.stop || last) {
      pieces_.push_back({length(),
                         std::max(straight, 0.0),
                         0.0,
                         edge.from + begin * edge.direction,
                         edge.direction,
                         zeros,
                         {},
                         edge.end,
                         corner.stop || last});
    }
    begin = corner.cut;
    passages_[edge.end] = length();
    if (corner.cut > 0.0) {
      const Configuration& out = edges[e + 1].direction;
      const double radius = corner.cut / std::tan(0.5 * corner.angle);
      const Configuration normal = (out - out.dot(edge.direction) * edge.direction).normalized();
      const bool smooth = shape == ArcShape::kSmooth;
      const double arc = smooth ? 2.0 * corner.cut : radius * corner.angle;
      pieces_.push_back({length(), arc, smooth ? arc / corner.angle : radius,
                         edge.from + (edge.length - corner.cut) * edge.direction, edge.direction,
                         smooth ? zeros : normal,
                         smooth ? Configuration(out - edge.direction) : Configuration(), edge.end,
                         false});
      deviations_[edge.end] = corner.deviation;
      passages_[edge.end] += 0.5 * arc;
    }
  }
  // Waypoints in the same place as the one before are passed with it.
  std::partial_sum(passages_.begin(), passages_.end(), passages_.begin(),
                   [](double before, double own) { return std::max(before, own); });
}

const PathPiece& BlendedPath::piece_at(double s) const {
  const auto next = std::ranges::upper_bound(pieces_, s, {}, &PathPiece::begin);
  return next == pieces_.begin() ? *next : *std::prev(next);
}

namespace {

constexpr double kLeastDeviation = 1e-4;  // rad or m: smaller arcs save no time
constexpr double kLeastAdvance = 0.05;    // share of an arc's clearance that has to be spare

void check_waypoints(const PlanningProblem& problem, const Path& path) {
  const geometric::RobotModel& model = problem.model();
  const geometric::JointIndices& fixed = problem.joints.fixed;
  if (path.empty()) {
    throw geometric::InputError({"the path", "", "no waypoints", "at least one", ""});
  }
  for (std::size_t w = 0; w < path.waypoints.size(); ++w) {
    geometric::require_configuration(model, path.waypoints[w], fmt::format("waypoint {}", w + 1),
                                     fixed);
    const std::string jump =
        w > 0 ? turn_fault(model, path.waypoints[w - 1], path.waypoints[w]) : "";
    if (!jump.empty()) {
      throw geometric::InputError({fmt::format("waypoint {}", w + 1), "", jump,
                                   "turns of at most half a turn from one waypoint to the next",
                                   "Unwrap the path's angles, or add waypoints between"});
    }
  }
}

// Largest advance along the rest of an arc that uses at most `spare` at `rate`.
double advance_in(double rest, double spare, double rate) {
  return rate * rest <= spare ? rest : spare / rate;
}

/// Checks an arc by conservative advancement: from a configuration with some clearance it is
/// followed as far as no pair can have come closer than the arcs' clearance, and no constraint be
/// violated.
bool is_free(const PathPiece& arc, const geometric::MotionBound& motion,
             geometric::CollisionChecker& checker, const BlendOptions& options) {
  const double clearance = options.arc_clearance;
  const Eigen::Index pairs = motion.pair_motions();
  const Eigen::VectorXd rates = motion.bounds(arc.fastest());
  const double rate = pairs == 0 ? 0.0 : rates.head(pairs).maxCoeff();
  const auto& constraints = checker.world().constraints();
  for (double s = 0.0; s < arc.length;) {
    geometric::end_if_stopped(options.stop);
    const geometric::NamedPair closest =
        geometric::find_clearance(checker, arc.derivative(0, s), kFarClearance + clearance);
    const double spare = closest.distance - clearance;
    if (spare < kLeastAdvance * clearance) {
      return false;
    }
    double advance = advance_in(arc.length - s, spare, rate);
    for (std::size_t c = 0; c < constraints.size(); ++c) {
      const double slack = constraints[c].slack(checker.link_poses());
      if (slack < kLeastAdvance * clearance) {
        return false;
      }
      advance = std::min(
          advance, advance_in(arc.length - s, slack, rates[pairs + static_cast<Eigen::Index>(c)]));
    }
    s += advance;
  }
  return true;
}

}  // namespace

BlendResult certified_blends(const PlanningProblem& problem, const Path& path,
                             const BlendOptions& options) {
  check_waypoints(problem, path);
  BlendResult result;
  const auto conflict = PathConflictSearch(problem, options.resolution).run(path.waypoints, [&] {
    return options.stop.stop_requested();
  });
  geometric::end_if_stopped(options.stop);
  if (conflict) {
    const std::size_t first = conflict->waypoint + 1;
    result.fault = conflict->share > 0.0 ? fmt::format("{} between waypoints {} and {}.",
                                                       conflict->text, first, first + 1)
                                         : fmt::format("{} at waypoint {}.", conflict->text, first);
    return result;
  }
  const std::unique_ptr<geometric::CollisionChecker> checker = problem.checker->clone();
  std::vector<double> deviations(path.waypoints.size(), options.deviation);
  std::vector<bool> certain(path.waypoints.size(), false);
  std::vector<bool> smaller(path.waypoints.size(), false);
  BlendedPath blended(path, deviations, options.shape);
  // An arc depends on its own deviation alone: free arcs stay free.
  for (bool changed = true; changed;) {
    changed = false;
    for (const PathPiece& piece : blended.pieces()) {
      if (!piece.is_arc() || certain[piece.waypoint]) {
        continue;
      }
      if (is_free(piece, *problem.motion, *checker, options)) {
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
