#include "handway/execution/motion/scene_watch.h"

#include "handway/planning/paths/path_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

namespace handway::execution {
namespace {

using planning::Configuration;
using planning::Trajectory;
using planning::TrajectoryPoint;

SceneVerdict blocked(std::string reason, double time) {
  return {SceneVerdict::State::kBlocked, std::move(reason), time, {}};
}

SceneVerdict unknown(std::string reason, SceneWatch::Clock::time_point since) {
  return {SceneVerdict::State::kUnknown, std::move(reason), std::numeric_limits<double>::infinity(),
          since};
}

// Shifts the times of a motion to begin at 0, as devices run it.
std::shared_ptr<const Trajectory> from_time_zero(Trajectory motion) {
  const double begin = motion.points.front().time;
  for (TrajectoryPoint& point : motion.points) {
    point.time -= begin;
  }
  return std::make_shared<const Trajectory>(std::move(motion));
}

Configuration position_at(const Trajectory& motion, double time) {
  const auto next = std::ranges::upper_bound(motion.points, time, {}, &TrajectoryPoint::time);
  if (next == motion.points.begin()) {
    return motion.points.front().position;
  }
  if (next == motion.points.end()) {
    return motion.points.back().position;
  }
  const TrajectoryPoint& before = *std::prev(next);
  const double share = (time - before.time) / (next->time - before.time);
  return before.position + share * (next->position - before.position);
}

}  // namespace

// Checks of the motion in one scene.
class SceneWatch::Checks {
 public:
  Checks(const planning::PlanningProblem& problem, std::shared_ptr<const Trajectory> motion)
      : search_(problem), motion_(std::move(motion)) {}

  /// Checks the measured configuration.
  [[nodiscard]] SceneVerdict posture(const Place& place) {
    const std::string conflict = search_.conflict_at(place.measured);
    if (!conflict.empty()) {
      return blocked(fmt::format("At the robot's measured position: {}.", conflict), place.time);
    }
    return {SceneVerdict::State::kFree, "", 0.0, {}};
  }

  /// Checks the rest of the motion: straight from the measured to the planned configuration, then
  /// along the motion to its end.
  [[nodiscard]] SceneVerdict rest(const Place& place, const std::stop_token& stop) {
    SceneVerdict here = posture(place);
    if (here.state == SceneVerdict::State::kBlocked) {
      return here;
    }
    std::vector<double> times{place.time, place.time};
    std::vector<Configuration> rest{place.measured, position_at(*motion_, place.time)};
    for (const TrajectoryPoint& point : motion_->points) {
      if (point.time > place.time) {
        times.push_back(point.time);
        rest.push_back(point.position);
      }
    }
    const auto conflict = search_.run(rest, [&stop] { return stop.stop_requested(); });
    if (!conflict) {
      return here;
    }
    const std::size_t next = std::min(conflict->waypoint + 1, times.size() - 1);
    const double time =
        times[conflict->waypoint] + conflict->share * (times[next] - times[conflict->waypoint]);
    return blocked(fmt::format("{} at {:.2f} s.", conflict->text, time), time);
  }

 private:
  planning::PathConflictSearch search_;
  std::shared_ptr<const Trajectory> motion_;
};

SceneWatch::SceneWatch(Trajectory motion, ProblemSource scene)
    : motion_(from_time_zero(std::move(motion))), scene_(std::move(scene)), place_{0.0, start()} {
  verdict_.since = Clock::now();
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

SceneWatch::~SceneWatch() {
  thread_.request_stop();
  const std::lock_guard lock(mutex_);
  obsolete_.request_stop();
}

// Invalidates the verdict for a new edit or question. @pre mutex_ is locked.
void SceneWatch::renew() {
  if (answered_ == asked_) {
    verdict_ =
        unknown("The scene was edited, and the remaining motion is not checked yet.", Clock::now());
  }
  ++asked_;
}

void SceneWatch::set_place(double time, const Configuration& measured) {
  if (!new_since_ && measured != place_.measured) {
    new_since_ = Clock::now();
  }
  place_ = {time, measured};
}

void SceneWatch::follow(ProblemSource scene) {
  const std::lock_guard lock(mutex_);
  renew();
  scene_ = std::move(scene);
  obsolete_.request_stop();
  wake_.notify_all();
}

void SceneWatch::begin(Trajectory motion, ProblemSource scene) {
  const std::lock_guard lock(mutex_);
  renew();
  motion_ = from_time_zero(std::move(motion));
  scene_ = std::move(scene);
  place_ = {0.0, start()};
  obsolete_.request_stop();
  wake_.notify_all();
}

void SceneWatch::revoke(std::string reason) {
  const std::lock_guard lock(mutex_);
  revoked_ = std::move(reason);
}

void SceneWatch::ask(double time, const Configuration& measured) {
  const std::lock_guard lock(mutex_);
  renew();
  set_place(time, measured);
  wake_.notify_all();
}

SceneVerdict SceneWatch::look(double time, const Configuration& measured) {
  const std::lock_guard lock(mutex_);
  if (!revoked_.empty()) {
    return blocked(revoked_, std::numeric_limits<double>::infinity());
  }
  set_place(time, measured);
  if (new_since_) {
    wake_.notify_all();
  }
  const auto unchecked_since = checked_since_ ? checked_since_ : new_since_;
  if (verdict_.state == SceneVerdict::State::kFree && unchecked_since &&
      Clock::now() - *unchecked_since >= kLongestWait) {
    return unknown("This computer is too busy to check the robot's measured position.",
                   *unchecked_since);
  }
  return verdict_;
}

SceneVerdict SceneWatch::answer(std::unique_ptr<Checks>& checks, const Order& order) {
  try {
    if (order.scene) {
      checks.reset();
      const Problem problem = (*order.scene)(order.obsolete);
      if (!problem) {
        return {};  // a newer scene replaces this one
      }
      checks = std::make_unique<Checks>(*problem, order.motion);
    }
    if (!checks) {
      return blocked("The scene can't be checked.", std::numeric_limits<double>::infinity());
    }
    return order.is_question ? checks->rest(latest_place(), order.obsolete)
                             : checks->posture(latest_place());
  } catch (const std::exception& error) {
    return blocked(fmt::format("The scene can't be checked: {}", error.what()),
                   std::numeric_limits<double>::infinity());
  }
}

SceneWatch::Place SceneWatch::latest_place() {
  const std::lock_guard lock(mutex_);
  checked_since_ = std::exchange(new_since_, std::nullopt);
  return place_;
}

std::optional<SceneWatch::Order> SceneWatch::next_order(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const auto something = [this] { return asked_ != answered_ || new_since_; };
  if (!wake_.wait(lock, stop, something) || stop.stop_requested()) {
    return std::nullopt;
  }
  Order order{std::exchange(scene_, std::nullopt), motion_, {}, asked_, asked_ != answered_};
  if (order.scene) {
    obsolete_ = {};
  }
  order.obsolete = obsolete_.get_token();
  return order;
}

void SceneWatch::work(const std::stop_token& stop) {
  std::unique_ptr<Checks> checks;
  while (const std::optional<Order> order = next_order(stop)) {
    SceneVerdict verdict = answer(checks, *order);
    const std::lock_guard lock(mutex_);
    checked_since_.reset();
    if (!checks) {
      new_since_.reset();
    }
    if (order->asked != asked_) {
      continue;  // a newer scene or question waits
    }
    answered_ = asked_;
    const bool is_news = verdict.state == SceneVerdict::State::kBlocked &&
                         verdict_.state != SceneVerdict::State::kBlocked;
    if (order->is_question || is_news) {
      verdict_ = std::move(verdict);
      verdict_.since = Clock::now();
    }
  }
}

}  // namespace handway::execution
