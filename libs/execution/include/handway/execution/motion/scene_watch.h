#pragma once

#include "handway/execution/export.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/timing/trajectory.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace handway::execution {

/// Result of checking the rest of a motion in the current scene.
struct SceneVerdict {
  enum class State {
    /// The latest edit or question has no answer yet, or measured configurations were not checked
    /// for kLongestWait.
    kUnknown,
    kFree,     ///< The rest of the motion is free, from the robot's measured configuration.
    kBlocked,  ///< The rest or the measured configuration is not free, or can't be checked.
  };
  State state = State::kUnknown;
  std::string reason;  ///< Reason as a sentence; empty for kFree and before any question.
  /// Motion time of the conflict for kBlocked, s; infinite if unknown.
  double time = std::numeric_limits<double>::infinity();
  std::chrono::steady_clock::time_point since;  ///< Time at which this verdict began to hold.
};

/// Checks a motion of the whole robot in a scene that may be edited while the motion runs. An edit
/// invalidates the verdict at once; a separate thread then checks the rest of the motion from the
/// measured configuration. Between edits the thread checks the latest measured configuration.
class HANDWAY_EXECUTION_EXPORT SceneWatch {
 public:
  using Clock = std::chrono::steady_clock;
  using Problem = std::shared_ptr<const planning::PlanningProblem>;
  /// Waits for the problem of a scene and returns it; null once `stop` is requested.
  /// @throws std::exception if no problem can be made of the scene.
  using ProblemSource = std::function<Problem(const std::stop_token& stop)>;

  /// Longest time that a motion may go on without a verdict. With one cycle of the loop that runs
  /// it, the motion is held within 100 ms of an edit.
  static constexpr std::chrono::milliseconds kLongestWait{85};

  /// @param motion trajectory that will be run; not empty. @param scene the current scene.
  SceneWatch(planning::Trajectory motion, ProblemSource scene);
  ~SceneWatch();
  SceneWatch(const SceneWatch&) = delete;
  SceneWatch& operator=(const SceneWatch&) = delete;

  /// Sets the edited scene; the verdict is kUnknown until it is checked. Any thread may call this.
  void follow(ProblemSource scene);
  /// Watches another motion from now on, in a scene of its own. Only the thread that runs the
  /// motion may call this.
  void begin(planning::Trajectory motion, ProblemSource scene);
  /// The verdict is kBlocked from now on, also for later motions. Any thread may call this.
  /// @param reason a sentence.
  void revoke(std::string reason);

  /// First configuration of the motion, shape [variable_count].
  [[nodiscard]] const planning::Configuration& start() const {
    return motion_->points.front().position;
  }
  /// Requests a check of the rest of the motion. Parameters as for look().
  void ask(double time, const planning::Configuration& measured);
  /// Returns the verdict. @param time motion time, s. @param measured shape [variable_count].
  [[nodiscard]] SceneVerdict look(double time, const planning::Configuration& measured);

 private:
  struct Place {
    double time = 0.0;
    planning::Configuration measured;
  };
  struct Order {
    std::optional<ProblemSource> scene;  ///< New scene; empty: the previous one.
    std::shared_ptr<const planning::Trajectory> motion;
    std::stop_token obsolete;
    std::uint64_t asked = 0;
    bool is_question = false;  ///< True: check the rest; false: the measured configuration only.
  };
  class Checks;

  void renew();
  void set_place(double time, const planning::Configuration& measured);
  [[nodiscard]] Place latest_place();
  /// Waits for the next order and returns it; empty once `stop` is requested.
  [[nodiscard]] std::optional<Order> next_order(const std::stop_token& stop);
  /// Runs the checks of an order. @param checks replaced for a new scene; null: it has no problem.
  [[nodiscard]] SceneVerdict answer(std::unique_ptr<Checks>& checks, const Order& order);
  void work(const std::stop_token& stop);

  std::shared_ptr<const planning::Trajectory> motion_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<ProblemSource> scene_;  ///< Latest scene, if no check has taken it up yet.
  std::stop_source obsolete_;           ///< Stops the checks of the previous scene.
  std::uint64_t asked_ = 0;             ///< Number of edits and questions.
  std::uint64_t answered_ = 0;          ///< Value of asked_ that verdict_ answers.
  Place place_;                         ///< Latest motion time and measured configuration.
  /// Time of the first changed measurement that no check has taken up yet.
  std::optional<Clock::time_point> new_since_;
  std::optional<Clock::time_point> checked_since_;  ///< Value of new_since_ at the running check.
  SceneVerdict verdict_;
  std::string revoked_;  ///< Reason of revoke(); empty: it was not called.
  std::jthread thread_;
};

}  // namespace handway::execution
