#include "handway_test/solid_robots.h"
#include "model/document/prepared_problem.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <thread>
#include <vector>

namespace handway::gui {
namespace {

// A job that runs until it isn't wanted, and says when it has begun.
struct Endless {
  std::stop_source wanted;
  std::promise<void> begun;

  void queue_in(PreparationQueue& queue) {
    queue.run(wanted, [this] {
      begun.set_value();
      while (!wanted.stop_requested()) {
        std::this_thread::yield();
      }
    });
    begun.get_future().wait();
  }
};

TEST(PreparationQueue, BeginsNothingThatWasReplacedWhileItWaited) {
  PreparationQueue queue;
  Endless first;
  first.queue_in(queue);
  std::atomic<int> begun = 0;
  std::stop_source wanted;
  for (int i = 0; i < 100; ++i) {
    wanted.request_stop();
    wanted = std::stop_source();
    queue.run(wanted, [&begun] { ++begun; });
  }
  std::promise<void> done;
  wanted.request_stop();
  queue.run({}, [&] { done.set_value(); });
  first.wanted.request_stop();
  done.get_future().wait();
  EXPECT_EQ(begun, 0);
}

TEST(PreparationQueue, TakesTheNewestFirst) {
  PreparationQueue queue;
  Endless first;
  first.queue_in(queue);
  std::vector<int> order;
  std::promise<void> done;
  for (int i = 0; i < 3; ++i) {
    queue.run({}, [&, i] {
      order.push_back(i);
      if (order.size() == 3) {
        done.set_value();
      }
    });
  }
  first.wanted.request_stop();
  done.get_future().wait();
  EXPECT_EQ(order, (std::vector{2, 1, 0}));
}

TEST(PreparationQueue, StopsWhatRunsAndWhatWaitsAtItsEnd) {
  Endless first;
  std::stop_source waiting;
  bool ran = false;
  {
    PreparationQueue queue;
    first.queue_in(queue);
    queue.run(waiting, [&] { ran = true; });
  }
  EXPECT_TRUE(first.wanted.stop_requested());
  EXPECT_TRUE(waiting.stop_requested());
  EXPECT_FALSE(ran);
}

planning::SceneState with_can(double radius) {
  auto scene = std::make_shared<geometric::Scene>(test::scene_of(test::planar_hand_arm()));
  test::add_object(*scene, "can", geometric::Cylinder{radius, 0.2}, Eigen::Vector3d(2, 0, 0));
  return {scene, nullptr};
}

double radius_in(const PreparedProblem::Problem& problem) {
  return std::get<geometric::Cylinder>(problem->scene->objects.front().shape).radius;
}

// To prepare each of them takes a tenth of a second.
TEST(PreparedProblem, IsThatOfTheLastOfManyEdits) {
  PreparationQueue queue;
  auto problem =
      std::make_shared<const PreparedProblem>(with_can(0.1), planning::Revision{}, queue);
  for (int i = 1; i <= 200; ++i) {
    problem = std::make_shared<const PreparedProblem>(with_can(0.1 + 1e-3 * i),
                                                      planning::Revision{}, queue, problem.get());
  }
  EXPECT_DOUBLE_EQ(radius_in(problem->wait({})), 0.3);
}

TEST(PreparedProblem, IsMadeForThoseWhoHoldAnOlderOne) {
  PreparationQueue queue;
  const PreparedProblem older(with_can(0.1), planning::Revision{}, queue);
  const PreparedProblem newer(with_can(0.2), planning::Revision{}, queue, &older);
  EXPECT_DOUBLE_EQ(radius_in(newer.wait({})), 0.2);
  EXPECT_DOUBLE_EQ(radius_in(older.wait({})), 0.1);
}

TEST(PreparedProblem, IsNoneAfterTheQueueHasEnded) {
  auto queue = std::make_unique<PreparationQueue>();
  Endless first;
  first.queue_in(*queue);
  const PreparedProblem waiting(with_can(0.1), planning::Revision{}, *queue);
  queue.reset();
  EXPECT_EQ(waiting.wait({}), nullptr);
  EXPECT_EQ(waiting.if_ready(), nullptr);
}

}  // namespace
}  // namespace handway::gui
