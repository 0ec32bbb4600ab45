/// Tasks on devices: stage after stage, with an object in the hand.
#include "handway/execution/motion/motion_parts.h"

#include "fake_device.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/tasks/timed_task.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace handway::execution {
namespace {

using planning::Configuration;
using testing::ElementsAre;
using testing::HasSubstr;

struct TaskOfTheCan {
  planning::Motion motion;
  std::vector<MotionPart> parts;
};

/// The can of the shipped scene is put down elsewhere.
const TaskOfTheCan& can_task() {
  static const TaskOfTheCan kTask = [] {
    const planning::SceneState scene = planning::load_scene(
        test::source_dir() / "scenes/can_on_table.yaml", planning::PluginManager());
    const planning::Task task{planning::PickStep{"can"}, planning::PlaceStep{{"table"}}};
    const planning::TaskPlan plan =
        plan_task(scene, task, *planning::PlannerRegistry().create("auto"));
    planning::TimingOptions options;
    options.speed = 0.5;
    options.period = 0.02;
    TaskOfTheCan made;
    made.motion = time_task(task, plan, "can", options).motion;
    std::vector<planning::SceneState> scenes;
    std::ranges::transform(plan.stages, std::back_inserter(scenes), &planning::TaskStage::state);
    made.parts = parts_of(made.motion, scenes);
    return made;
  }();
  return kTask;
}

const MotionPart& part_called(const std::string& name) {
  return *std::ranges::find(can_task().parts, name, &MotionPart::name);
}

const Configuration& begin_of(const MotionPart& part) {
  return part.trajectory.points.front().position;
}
const Configuration& end_of(const MotionPart& part) {
  return part.trajectory.points.back().position;
}

TEST(MotionParts, HoldTheObjectUntilItIsReleased) {
  std::vector<std::string> names;
  std::ranges::transform(can_task().parts, std::back_inserter(names), &MotionPart::name);
  EXPECT_THAT(names, ElementsAre("approach (pick can)", "reach (pick can)", "close (pick can)",
                                 "hold (pick can)", "lift (pick can)", "carry (place on table)",
                                 "lower (place on table)", "release (place on table)",
                                 "open (place on table)", "retreat (place on table)"));
}

TEST(MotionParts, BeginWhereTheOnesBeforeThemEnd) {
  const std::vector<MotionPart>& parts = can_task().parts;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    EXPECT_TRUE(begin_of(parts[i]).isApprox(end_of(parts[i - 1]), 1e-9)) << parts[i].name;
  }
}

TEST(MotionParts, SqueezeTheObjectWhileTheHandCarriesIt) {
  const planning::Motion& motion = can_task().motion;
  const Configuration& squeezed = motion.stages[2].squeezed;
  for (const char* name : {"lift (pick can)", "carry (place on table)", "lower (place on table)"}) {
    const MotionPart& part = part_called(name);
    for (const planning::TrajectoryPoint& point : part.trajectory.points) {
      EXPECT_EQ(Configuration(point.position(motion.hand)), Configuration(squeezed(motion.hand)));
    }
    EXPECT_TRUE(part.give(motion.arm).isZero()) << "an object does not block the arm";
    EXPECT_GT(part.give(motion.hand).maxCoeff(), 0.01);
  }
  EXPECT_EQ(part_called("open (place on table)").give.size(), 0);
}

TEST(MotionParts, SqueezeWithinTheVelocitiesOfTheMotion) {
  const planning::Motion& motion = can_task().motion;
  for (const char* name : {"hold (pick can)", "release (place on table)"}) {
    const std::vector<planning::TrajectoryPoint>& points = part_called(name).trajectory.points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Configuration velocity =
          (points[i].position - points[i - 1].position) / (points[i].time - points[i - 1].time);
      EXPECT_TRUE(
          (velocity.cwiseAbs().array() <= motion.speed * motion.limits.velocity.array()).all())
          << name;
    }
  }
}

TEST(MotionParts, RestWhereAProgramWaits) {
  planning::Motion motion = can_task().motion;
  std::vector<planning::SceneState> scenes(motion.stages.size() + 2);
  const std::size_t last = motion.path.waypoints.size() - 1;
  motion.stages.push_back({.name = "output", .step = "set do3 to true", .first = last});
  motion.stages.back().output = geometric::OutputStep{"do3", true};
  motion.stages.push_back({.name = "wait", .step = "wait 2 s", .first = last, .waits = true});
  motion.path.waypoints.push_back(motion.path.waypoints.back());
  motion.waypoint_times.push_back(motion.waypoint_times.back() + 2.0);
  motion.trajectory.points.push_back(motion.trajectory.points.back());
  motion.trajectory.points.back().time += 2.0;
  const std::vector<MotionPart> parts = parts_of(motion, scenes);
  ASSERT_EQ(parts.size(), can_task().parts.size() + 1) << "an output has no part";
  EXPECT_EQ(parts.back().name, "wait 2 s");
  EXPECT_TRUE(parts.back().rests);
  EXPECT_NEAR(parts.back().trajectory.duration(), 2.0, 1e-9);
  EXPECT_EQ(parts.back().stage, motion.stages.size() - 1);
  EXPECT_FALSE(parts.front().rests);
  EXPECT_EQ(unset_outputs(motion), "The devices do not set these outputs: do3 to true.");
  EXPECT_EQ(unset_outputs(can_task().motion), "");
}

TEST(MotionParts, AreOneRestIfAProgramOnlySetsOutputs) {
  planning::Motion motion = can_task().motion;
  motion.stages = {{.name = "output", .step = "set do3 to true"}};
  motion.stages.back().output = geometric::OutputStep{"do3", true};
  const std::vector<MotionPart> parts = parts_of(motion, std::vector<planning::SceneState>(1));
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_TRUE(parts[0].rests);
}

/// A motion of one joint in two parts of 0.3 s each, on a device without wires.
class TwoParts : public testing::Test {
 protected:
  TwoParts() {
    auto device = std::make_unique<FakeDevice>("joint");
    device_ = device.get();
    device->connect();
    targets_.push_back({"arm", {0}, std::move(device)});
    parts_ = {part("first", 0.0, 0.2), part("second", 0.2, 0.4)};
    requests_.stop = stop_.get_token();
  }

  static MotionPart part(const std::string& name, double from, double to) {
    MotionPart part{.name = name, .trajectory = {}, .scene = nullptr};
    for (const double time : {0.0, 0.3}) {
      part.trajectory.points.push_back(
          {time, Configuration::Constant(1, time == 0.0 ? from : to), {}, {}});
    }
    return part;
  }
  MotionOutcome run() { return run_parts(targets_, parts_, {}, requests_, watcher_); }

  FakeDevice* device_ = nullptr;
  std::vector<MotionTarget> targets_;
  std::vector<MotionPart> parts_;
  std::stop_source stop_;
  MotionRequests requests_;
  Watcher watcher_;
  std::jthread resuming_;
};

TEST_F(TwoParts, RunOneAfterTheOtherOnOneTimeAxis) {
  const MotionOutcome outcome = run();
  EXPECT_TRUE(outcome.done) << outcome.fault;
  EXPECT_NEAR(outcome.time, 0.6, 0.05);
  EXPECT_NEAR(device_->measured().position[0], 0.4, 0.01);
  EXPECT_THAT(watcher_.parts, ElementsAre(0, 1));
  EXPECT_TRUE(std::ranges::is_sorted(watcher_.samples, {}, &MotionSample::time));
}

TEST_F(TwoParts, WaitBetweenThemWhileHeld) {
  watcher_.part = [&](std::size_t part) {
    requests_.hold = part == 1;
    if (part == 1) {
      resuming_ = std::jthread([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        EXPECT_NEAR(device_->measured().position[0], 0.2, 0.01) << "it rests";
        requests_.hold = false;
      });
    }
  };
  const auto begin = std::chrono::steady_clock::now();
  const MotionOutcome outcome = run();
  EXPECT_TRUE(outcome.done) << outcome.fault;
  EXPECT_GT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(750));
}

TEST_F(TwoParts, RestBetweenThem) {
  MotionPart rest = part("wait", 0.2, 0.2);
  rest.rests = true;
  parts_.insert(parts_.begin() + 1, rest);
  const MotionOutcome outcome = run();
  EXPECT_TRUE(outcome.done) << outcome.fault;
  EXPECT_NEAR(outcome.time, 0.9, 0.05);
  EXPECT_THAT(watcher_.parts, ElementsAre(0, 1, 2));
  const auto rests = [](const MotionSample& sample) {
    return sample.time > 0.35 && sample.time < 0.55;
  };
  EXPECT_GT(std::ranges::count_if(watcher_.samples, rests), 10);
  for (const MotionSample& sample : watcher_.samples) {
    if (rests(sample)) {
      EXPECT_NEAR(sample.measured[0], 0.2, 0.01);
    }
  }
  EXPECT_TRUE(std::ranges::is_sorted(watcher_.samples, {}, &MotionSample::time));
}

TEST_F(TwoParts, RestLongerWhileHeld) {
  MotionPart rest = part("wait", 0.0, 0.0);
  rest.rests = true;
  parts_.insert(parts_.begin(), rest);
  watcher_.part = [&](std::size_t part) {
    requests_.hold = part == 0;
    if (part == 0) {
      resuming_ = std::jthread([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        requests_.hold = false;
      });
    }
  };
  const auto begin = std::chrono::steady_clock::now();
  const MotionOutcome outcome = run();
  EXPECT_TRUE(outcome.done) << outcome.fault;
  EXPECT_NEAR(outcome.time, 0.9, 0.05) << "the time of a hold does not count";
  EXPECT_GT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(1050));
}

TEST_F(TwoParts, MoveNothingIfTheyAreStoppedInAFirstRest) {
  MotionPart rest = part("wait", 0.0, 0.0);
  rest.rests = true;
  parts_.insert(parts_.begin(), rest);
  watcher_.progress = [&](double time) {
    if (time > 0.1) {
      stop_.request_stop();
    }
  };
  const MotionOutcome outcome = run();
  EXPECT_FALSE(outcome.done);
  EXPECT_FALSE(outcome.started);
  EXPECT_THAT(watcher_.parts, ElementsAre(0));
  EXPECT_EQ(device_->measured().position[0], 0.0);
}

TEST_F(TwoParts, EndIfAJointLeavesItsPlaceInARest) {
  MotionPart rest = part("wait", 0.5, 0.5);
  rest.rests = true;
  parts_.insert(parts_.begin(), rest);
  const MotionOutcome outcome = run();
  EXPECT_FALSE(outcome.done);
  EXPECT_THAT(outcome.fault, HasSubstr("0.5000 rad from where it has to wait"));
  EXPECT_GE(device_->stops, 1);
}

TEST_F(TwoParts, EndWhereASecondPartCantBegin) {
  watcher_.part = [&](std::size_t part) { device_->throws_in = part == 1 ? "start" : ""; };
  const MotionOutcome outcome = run();
  EXPECT_FALSE(outcome.done);
  EXPECT_TRUE(outcome.started);
  EXPECT_THAT(outcome.fault, HasSubstr("start went wrong"));
  EXPECT_GE(device_->stops, 1);
}

TEST_F(TwoParts, StopAtOnce) {
  watcher_.progress = [&](double time) {
    if (time > 0.4) {
      stop_.request_stop();
    }
  };
  const MotionOutcome outcome = run();
  EXPECT_FALSE(outcome.done);
  EXPECT_LT(device_->measured().position[0], 0.35);
}

TEST_F(TwoParts, LetAnObjectBlockAJointThatHoldsIt) {
  device_->blocked_at = 0.25;
  parts_[1].give = Configuration::Constant(1, 0.2);
  const MotionOutcome held = run();
  EXPECT_TRUE(held.done) << held.fault;
  EXPECT_LT(held.errors[0].max().maxCoeff(), 0.05) << "that is no error";
}

TEST_F(TwoParts, FailIfSomethingElseBlocksAJoint) {
  device_->blocked_at = 0.25;
  const MotionOutcome blocked = run();
  EXPECT_FALSE(blocked.done);
  EXPECT_THAT(blocked.fault, HasSubstr("did not run the whole motion"));
}

}  // namespace
}  // namespace handway::execution
