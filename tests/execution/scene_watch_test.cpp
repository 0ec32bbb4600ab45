/// Scenes that are edited while a motion runs, or before it does: on emulated devices.
#include "handway/execution/motion/scene_watch.h"

#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/hand_emulator.h"
#include "handway/execution/motion/motion_run.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/planning/timing/time_path.h"
#include "handway_test/motions.h"
#include "handway_test/solid_robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace handway::execution {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using Clock = SceneWatch::Clock;
using Problem = SceneWatch::Problem;
using State = SceneVerdict::State;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// The hand sweeps about the base by 0.4 rad, and later down; all joints go 1.5 rad/s.
const planning::PlanningProblem& empty_cell() {
  static const planning::PlanningProblem kProblem = [] {
    auto scene = std::make_shared<geometric::Scene>(*test::tx90_sah_problem().scene);
    geometric::RobotDescription robot = scene->robots.front().model->description();
    for (geometric::Joint& joint : robot.joints) {
      joint.limits.velocity = 1.5;
    }
    scene->robots.front().model = std::make_shared<const geometric::RobotModel>(std::move(robot));
    return planning::make_problem(std::move(scene), nullptr);
  }();
  return kProblem;
}

/// A wall of 1500 × 20 × 3000 mm that begins in front of the base, `angle` (rad) about it.
geometric::SceneObject wall_at(double angle) {
  geometric::SceneObject wall;
  wall.name = "wall";
  wall.shape = geometric::Box{{1.5, 0.02, 3.0}};
  wall.X_PO = geometric::pose_from_rpy({1.3 * std::cos(angle), 1.3 * std::sin(angle), 0.0}, 0.0,
                                       0.0, angle);
  return wall;
}

Problem with(const geometric::SceneObject& object) {
  auto scene = std::make_shared<geometric::Scene>(*empty_cell().scene);
  scene->objects.push_back(object);
  return std::make_shared<const planning::PlanningProblem>(
      planning::make_problem(std::move(scene), nullptr));
}

Problem nothing_added() { return std::make_shared<const planning::PlanningProblem>(empty_cell()); }

SceneWatch::ProblemSource source_of(Problem problem) {
  return [problem = std::move(problem)](const std::stop_token& /*stop*/) { return problem; };
}

/// Finds everything free; on a computer too busy to say so while `is_busy`.
class BusyChecker final : public geometric::CollisionChecker {
 public:
  BusyChecker(const geometric::CollisionChecker& checker, const std::atomic<bool>& is_busy)
      : CollisionChecker(checker.shared_world()), is_busy_(is_busy) {}
  [[nodiscard]] std::unique_ptr<CollisionChecker> clone() const override {
    return std::make_unique<BusyChecker>(*this, is_busy_);
  }

 private:
  [[nodiscard]] bool do_pair_collides(int /*pair*/) override { return false; }
  [[nodiscard]] double do_pair_distance(int /*pair*/, double enough) override { return enough; }
  [[nodiscard]] std::optional<int> do_first_collision(int /*hint*/) override {
    while (is_busy_) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    return std::nullopt;
  }

  const std::atomic<bool>& is_busy_;
};

/// Returns a source of the problem that is as slow as an import of a large mesh.
SceneWatch::ProblemSource slow_source_of(Problem problem, milliseconds delay) {
  return [problem = std::move(problem), delay](const std::stop_token& stop) -> Problem {
    for (const auto begin = Clock::now(); Clock::now() - begin < delay;) {
      if (stop.stop_requested()) {
        return nullptr;
      }
      std::this_thread::sleep_for(milliseconds(5));
    }
    return problem;
  };
}

const planning::Motion& sweep() {
  static const planning::Motion kMotion = [] {
    planning::TimingOptions options;
    options.speed = 0.3;
    options.period = 0.02;
    return time_path(empty_cell(), test::tx90_sah_path(), "sweep", options).motion;
  }();
  return kMotion;
}

planning::Configuration start() { return sweep().trajectory.points.front().position; }
planning::Configuration end() { return sweep().trajectory.points.back().position; }

SceneVerdict answer_of(SceneWatch& watch, double time, const planning::Configuration& measured) {
  SceneVerdict verdict = watch.look(time, measured);
  for (const auto begin = Clock::now();
       verdict.state == State::kUnknown && ms_since(begin) < 10000.0;) {
    std::this_thread::sleep_for(milliseconds(1));
    verdict = watch.look(time, measured);
  }
  return verdict;
}

TEST(SceneWatch, FindsTheRestFreeUntilAWallIsInItsWay) {
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  watch.ask(0.0, start());
  EXPECT_EQ(answer_of(watch, 0.0, start()).reason, "");
  watch.follow(source_of(with(wall_at(0.4))));
  const SceneVerdict verdict = answer_of(watch, 0.0, start());
  EXPECT_EQ(verdict.state, State::kBlocked);
  EXPECT_THAT(verdict.reason, AllOf(HasSubstr("wall"), HasSubstr(" s.")));
  EXPECT_GT(verdict.time, 0.1);
  EXPECT_LT(verdict.time, sweep().trajectory.duration());
  watch.follow(source_of(nothing_added()));
  EXPECT_EQ(answer_of(watch, 0.0, start()).state, State::kFree) << "it was taken away";
}

TEST(SceneWatch, KnowsNothingFromAnEditToItsAnswer) {
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  watch.ask(0.0, start());
  EXPECT_EQ(answer_of(watch, 0.0, start()).reason, "");
  const auto edited = Clock::now();
  watch.follow(slow_source_of(nothing_added(), milliseconds(100)));
  const SceneVerdict verdict = watch.look(0.0, start());
  EXPECT_EQ(verdict.state, State::kUnknown);
  EXPECT_GE(verdict.since, edited);
  EXPECT_EQ(answer_of(watch, 0.0, start()).reason, "");
}

TEST(SceneWatch, FollowsOneMotionAfterAnother) {
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  watch.ask(0.0, start());
  EXPECT_EQ(answer_of(watch, 0.0, start()).state, State::kFree);
  planning::Trajectory stay;
  stay.points = {sweep().trajectory.points.back(), sweep().trajectory.points.back()};
  stay.points.back().time += 1.0;
  watch.begin(stay, source_of(with(wall_at(0.05))));
  EXPECT_EQ(watch.start(), end());
  EXPECT_EQ(watch.look(0.0, end()).state, State::kUnknown);
  EXPECT_EQ(answer_of(watch, 0.0, end()).state, State::kFree) << "the wall is in the way before";
}

TEST(SceneWatch, StaysBlockedOnceItIsRevoked) {
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  watch.ask(0.0, start());
  EXPECT_EQ(answer_of(watch, 0.0, start()).state, State::kFree);
  watch.revoke("The task is out of date.");
  EXPECT_EQ(watch.look(0.0, start()).reason, "The task is out of date.");
  watch.follow(source_of(nothing_added()));
  watch.begin(sweep().trajectory, source_of(nothing_added()));
  EXPECT_EQ(answer_of(watch, 0.0, start()).state, State::kBlocked);
}

TEST(SceneWatch, AnswersForTheLatestOfManyEdits) {
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  watch.ask(0.0, start());
  for (int edit = 0; edit < 50; ++edit) {
    watch.follow(slow_source_of(nothing_added(), milliseconds(10000)));
  }
  watch.follow(source_of(with(wall_at(0.4))));
  EXPECT_EQ(answer_of(watch, 0.0, start()).state, State::kBlocked);
}

TEST(SceneWatch, LooksAheadAndNotBack) {
  SceneWatch watch(sweep().trajectory, source_of(with(wall_at(0.05))));
  const double duration = sweep().trajectory.duration();
  watch.ask(duration, end());
  EXPECT_EQ(answer_of(watch, duration, end()).state, State::kFree) << "the wall is behind it";
  watch.ask(0.0, start());
  EXPECT_EQ(answer_of(watch, 0.0, start()).state, State::kBlocked);
}

TEST(SceneWatch, ComesFromWhereTheRobotIsMeasured) {
  SceneWatch watch(sweep().trajectory, source_of(with(wall_at(0.4))));
  const double duration = sweep().trajectory.duration();
  watch.ask(duration, start());  // on the other side of the wall
  EXPECT_EQ(answer_of(watch, duration, start()).state, State::kBlocked);
}

TEST(SceneWatch, FindsAMeasuredPostureThatCollides) {
  SceneWatch watch(sweep().trajectory, source_of(with(wall_at(0.8))));
  watch.ask(0.0, start());
  ASSERT_EQ(answer_of(watch, 0.0, start()).reason, "");
  planning::Configuration pushed = start();
  pushed[sweep().model->find_variable("joint_1").value()] = 0.7;
  SceneVerdict verdict;
  for (int k = 0; k < 5000 && verdict.state != State::kBlocked; ++k) {
    verdict = watch.look(1.0, pushed);
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_THAT(verdict.reason, AllOf(HasSubstr("wall"), HasSubstr("measured")));
}

TEST(SceneWatch, CountsWhatIsCarried) {
  geometric::SceneObject rod;
  rod.name = "rod";
  rod.shape = geometric::Box{{0.4, 0.02, 0.02}};
  rod.X_PO = geometric::pose_from_rpy({0.5 * std::cos(0.6), 0.5 * std::sin(0.6), -0.2}, 0, 0, 0.6);
  rod.attachment = {empty_cell().scene->robots.front().name, "link_1", {}};
  auto scene = std::make_shared<geometric::Scene>(*empty_cell().scene);
  scene->objects = {rod, wall_at(0.8)};
  SceneWatch watch(sweep().trajectory, source_of(with(wall_at(0.8))));
  watch.ask(0.0, start());
  EXPECT_EQ(answer_of(watch, 0.0, start()).reason, "");
  watch.follow(source_of(
      std::make_shared<const planning::PlanningProblem>(planning::make_problem(scene, nullptr))));
  EXPECT_THAT(answer_of(watch, 0.0, start()).reason, AllOf(HasSubstr("rod"), HasSubstr("wall")));
}

TEST(SceneWatch, BlocksWhatViolatesAConstraint) {
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  watch.ask(0.0, start());
  EXPECT_EQ(answer_of(watch, 0.0, start()).reason, "");
  auto scene = std::make_shared<geometric::Scene>(*empty_cell().scene);
  geometric::OrientationConstraint ahead;
  ahead.axis = Eigen::Vector3d::UnitX();
  ahead.direction = Eigen::Vector3d::UnitX();
  ahead.angle = 0.2;
  scene->constraints = {{"ahead", "link_1", ahead}};
  watch.follow(source_of(
      std::make_shared<const planning::PlanningProblem>(planning::make_problem(scene, nullptr))));
  const SceneVerdict verdict = answer_of(watch, 0.0, start());
  EXPECT_EQ(verdict.state, State::kBlocked);
  EXPECT_THAT(verdict.reason, HasSubstr("The motion violates constraint ahead at "));
  EXPECT_GT(verdict.time, 0.0);
}

TEST(SceneWatch, BlocksASceneThatMakesNoProblem) {
  SceneWatch watch(sweep().trajectory, [](const std::stop_token& /*stop*/) -> Problem {
    throw std::runtime_error("a mesh that is not there");
  });
  watch.ask(0.0, start());
  const SceneVerdict verdict = answer_of(watch, 0.0, start());
  EXPECT_EQ(verdict.state, State::kBlocked);
  EXPECT_THAT(verdict.reason, HasSubstr("a mesh that is not there"));
}

/// Calls a test's function whenever the motion has progressed, or is held.
class Script final : public MotionObserver {
 public:
  std::function<void(double time)> progress = [](double) {};
  std::function<void(const std::string& reason)> held = [](const std::string&) {};
  std::vector<std::string> reasons;

  void on_sample(const MotionSample& /*sample*/) override {}
  void on_progress(double time, const std::vector<FollowingError>& /*errors*/) override {
    progress(time);
  }
  void on_held(const std::string& reason) override {
    reasons.push_back(reason);
    held(reason);
  }
};

class WatchedRun : public testing::Test {
 protected:
  void SetUp() override {
    device::Val3ControllerSettings arm;
    device::HandControllerSettings hand;
    const auto emulate = [](const char* kind, auto& settings) {
      const geometric::JointIndices variables = empty_cell().joints.of_part(kind);
      settings.joints = device_joints(empty_cell().model(), variables);
      settings.position = start()(variables);
    };
    emulate("arm", arm);
    emulate("hand", hand);
    arm_ = std::make_unique<device::ArmEmulator>(arm, 0);
    hand_ = std::make_unique<device::HandEmulator>(hand, 0);
    targets_ = parse_targets(arm_->address() + "," + hand_->address(), empty_cell());
    for (const MotionTarget& target : targets_) {
      target.link->connect();
      target.link->upload(part_of(sweep().trajectory, target.variables));
    }
  }

  MotionOutcome run(SceneWatch& watch) {
    requests_.stop = stop_.get_token();
    requests_.watch = &watch;
    return run_motion(targets_, {}, requests_, script_);
  }
  /// Edits the scene once the motion is `time` (s) old.
  void edit_at(double time, SceneWatch& watch, SceneWatch::ProblemSource scene) {
    script_.progress = [this, time, &watch, scene = std::move(scene)](double now) {
      if (!edited_ && now > time) {
        edited_ = Clock::now();
        watch.follow(scene);
      }
    };
  }
  [[nodiscard]] planning::Configuration measured() const {
    return with_measured(start(), targets_);
  }
  static bool is_free(const Problem& problem, const planning::Configuration& q) {
    return !problem->checker->clone()->first_collision(q);
  }

  std::unique_ptr<device::ArmEmulator> arm_;
  std::unique_ptr<device::HandEmulator> hand_;
  std::vector<MotionTarget> targets_;
  std::stop_source stop_;
  MotionRequests requests_;
  Script script_;
  std::optional<Clock::time_point> edited_;
};

TEST_F(WatchedRun, GoesToTheEndWhereNothingIsEdited) {
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  const MotionOutcome outcome = run(watch);
  EXPECT_TRUE(outcome.done) << outcome.fault << outcome.collision;
  EXPECT_THAT(script_.reasons, IsEmpty());
}

TEST_F(WatchedRun, DoesNotStartThroughAWall) {
  SceneWatch watch(sweep().trajectory, source_of(with(wall_at(0.4))));
  const MotionOutcome outcome = run(watch);
  EXPECT_FALSE(outcome.done);
  EXPECT_FALSE(outcome.started);
  EXPECT_THAT(outcome.collision, HasSubstr("wall"));
  EXPECT_TRUE(measured().isApprox(start(), 1e-6)) << "nothing moved";
}

TEST_F(WatchedRun, HoldsBeforeAWallThatIsAddedUnderWay) {
  const Problem walled = with(wall_at(0.5));
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  edit_at(0.2, watch, source_of(walled));
  double held_ms = -1.0;
  int polls = 0;
  script_.held = [&](const std::string& /*reason*/) { held_ms = ms_since(edited_.value()); };
  const auto edit = script_.progress;
  script_.progress = [&](double time) {
    edit(time);
    if (requests_.hold && ++polls == 200) {
      EXPECT_FALSE(arm_->moving());
      EXPECT_FALSE(hand_->moving());
      stop_.request_stop();
    }
  };
  const MotionOutcome outcome = run(watch);
  EXPECT_FALSE(outcome.done);
  ASSERT_EQ(script_.reasons.size(), 1U);
  EXPECT_THAT(script_.reasons.front(), AllOf(HasSubstr("wall"), HasSubstr(" s.")));
  EXPECT_GE(held_ms, 0.0);
  EXPECT_LE(held_ms, 100.0);
  RecordProperty("held_ms", std::to_string(held_ms));
  EXPECT_TRUE(is_free(walled, measured()));
}

TEST_F(WatchedRun, HoldsWhereMeasuredPosturesAreNotCheckedForTooLong) {
  std::atomic<bool> is_busy = false;
  auto problem = std::make_shared<planning::PlanningProblem>(empty_cell());
  problem->checker = std::make_shared<const BusyChecker>(*empty_cell().checker, is_busy);
  SceneWatch watch(sweep().trajectory, source_of(problem));
  Clock::time_point busy_since;
  script_.progress = [&](double time) {
    if (time > 0.2 && script_.reasons.empty() && !is_busy) {
      busy_since = Clock::now();
      is_busy = true;
    }
  };
  double held_ms = -1.0;
  script_.held = [&](const std::string& reason) {
    if (held_ms < 0.0) {
      held_ms = ms_since(busy_since);
      EXPECT_THAT(reason, HasSubstr("too busy"));
      is_busy = false;
    } else {
      EXPECT_THAT(reason, HasSubstr("can continue"));
      requests_.hold = false;
    }
  };
  const MotionOutcome outcome = run(watch);
  EXPECT_TRUE(outcome.done) << outcome.fault << outcome.collision;
  EXPECT_EQ(script_.reasons.size(), 2U);
  EXPECT_GT(held_ms, 0.0);
  EXPECT_LE(held_ms, 150.0) << "from the next sample on";
}

TEST_F(WatchedRun, HoldsUntilThereIsAnAnswerAndThenWaitsForAPerson) {
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  edit_at(0.2, watch, slow_source_of(nothing_added(), milliseconds(600)));
  double held_ms = -1.0;
  script_.held = [&](const std::string& reason) {
    if (held_ms < 0.0) {
      held_ms = ms_since(edited_.value());
      EXPECT_THAT(reason, HasSubstr("not checked yet"));
    } else {
      EXPECT_THAT(reason, HasSubstr("can continue"));
      EXPECT_TRUE(requests_.hold);
      EXPECT_GE(ms_since(edited_.value()), 600.0);
      requests_.hold = false;
    }
  };
  const MotionOutcome outcome = run(watch);
  EXPECT_TRUE(outcome.done) << outcome.fault << outcome.collision;
  EXPECT_EQ(script_.reasons.size(), 2U);
  EXPECT_LE(held_ms, 100.0);
}

TEST_F(WatchedRun, DoesNotGoOnThroughAWallAfterAHold) {
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  int polls = 0;
  int refusals = 0;
  script_.progress = [&](double time) {
    if (polls == 0 && time > 0.2) {
      requests_.hold = true;
      ++polls;
    } else if (polls > 0 && ++polls == 150) {
      watch.follow(source_of(with(wall_at(0.5))));
      requests_.hold = false;
    }
  };
  script_.held = [&](const std::string& reason) {
    EXPECT_TRUE(requests_.hold);
    EXPECT_FALSE(arm_->moving());
    if (++refusals < 4) {
      EXPECT_THAT(reason, HasSubstr("wall"));
      requests_.hold = false;  // and again
    } else if (refusals == 4) {
      watch.follow(source_of(nothing_added()));
    } else {
      EXPECT_THAT(reason, HasSubstr("can continue"));
      requests_.hold = false;
    }
  };
  const MotionOutcome outcome = run(watch);
  EXPECT_TRUE(outcome.done) << "once the wall is gone: " << outcome.fault << outcome.collision;
  EXPECT_EQ(refusals, 5);
}

TEST_F(WatchedRun, StopsWhereAHoldWouldComeTooLate) {
  const double joint_1_under_way = 0.1;
  SceneWatch watch(sweep().trajectory, source_of(nothing_added()));
  const int joint_1 = sweep().model->find_variable("joint_1").value();
  script_.progress = [&](double /*time*/) {
    if (!edited_ && measured()[joint_1] > joint_1_under_way) {
      edited_ = Clock::now();
      watch.follow(source_of(with(wall_at(measured()[joint_1]))));
    }
  };
  const MotionOutcome outcome = run(watch);
  EXPECT_FALSE(outcome.done);
  EXPECT_TRUE(outcome.started);
  EXPECT_THAT(outcome.collision, HasSubstr("wall"));
  EXPECT_THAT(outcome.fault, IsEmpty());
  EXPECT_GE(outcome.at_rest_ms, 0.0);
}

}  // namespace
}  // namespace handway::execution
