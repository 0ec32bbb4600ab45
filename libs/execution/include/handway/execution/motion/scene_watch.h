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

/// Whether a motion may go on in the scene as it is.
struct SceneVerdict {
  enum class State {
    /// The latest edit or question is not answered yet, or where the robot is measured was not
    /// checked for kLongestWait.
    kUnknown,
    kFree,     ///< The rest of the motion is free, from where the robot was measured.
    kBlocked,  ///< It is not, or the robot collides where it is measured.
  };
  State state = State::kUnknown;
  std::string reason;  ///< A sentence, but of kFree.
  /// Of kBlocked: when the motion is there, s of the motion; infinite if it is not known.
  double time = std::numeric_limits<double>::infinity();
  std::chrono::steady_clock::time_point since;  ///< When this state of knowledge began.
};

/// Watches a motion of the whole robot against a scene that may be edited while it runs. An edit
/// voids at once what was known; a thread of its own then checks the rest of the motion, from where
/// the robot is measured, in the edited scene, and between edits every measured posture.
class HANDWAY_EXECUTION_EXPORT SceneWatch {
 public:
  using Clock = std::chrono::steady_clock;
  using Problem = std::shared_ptr<const planning::PlanningProblem>;
  /// Waits for the problem of a scene, at most until `stop` (null then).
  /// @throws std::exception if the scene makes none.
  using ProblemSource = std::function<Problem(const std::stop_token& stop)>;

  /// The longest that a motion may go on without an answer. With a turn of the loop that runs it,
  /// it is held within 100 ms of an edit.
  static constexpr std::chrono::milliseconds kLongestWait{85};

  /// @param motion that will be driven; not empty. @param scene as it is now.
  SceneWatch(planning::Trajectory motion, ProblemSource scene);
  ~SceneWatch();
  SceneWatch(const SceneWatch&) = delete;
  SceneWatch& operator=(const SceneWatch&) = delete;

  /// The scene was edited: nothing is known until its problem is there. From any thread.
  void follow(ProblemSource scene);

  /// Where the motion begins, shape [variable_count].
  [[nodiscard]] const planning::Configuration& start() const {
    return motion_.points.front().position;
  }
  /// Asks for the rest of the motion from where the robot is.
  void ask(double time, const planning::Configuration& measured);
  /// What is known. @param time of the motion, s. @param measured shape [variable_count].
  [[nodiscard]] SceneVerdict look(double time, const planning::Configuration& measured);

 private:
  struct Place {
    double time = 0.0;
    planning::Configuration measured;
  };
  struct Order {
    std::optional<ProblemSource> scene;  ///< Nothing: the one from before.
    std::stop_token obsolete;
    std::uint64_t asked = 0;
    bool is_question = false;  ///< Of the rest; else of the measured posture alone.
  };
  class Checks;

  void renew();
  void set_place(double time, const planning::Configuration& measured);
  [[nodiscard]] Place latest_place();
  /// Waits for it; nothing once `stop` is requested.
  [[nodiscard]] std::optional<Order> next_order(const std::stop_token& stop);
  /// @param checks of the scene before; of this one afterwards, null if it makes no problem.
  [[nodiscard]] SceneVerdict answer(std::unique_ptr<Checks>& checks, const Order& order);
  void work(const std::stop_token& stop);

  planning::Trajectory motion_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<ProblemSource> scene_;  ///< The latest, if it is not looked at yet.
  std::stop_source obsolete_;           ///< What is done for the scene before.
  std::uint64_t asked_ = 0;             ///< Edits and questions.
  std::uint64_t answered_ = 0;          ///< The latest of them that verdict_ answers.
  Place place_;                         ///< The latest.
  /// When the first posture was measured that no check has taken up yet, …
  std::optional<Clock::time_point> new_since_;
  std::optional<Clock::time_point> checked_since_;  ///< … and the same of the one being checked.
  SceneVerdict verdict_;
  std::jthread thread_;
};

}  // namespace handway::execution
