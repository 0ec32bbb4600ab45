#include "handway/planning/grasps/hold_test.h"

#include "core/thread_pool.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace handway::planning {
namespace {

// Holds in everything that is tested.
bool holds(const HoldTest& test, const Pregrasp& grasp, const HoldConditions& conditions,
           const std::stop_token& stop) {
  return test.test(grasp, conditions, stop, {}).held_under_all_loads();
}

bool is_finished(const HoldResult& result) { return result.lift.has_value(); }

// Tests grasps [first, last) and notes the results of those tests that are not stopped.
void test_range(const HoldTest& test, std::vector<TestedGrasp>& grasps, std::size_t first,
                std::size_t last, const HoldConditions& conditions, ThreadPool& threads,
                const std::stop_token& stop) {
  threads.run(static_cast<int>(first), static_cast<int>(last), [&](int k) {
    TestedGrasp& tested = grasps[static_cast<std::size_t>(k)];
    HoldResult result = test.test(tested.grasp, conditions, stop, {});
    if (is_finished(result)) {
      tested.hold = std::move(result);
    }
  });
}

std::size_t holding_count(const std::vector<TestedGrasp>& grasps) {
  return static_cast<std::size_t>(std::ranges::count_if(grasps, [](const TestedGrasp& tested) {
    return tested.hold && tested.hold->held_under_all_loads();
  }));
}

/// The last value that holds between one that does and one that does not.
class Bisection {
 public:
  Bisection(double holds, double fails) : holds_(holds), fails_(fails) {}

  template <typename Holds, typename Near>
  double run(const Holds& holds, const Near& near, const std::stop_token& stop) {
    while (!near(holds_, fails_)) {
      const double middle = 0.5 * (holds_ + fails_);
      const bool held = holds(middle);
      if (stop.stop_requested()) {
        break;  // the test was not finished
      }
      (held ? holds_ : fails_) = middle;
    }
    return holds_;
  }

 private:
  double holds_;
  double fails_;
};

// Holds wherever along x and y of the world the object is off by that much.
bool holds_misplaced(const HoldTest& test, const Pregrasp& grasp, const HoldConditions& conditions,
                     double distance, const std::stop_token& stop) {
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(distance, 0.0, 0.0), Eigen::Vector3d(-distance, 0.0, 0.0),
        Eigen::Vector3d(0.0, distance, 0.0), Eigen::Vector3d(0.0, -distance, 0.0)}) {
    HoldConditions changed = conditions;
    changed.misplacement = direction;
    if (!holds(test, grasp, changed, stop)) {
      return false;
    }
  }
  return true;
}

}  // namespace

int HoldResult::directions_held() const {
  return static_cast<int>(std::ranges::count(directions, true, &HoldSlip::held));
}

HoldMargins hold_margins(const HoldTest& test, const Pregrasp& grasp,
                         const HoldConditions& conditions, const std::stop_token& stop) {
  HoldMargins margins;
  if (!holds(test, grasp, conditions, stop)) {
    return margins;
  }
  const auto with_friction = [&](double friction) {
    HoldConditions changed = conditions;
    changed.contact.friction = friction;
    return holds(test, grasp, changed, stop);
  };
  const auto with_mass = [&](double mass) {
    HoldConditions changed = conditions;
    changed.mass = mass;
    return holds(test, grasp, changed, stop);
  };
  constexpr double kFrictionStep = 0.01;
  margins.least_friction =
      Bisection(conditions.contact.friction, 0.0)
          .run(
              with_friction,
              [](double holding, double failing) { return holding - failing <= kFrictionStep; },
              stop);
  constexpr double kMostMass = 10.0;  // kg
  constexpr double kMassShare = 0.05;
  double holding = conditions.mass;
  double failing = 2.0 * holding;
  while (failing < kMostMass && !stop.stop_requested() && with_mass(failing)) {
    holding = failing;
    failing *= 2.0;
  }
  margins.largest_mass =
      Bisection(holding, std::max(holding, std::min(failing, kMostMass)))
          .run(
              with_mass,
              [](double held, double dropped) { return dropped - held <= kMassShare * held; },
              stop);
  margins.position_error = kMisplacements.front();
  for (std::size_t i = 1; i < kMisplacements.size() &&
                          holds_misplaced(test, grasp, conditions, kMisplacements[i], stop);
       ++i) {
    margins.position_error = kMisplacements[i];
  }
  return margins;
}

std::vector<TestedGrasp> rank_by_tests(const HoldTest& test, std::vector<Pregrasp> grasps,
                                       std::size_t wanted, const HoldConditions& conditions,
                                       int threads, const std::stop_token& stop) {
  constexpr std::size_t kLeastTests = 2;  // at a time, whatever the number of threads
  std::vector<TestedGrasp> tested;
  tested.reserve(grasps.size());
  for (Pregrasp& grasp : grasps) {
    tested.push_back({std::move(grasp)});
  }
  ThreadPool pool(std::max(threads, 1));
  std::size_t done = 0;
  for (std::size_t held = 0; held < wanted && done < tested.size() && !stop.stop_requested();
       held = holding_count(tested)) {
    const std::size_t last = std::min(done + std::max(wanted - held, kLeastTests), tested.size());
    test_range(test, tested, done, last, conditions, pool, stop);
    done = last;
  }
  std::ranges::stable_sort(tested, std::greater(), [](const TestedGrasp& one) {
    constexpr double kUntested = 6.5;  // between all seven loads and fewer
    return one.hold ? one.hold->loads_held() : kUntested;
  });
  return tested;
}

}  // namespace handway::planning
