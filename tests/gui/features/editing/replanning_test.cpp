#include "features/editing/editing_test.h"
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway_test/resource_use.h"

#include <QSignalSpy>
#include <QTimer>

#include <algorithm>
#include <ctime>
#include <vector>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

class ReplanningLive : public EditingTest {
 protected:
  void wait_for_path() {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window().session().is_replanning(); }, 8000));
  }
  void expect_free_path() {
    const planning::Path& path = window().player().timeline().path();
    ASSERT_FALSE(path.waypoints.empty());
    const auto checker = geometric::make_collision_checker(
        std::make_shared<const geometric::CollisionWorld>(scene()));
    for (const geometric::Configuration& q : path.waypoints) {
      EXPECT_FALSE(checker->first_collision(q));
    }
  }
  void try_post_at(double x, double y) const {
    window().session().try_scene(
        planning::with_changed_object(editor().state(), "post", [&](geometric::SceneObject& post) {
          post.X_PO.translation().head<2>() = Eigen::Vector2d(x, y);
        }));
  }
};

TEST_F(ReplanningLive, LeadsThePathAroundWhatIsMoved) {
  plan();
  const auto before = window().player().timeline().path().waypoints;
  select("post");
  geometric::Pose moved = object("post").X_PO;
  moved.translation().head<2>() = Eigen::Vector2d(0.36, 0.40);
  editor().place(moved);
  wait_for_path();
  expect_free_path();
  EXPECT_THAT(result(), HasSubstr("Path follows the scene"));
  actions().undo->trigger();
  wait_for_path();
  expect_free_path();
}

TEST_F(ReplanningLive, EditsAndPlansOncePerDrop) {
  plan();
  select("post");
  geometric::Pose moved = object("post").X_PO;
  moved.translation().y() += 0.01;
  const QSignalSpy edited(&window().document(), &gui::Document::edited);
  const QSignalSpy replanned(&window().session(), &gui::PlanningSession::replanned);
  editor().place(moved);
  wait_for_path();
  QTest::qWait(100);
  EXPECT_EQ(edited.count(), 1);
  EXPECT_EQ(replanned.count(), 1);
  EXPECT_EQ(window().player().made_from(), window().document().revision());
  EXPECT_TRUE(object("post").X_PO.isApprox(moved));
}

TEST_F(ReplanningLive, FollowsADragWithoutHoldingTheWindowUp) {
  plan();
  // The window's own work counts, however many programs share the machine.
  QTimer heartbeat;
  double last = 1e3 * cpu_seconds();
  std::vector<double> busy;
  QObject::connect(&heartbeat, &QTimer::timeout, [&] {
    busy.push_back(1e3 * cpu_seconds() - last);
    last += busy.back();
  });
  heartbeat.start(1);
  for (int step = 0; step < 40; ++step) {
    try_post_at(0.41 - 0.002 * step, 0.38 + 0.001 * step);
    QTest::qWait(15);
  }
  wait_for_path();
  ASSERT_FALSE(busy.empty());
  std::ranges::sort(busy);
  EXPECT_LT(busy[busy.size() * 95 / 100], 50.0) << "ms of work without an answer";
  EXPECT_THAT(result(), HasSubstr("Path follows the scene"));
}

TEST_F(ReplanningLive, SaysWhenThereIsNoPathAnyMore) {
  plan();
  const auto before = window().player().timeline().path().waypoints;
  try_post_at(0.3, 0.0);  // into the arm at start
  wait_for_path();
  EXPECT_THAT(result(), HasSubstr("No path in the present scene"));
  EXPECT_EQ(window().player().timeline().path().waypoints, before) << "the last one stays";
  try_post_at(0.41, 0.38);
  wait_for_path();
  EXPECT_THAT(result(), HasSubstr("Path follows the scene"));
}

TEST_F(ReplanningLive, EndsWhenTheRobotIsMoved) {
  plan();
  editor().select({gui::SceneItem::Kind::kRobot, "arm", ""});
  editor().place(geometric::Pose(Eigen::Translation3d(0.0, 0.0, 0.2)));
  EXPECT_TRUE(QTest::qWaitFor([&] { return window().player().timeline().empty(); }));
}

TEST(ProblemUpdate, GivesTheWorldOfTheChangedScene) {
  const SmallCell cell;
  const planning::PluginManager plugins;
  const planning::SceneState loaded = planning::load_scene(cell.post(), plugins);
  const planning::PlanningProblem before = planning::make_problem(loaded.scene, loaded.basis);
  planning::SceneState state{loaded.scene};
  geometric::SceneObject ball;
  ball.name = "ball";
  ball.shape = geometric::Sphere{0.1};
  ball.X_PO.translation().x() = 0.5;
  state = planning::with_object(state, ball);
  state = planning::with_changed_object(
      state, "post", [](geometric::SceneObject& post) { post.X_PO.translation().z() += 0.3; });
  const planning::PlanningProblem updated =
      planning::updated_problem(before, state.scene, loaded.basis);
  const planning::PlanningProblem anew = planning::make_problem(state.scene, loaded.basis);
  const auto names = [](const planning::PlanningProblem& problem) {
    std::vector<std::string> all;
    for (const auto& body : problem.checker->world().bodies()) {
      all.push_back(body.name);
    }
    return all;
  };
  EXPECT_EQ(names(updated), names(anew));
  EXPECT_EQ(updated.checker->world().pairs().size(), anew.checker->world().pairs().size());
  const auto a = updated.checker->clone(), b = anew.checker->clone();
  for (const double turn : {0.0, 0.5, 1.0}) {
    geometric::Configuration q = loaded.scene->robots.front().configuration;
    q[0] = turn;
    EXPECT_EQ(a->first_collision(q).has_value(), b->first_collision(q).has_value());
  }
}

TEST(ProblemUpdate, KnowsConstraints) {
  const SmallCell cell;
  const planning::PluginManager plugins;
  const planning::SceneState loaded = planning::load_scene(cell.post(), plugins);
  const planning::PlanningProblem before = planning::make_problem(loaded.scene, loaded.basis);
  planning::SceneState state = planning::with_constraint(
      {loaded.scene},
      {"ahead", "palm",
       geometric::OrientationConstraint{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX(), 0.5}});
  const planning::PlanningProblem constrained =
      planning::updated_problem(before, state.scene, loaded.basis);
  geometric::Configuration turned = *loaded.scene->start;
  turned[0] = 0.6;
  EXPECT_TRUE(constrained.checker->clone()->first_collision(turned));
  EXPECT_FALSE(before.checker->clone()->first_collision(turned));
  EXPECT_TRUE(planning::updated_problem(constrained, loaded.scene, loaded.basis)
                  .checker->world()
                  .constraints()
                  .empty());
}

TEST(ProblemUpdate, KnowsWhatIsHollow) {
  const SmallCell cell;
  const planning::PluginManager plugins;
  const planning::SceneState loaded = planning::load_scene(cell.post(), plugins);
  const auto around = [&](bool solid) -> planning::SceneState {
    return {planning::with_changed_object({loaded.scene}, "post",
                                          [&](geometric::SceneObject& post) {
                                            post.shape = geometric::Box{{9.0, 9.0, 9.0}};
                                            post.solid = solid;
                                          })
                .scene,
            loaded.basis};
  };
  const planning::PlanningProblem inside = planning::make_problem(around(true).scene, loaded.basis);
  EXPECT_TRUE(inside.checker->clone()->first_collision(inside.start));
  const planning::PlanningProblem hollow =
      planning::updated_problem(inside, around(false).scene, loaded.basis);
  EXPECT_FALSE(hollow.checker->clone()->first_collision(hollow.start));
}

}  // namespace
}  // namespace handway::test
