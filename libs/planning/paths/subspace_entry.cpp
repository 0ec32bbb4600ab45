#include "paths/subspace_entry.h"

#include <array>
#include <utility>

namespace handway::planning {
namespace {

using Point = Objective::Point;

constexpr int kTrials = 30;           // postures beside one that collides
constexpr double kLargestStep = 1.0;  // to those, in half-sides of the subspace's box
constexpr int kBisections = 3;
constexpr double kInside = 0.02;  // a hand nearer to the subspace needs no entry
constexpr int kEntries = 3;       // tried at each place
constexpr std::array<double, 4> kRetreats = {0.0, 0.05, 0.12, 0.25};  // normalised joints
constexpr std::uint64_t kMostChecks = 60;                             // of one motion

// As near to `at` as bisection finds, on the line to `at` moved by `step`.
Point nearest_free(PlanningContext& context, const Objective& objective, const Point& at,
                   const Eigen::VectorXd& step, Point free) {
  double colliding = 0.0;
  double reached = 1.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (colliding + reached);
    Point nearer = objective.moved_along_subspace(at, middle * step);
    if (context.validator().collision(nearer.q)) {
      colliding = middle;
    } else {
      reached = middle;
      free = std::move(nearer);
    }
  }
  return free;
}

}  // namespace

std::optional<Point> free_in_subspace(PlanningContext& context, const Objective& objective,
                                      const Point& at, sampling::RandomStream& draw) {
  Point closest = objective.towards_subspace(at, 1.0);
  if (!context.validator().collision(closest.q)) {
    return closest;
  }
  for (int trial = 0; trial < kTrials; ++trial) {
    const double size = kLargestStep * (trial + 1.0) / kTrials;
    const Eigen::VectorXd step =
        size * (2.0 * draw.uniform(objective.subspace_dimension()).array() - 1.0);
    Point point = objective.moved_along_subspace(closest, step);
    if (!context.validator().collision(point.q)) {
      return nearest_free(context, objective, closest, step, std::move(point));
    }
  }
  return std::nullopt;
}

std::optional<std::vector<Configuration>> subspace_entry(PlanningContext& context,
                                                         const Objective& objective,
                                                         const Configuration& end,
                                                         const Configuration& other,
                                                         sampling::RandomStream& draw) {
  const Point at = objective.point(end);
  if (at.distance() < kInside) {
    return std::vector<Configuration>{end};
  }
  Configuration back = end;
  back(context.problem().arm) = other(context.problem().arm);
  const double length = objective.point(back).distance_to(at);
  for (const double retreat : kRetreats) {
    if (retreat > length) {
      break;
    }
    const Configuration from = retreat == 0.0 ? end : end + retreat / length * (back - end);
    if (retreat > 0.0 && (context.validator().collision(from) ||
                          !context.validator().edge_free(end, from, kMostChecks))) {
      break;
    }
    for (int entry = 0; entry < kEntries; ++entry) {
      const auto inside = free_in_subspace(context, objective, objective.point(from), draw);
      if (inside && context.validator().edge_plausible(from, inside->q, 3) &&
          context.validator().edge_free(from, inside->q, kMostChecks)) {
        return retreat > 0.0 ? std::vector<Configuration>{end, from, inside->q}
                             : std::vector<Configuration>{end, inside->q};
      }
    }
  }
  return std::nullopt;
}

}  // namespace handway::planning
