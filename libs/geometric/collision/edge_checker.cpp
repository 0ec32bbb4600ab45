#include "handway/geometric/collision/edge_checker.h"

#include <algorithm>
#include <utility>

namespace handway::geometric {
namespace {

// While a pair can move farther than this (m) on a stretch, a cheap bound must do:
// an exact distance would be thrown away with the next halving.
constexpr double kWorthExact = 0.0005;

constexpr std::uint64_t kStopPeriod = 16;  // configurations between looks at the stop condition

}  // namespace

EdgeChecker::EdgeChecker(CollisionChecker& checker, std::shared_ptr<const MotionBound> motion,
                         double resolution)
    : checker_(checker), motion_(std::move(motion)), resolution_(resolution) {}

bool EdgeChecker::is_stopped(std::uint64_t checks) const {
  return stop_ && checks % kStopPeriod == 0 && stop_();
}

EdgeResult EdgeChecker::check(const Configuration& from, const Configuration& to,
                              std::uint64_t most_checks) {
  return search(from, to, most_checks, [&](std::vector<int>& pairs) {
    checker_.near_pairs(0.5 * motion_.most_over_edge() + resolution_, pairs);
    std::ranges::reverse(pairs);  // what stands still comes last in it, and is hit most often
  });
}

EdgeResult EdgeChecker::check_among(std::span<const int> among, const Configuration& from,
                                    const Configuration& to, std::uint64_t most_checks) {
  return search(from, to, most_checks,
                [&](std::vector<int>& pairs) { pairs.assign(among.begin(), among.end()); });
}

EdgeResult EdgeChecker::search(const Configuration& from, const Configuration& to,
                               std::uint64_t most_checks,
                               const std::function<void(std::vector<int>&)>& list_pairs) {
  const Configuration delta = to - from;
  motion_.set_edge(delta);
  EdgeResult result;
  std::vector<int> pairs;
  std::vector<Stretch> level{{0.5, 0.5, 0, 0}};
  while (!level.empty()) {
    std::vector<Stretch> next_level;
    std::vector<int> unsettled;
    for (Stretch& stretch : level) {
      if (result.checks >= most_checks || is_stopped(result.checks)) {
        return result;
      }
      checker_.place(from + stretch.middle * delta);
      motion_.set_middle(checker_.link_poses());
      if (result.checks == 0) {
        list_pairs(pairs);
        std::erase_if(pairs, [&](int pair) { return motion_.over_edge(pair) <= 0.0; });
        stretch.count = pairs.size();
      }
      ++result.checks;
      const std::size_t first = unsettled.size();
      for (std::size_t i = stretch.first; i < stretch.first + stretch.count; ++i) {
        const int pair = pairs[i];
        if (checker_.pair_glance(pair) >= motion_.over_edge(pair) * stretch.half + resolution_) {
          continue;
        }
        const double need = motion_.within(pair, stretch.half);
        const Closeness closeness = closeness_within(pair, need + resolution_);
        if (closeness == Closeness::kFarther) {
          continue;
        }
        if (closeness == Closeness::kTouching || 2.0 * need <= resolution_) {
          result.pair = pair;
          result.at = stretch.middle;
          return result;
        }
        unsettled.push_back(pair);
      }
      const std::size_t count = unsettled.size() - first;
      if (count > 0) {
        const double quarter = 0.5 * stretch.half;
        next_level.push_back({stretch.middle - quarter, quarter, first, count});
        next_level.push_back({stretch.middle + quarter, quarter, first, count});
      }
    }
    level = std::move(next_level);
    pairs = std::move(unsettled);
  }
  result.free = true;
  return result;
}

Closeness EdgeChecker::closeness_within(int pair, double tolerance) {
  if (tolerance <= kWorthExact) {
    return checker_.pair_closeness(pair, tolerance);
  }
  const double bound = checker_.pair_bound(pair, tolerance);
  if (bound >= tolerance) {
    return Closeness::kFarther;
  }
  return bound <= 0.0 && checker_.pair_collides(pair) ? Closeness::kTouching : Closeness::kCloser;
}

NamedPair EdgeChecker::clearance(const Configuration& from, const Configuration& to, double enough,
                                 double tolerance, double share) {
  const Configuration delta = to - from;
  motion_.set_edge(delta);
  NamedPair least = find_clearance(checker_, from, enough);
  if (const NamedPair end = find_clearance(checker_, to, least.distance);
      end.distance < least.distance) {
    least = end;
  }
  double lower = least.distance;  // of what has been settled
  std::vector<std::pair<Stretch, std::vector<int>>> waiting{{{0.5, 0.5, 0, 0}, {}}};
  for (std::uint64_t checks = 0; !waiting.empty(); ++checks) {
    if (is_stopped(checks)) {
      lower = std::min(lower, resolution_);
      break;
    }
    auto [stretch, candidates] = std::move(waiting.back());
    waiting.pop_back();
    checker_.place(from + stretch.middle * delta);
    motion_.set_middle(checker_.link_poses());
    if (checks == 0) {
      checker_.near_pairs(least.distance + 0.5 * motion_.most_over_edge(), candidates);
    }
    std::vector<int> unsettled;
    for (const int pair : candidates) {
      const double most = motion_.over_edge(pair) * stretch.half;
      if (checker_.pair_glance(pair) >= least.distance + most) {
        continue;
      }
      const double loss = motion_.within(pair, stretch.half);
      const double distance = loss > kWorthExact
                                  ? checker_.pair_bound(pair, least.distance + loss)
                                  : checker_.pair_distance(pair, least.distance + loss);
      if (loss <= kWorthExact && distance < least.distance) {
        const BodyPair& bodies = checker_.world().pairs()[static_cast<std::size_t>(pair)];
        least = {checker_.world().body(bodies.a).name, checker_.world().body(bodies.b).name,
                 distance};
      }
      if (distance - loss >= least.distance - std::max(tolerance, share * least.distance)) {
        lower = std::min(lower, distance - loss);
      } else {
        unsettled.push_back(pair);
      }
    }
    if (!unsettled.empty()) {
      const double quarter = 0.5 * stretch.half;
      waiting.emplace_back(Stretch{stretch.middle + quarter, quarter, 0, 0}, unsettled);
      waiting.emplace_back(Stretch{stretch.middle - quarter, quarter, 0, 0}, std::move(unsettled));
    }
  }
  least.distance = std::max(0.0, std::min(lower, least.distance));
  return least;
}

}  // namespace handway::geometric
