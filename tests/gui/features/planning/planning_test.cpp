#include "window_test.h"

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QTimer>

#include <algorithm>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

class PlanningInTheWindow : public WindowTest {};

TEST_F(PlanningInTheWindow, SaysInWordsThatAPathWasFound) {
  open(cell().post());
  plan();
  EXPECT_THAT(result(), HasSubstr("Path found"));
  EXPECT_THAT(result(), HasSubstr("Clearance"));
  EXPECT_GE(window().player().timeline().path().waypoints.size(), 3U) << "around the post";
  EXPECT_TRUE(part<QPushButton>("plan").isEnabled());
  EXPECT_FALSE(part<QPushButton>("cancel").isEnabled());
}

TEST_F(PlanningInTheWindow, UsesThePrincipalDirectionsOfTheHand) {
  open(cell().post());
  window().workbench().plan_settings.choose_planner("pmd-rrt-connect");
  plan();
  EXPECT_THAT(result(), HasSubstr("Path found"));
}

TEST_F(PlanningInTheWindow, SaysWhyThereIsNoPath) {
  open(cell().goal_in_wall());
  plan();
  EXPECT_THAT(result(), HasSubstr("The goal is not valid"));
  EXPECT_THAT(result(), HasSubstr("wall"));
  EXPECT_TRUE(window().player().timeline().empty());
}

TEST_F(PlanningInTheWindow, ReactsWhileItPlans) {
  open(cell().wall());
  click("plan");
  QTimer heartbeat;
  int beats = 0;
  QObject::connect(&heartbeat, &QTimer::timeout, [&] { ++beats; });
  heartbeat.start(10);
  EXPECT_TRUE(QTest::qWaitFor([&] { return beats >= 40; }, 10000));
  EXPECT_TRUE(window().session().is_running());
  EXPECT_TRUE(part<QProgressBar>("progress").isVisible());
  EXPECT_THAT(result(), HasSubstr("Planning"));
  click("cancel");
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().session().is_running(); }));
}

TEST_F(PlanningInTheWindow, EndsWhenAnotherSceneIsOpened) {
  open(cell().wall());
  click("plan");
  open(cell().post());
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().session().is_running(); }, 1000));
  plan();
  EXPECT_THAT(result(), HasSubstr("Path found"));
}

TEST_F(PlanningInTheWindow, MayBeClosedWhileItGoesOn) {
  open(cell().wall());
  click("plan");
  QTest::qWait(50);
  window().close();
}

}  // namespace
}  // namespace handway::test
