#include "handway/geometric/collision/continuous/continuous_collision_checker.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace handway::geometric {
namespace {

// While a pair can move farther than this (m) on a stretch, a cheap bound is used: the next halving
// would make an exact distance useless.
constexpr double kWorthExact = 0.0005;

// Likely gain of a distance query over the bound of enclosing spheres, as a share of the bodies'
// size. A pair that needs more waits for shorter stretches.
constexpr double kLikelyGain = 0.4;

constexpr int kLooks = 4;  // on each edge, for a distance that is hardly above the least one
constexpr double kSphereError = 0.002;  // m: what a bound of spheres may lack

constexpr double kShy = 1.0 - 1e-6;  // share of a tolerance: the rest is for rounding

// Growth of a pair's resolution, and of its margin, per distance moved from an end.
constexpr double kGrowth = 0.01;
constexpr double kMarginGrowth = 0.02;

// Constraints are checked after the pairs.
void add_constraints(const CollisionWorld& world, PairIndices& pairs) {
  for (int check = static_cast<int>(world.pairs().size()); check < world.check_count(); ++check) {
    pairs.push_back(check);
  }
}

constexpr std::uint64_t kStopPeriod = 16;  // configurations between looks at the stop condition

// The distance between the robot's own links is given by its design.
bool keeps_margin(const CollisionChecker& checker, int pair) {
  const CollisionWorld& world = checker.world();
  return !world.constraint(pair) &&
         !world.is_self_pair(world.pairs()[static_cast<std::size_t>(pair)]);
}

}  // namespace

const EdgeEnd::NearPair* EdgeEnd::nearest() const {
  const auto nearest = std::ranges::min_element(near, {}, &NearPair::distance);
  return nearest == near.end() ? nullptr : &*nearest;
}

double EdgeEnd::resolution(double elsewhere) const {
  const NearPair* pair = nearest();
  return pair ? std::clamp(pair->resolution(), kLeastResolution, elsewhere) : elsewhere;
}

EdgeEnd make_edge_end(CollisionChecker& checker, const Configuration& q, double resolution,
                      double margin) {
  EdgeEnd end{q, {}};
  checker.place(q);
  const double near = 2.0 * resolution;
  const double near_in_margin = margin > 0.0 ? margin + 4.0 * resolution : near;
  PairIndices pairs;
  checker.near_pairs(near_in_margin, pairs);
  add_constraints(checker.world(), pairs);
  for (const int pair : pairs) {
    const double within = keeps_margin(checker, pair) ? near_in_margin : near;
    if (const double distance = checker.pair_distance(pair, within); distance < within) {
      end.near.push_back({pair, distance});
    }
  }
  return end;
}

ContinuousCollisionChecker::ContinuousCollisionChecker(CollisionChecker& checker,
                                                       std::shared_ptr<const MotionBound> motion,
                                                       double resolution)
    : checker_(checker), bounds_(motion), motion_(std::move(motion)), resolution_(resolution) {}

void ContinuousCollisionChecker::set_ends(std::vector<EdgeEnd> ends) {
  ends_ = std::move(ends);
  std::erase_if(ends_, [](const EdgeEnd& end) { return end.near.empty(); });
}

double ContinuousCollisionChecker::far_from_ends(int pair) const {
  return margin_ > resolution_ && keeps_margin(checker_, pair) ? margin_ : resolution_;
}

double ContinuousCollisionChecker::required(int pair, const Configuration& middle,
                                            double motion) const {
  double required = far_from_ends(pair);
  const double growth = required > resolution_ ? kMarginGrowth : kGrowth;
  for (const EdgeEnd& end : ends_) {
    for (const EdgeEnd::NearPair& near : end.near) {
      if (near.pair == pair) {
        const double to_middle = bounds_->bound(
            pair, checker_.world().model().turns().difference(end.q, middle).cwiseAbs());
        required = std::min(required, near.resolution() + growth * (to_middle + motion));
      }
    }
  }
  return kept_ * std::max(required, kLeastResolution);
}

std::optional<int> ContinuousCollisionChecker::too_near(const Configuration& q) {
  if (margin_ <= 0.0) {
    return std::nullopt;
  }
  checker_.place(q);
  PairIndices pairs;
  checker_.near_pairs(margin_, pairs);
  const Eigen::VectorXd everything = Eigen::VectorXd::Ones(q.size());
  const auto too_near = std::ranges::find_if(pairs, [&](int pair) {
    return keeps_margin(checker_, pair) && bounds_->bound(pair, everything) > 0.0 &&
           checker_.pair_is_nearer_than(pair, required(pair, q, 0.0));
  });
  return too_near == pairs.end() ? std::nullopt : std::optional(*too_near);
}

bool ContinuousCollisionChecker::is_stopped(std::uint64_t checks) const {
  return stop_ && checks % kStopPeriod == 0 && stop_();
}

EdgeResult ContinuousCollisionChecker::check(const Configuration& from, const Configuration& to,
                                             std::uint64_t most_checks) {
  return search(from, to, most_checks, [&](PairIndices& pairs) {
    checker_.near_pairs(0.5 * motion_.most_over_edge() + std::max(resolution_, margin_), pairs);
    add_constraints(checker_.world(), pairs);
    std::ranges::reverse(pairs);  // what stands still comes last in it, and is hit most often
  });
}

EdgeResult ContinuousCollisionChecker::check_among(std::span<const int> among,
                                                   const Configuration& from,
                                                   const Configuration& to,
                                                   std::uint64_t most_checks) {
  return search(from, to, most_checks,
                [&](PairIndices& pairs) { pairs.assign(among.begin(), among.end()); });
}

EdgeResult ContinuousCollisionChecker::search(const Configuration& from, const Configuration& to,
                                              std::uint64_t most_checks,
                                              const std::function<void(PairIndices&)>& list_pairs) {
  const Configuration delta = to - from;
  motion_.set_edge(delta);
  EdgeResult result;
  PairIndices pairs;
  std::vector<Stretch> level{{0.5, 0.5, 0, 0}};
  while (!level.empty()) {
    std::vector<Stretch> next_level;
    PairIndices unsettled;
    for (Stretch& stretch : level) {
      if (result.checks >= most_checks || is_stopped(result.checks)) {
        return result;
      }
      const Configuration middle = from + stretch.middle * delta;
      checker_.place(middle);
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
        const double motion = motion_.over_edge(pair) * stretch.half;
        const double quick = checker_.pair_quick_bound(pair);
        if (quick >= motion + far_from_ends(pair)) {
          continue;
        }
        const double need = motion_.within(pair, stretch.half);
        const double keep = required(pair, middle, motion);
        const Proximity proximity = is_out_of_reach(pair, need, quick)
                                        ? proximity_of_spheres(pair, quick)
                                        : proximity_within(pair, stretch.half, need, keep);
        if (proximity == Proximity::kClear) {
          continue;
        }
        if (proximity == Proximity::kCollision ||
            2.0 * need <= std::min(keep, kept_ * resolution_)) {
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

bool ContinuousCollisionChecker::is_out_of_reach(int pair, double distance, double quick) const {
  const MotionBound::PairFrame& frame = bounds_->pair_frame(pair);
  const double size =
      bounds_->ball(frame.a).radius + (frame.b_moves ? bounds_->ball(frame.b).radius : 0.0);
  return distance > quick + kLikelyGain * size;
}

Proximity ContinuousCollisionChecker::proximity_of_spheres(int pair, double quick) {
  return quick <= 0.0 && checker_.pair_collides(pair) ? Proximity::kCollision
                                                      : Proximity::kWithinTolerance;
}

Proximity ContinuousCollisionChecker::proximity_within(int pair, double half, double need,
                                                       double required) {
  const double tolerance = need + required;
  if (need + std::min(required, resolution_) <= kWorthExact) {
    const Proximity proximity = checker_.pair_proximity(pair, tolerance);
    return proximity == Proximity::kWithinTolerance &&
                   bound_along(pair, half, required, kWorthExact) >= required
               ? Proximity::kClear
               : proximity;
  }
  const double bound = checker_.pair_bound(pair, tolerance);
  if (bound >= tolerance || bound_along(pair, half, required, bound) >= required) {
    return Proximity::kClear;
  }
  return bound <= 0.0 && checker_.pair_collides(pair) ? Proximity::kCollision
                                                      : Proximity::kWithinTolerance;
}

double ContinuousCollisionChecker::bound_along(int pair, double half, double enough,
                                               double likely) {
  const PairMotion motion = motion_.pair_motion(pair);
  const double bend = 0.5 * half * half * (motion.a.bend + motion.b.bend);
  return enough + bend > likely ? 0.0 : checker_.pair_bound_along(pair, motion, half, enough);
}

struct ContinuousCollisionChecker::Clearance {
  double tolerance;  ///< m, or …
  double share;      ///< … of the least distance: tolerance of the answer.
  double at_most;    ///< m: a distance found so far, or the limit requested.
  double at_least;   ///< m, of all pairs settled so far.
  std::optional<int> pair = std::nullopt;

  /// Half of the answer's tolerance below the least distance: motion takes the other half.
  [[nodiscard]] double share_of_distances() const { return 0.5 * share; }

  /// m: larger distances are of no interest.
  [[nodiscard]] double good_enough() const {
    return at_most - kShy * std::max(tolerance, share * at_most);
  }

  /// @returns whether a pair that may come closer by `loss` (m) is settled.
  [[nodiscard]] bool settle(int index, const DistanceRange& distance, double loss) {
    if (distance.upper < at_most) {
      at_most = distance.upper;
      pair = index;
    }
    const bool settled = distance.lower >= good_enough() + loss;
    at_least = settled ? std::min(at_least, distance.lower - loss) : at_least;
    return settled;
  }
};

NamedPair ContinuousCollisionChecker::clearance(std::span<const Configuration> waypoints,
                                                double enough, double tolerance, double share) {
  Clearance found{tolerance, share, enough, enough};
  for (const Configuration& q : waypoints) {
    look_at(q, found);
  }
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    for (int look = 0; look < kLooks; ++look) {
      look_at(waypoints[i] + (look + 0.5) / kLooks * (waypoints[i + 1] - waypoints[i]), found);
    }
  }
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    look_along(waypoints[i], waypoints[i + 1], found);
  }
  const double least = std::max(0.0, std::min(found.at_least, found.at_most));
  return found.pair ? named_pair(checker_.world(), *found.pair, least) : NamedPair{"", "", least};
}

void ContinuousCollisionChecker::look_at(const Configuration& q, Clearance& found) {
  checker_.place(q);
  PairIndices near;
  checker_.near_pairs_closest_first(found.at_most, near);
  for (const int pair : near) {
    static_cast<void>(found.settle(
        pair, checker_.pair_distance_range(pair, found.at_most, found.share_of_distances()), 0.0));
  }
}

void ContinuousCollisionChecker::look_along(const Configuration& from, const Configuration& to,
                                            Clearance& found) {
  const Configuration delta = to - from;
  motion_.set_edge(delta);
  std::vector<std::pair<Stretch, PairIndices>> waiting{{{0.5, 0.5, 0, 0}, {}}};
  for (std::uint64_t checks = 0; !waiting.empty(); ++checks) {
    if (is_stopped(checks)) {
      for (const EdgeEnd& end : ends_) {
        found.at_least = std::min(found.at_least, end.resolution(resolution_));
      }
      found.at_least = std::min(found.at_least, resolution_);
      return;
    }
    auto [stretch, candidates] = std::move(waiting.back());
    waiting.pop_back();
    checker_.place(from + stretch.middle * delta);
    motion_.set_middle(checker_.link_poses());
    if (checks == 0) {
      checker_.near_pairs(found.at_most + 0.5 * motion_.most_over_edge(), candidates);
    }
    std::erase_if(candidates,
                  [&, half = stretch.half](int pair) { return settle(pair, half, found); });
    if (!candidates.empty()) {
      const double quarter = 0.5 * stretch.half;
      waiting.emplace_back(Stretch{stretch.middle + quarter, quarter, 0, 0}, candidates);
      waiting.emplace_back(Stretch{stretch.middle - quarter, quarter, 0, 0}, std::move(candidates));
    }
  }
}

bool ContinuousCollisionChecker::settle(int pair, double half, Clearance& found) {
  const double quick = checker_.pair_quick_bound(pair);
  if (quick >= found.at_most + motion_.over_edge(pair) * half) {
    return true;
  }
  const double loss = motion_.within(pair, half);
  const double enough = found.good_enough() + loss;
  if (is_out_of_reach(pair, loss, quick)) {
    return false;
  }
  const double bound = checker_.pair_bound(pair, enough);
  if (found.settle(pair, {bound}, loss)) {
    return true;
  }
  return found.settle(pair, {bound_along(pair, half, found.good_enough(), bound + kSphereError)},
                      0.0) ||
         (loss <= std::max(kWorthExact, found.at_most) &&
          found.settle(pair, checker_.pair_distance_range(pair, enough, found.share_of_distances()),
                       loss));
}

}  // namespace handway::geometric
