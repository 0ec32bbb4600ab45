#include "features/editing/scene_editing.h"
#include "handway/planning/extensions/load_scene.h"
#include "model/planning/path_history.h"
#include "widgets/panels/run_table.h"
#include "window_test.h"

#include <QDockWidget>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTableView>
#include <QUndoStack>

#include <cmath>

namespace handway::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class RunsInTheWindow : public WindowTest {
 protected:
  [[nodiscard]] const std::vector<gui::PathRecord>& records() const {
    return window().workbench().history.records();
  }
  [[nodiscard]] std::vector<geometric::Configuration> shown_path() const {
    return window().player().timeline().path().waypoints;
  }
  [[nodiscard]] QAbstractItemModel& rows() const { return *part<QTableView>("runs_table").model(); }
  [[nodiscard]] QString cell_text(int row, gui::RunTable::Column column) const {
    return rows().index(row, column).data().toString();
  }
  [[nodiscard]] QUndoStack& edits() const { return window().editor().undo_stack(); }
  // The row of a run, restored by a double click.
  void restore(int number) const {
    auto& table = part<QTableView>("runs_table");
    for (int row = 0; row < rows().rowCount(); ++row) {
      if (cell_text(row, gui::RunTable::kNumber).toInt() == number) {
        table.selectRow(row);
        click("runs_restore");
        return;
      }
    }
    FAIL() << "no run " << number;
  }
  void plan_seeds(int seeds) const {
    part<QSpinBox>("seeds").setValue(seeds);
    QSignalSpy ended(&window().session(), &gui::PlanningSession::ended);
    click("plan");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !ended.isEmpty(); }, 60000));
  }
};

TEST_F(RunsInTheWindow, AreListedWithWhatCameOfThem) {
  open(cell().post());
  window().workbench().plan_settings.choose_planner("pmd-rrt-connect");
  plan();
  show_dock("runs");
  ASSERT_EQ(rows().rowCount(), 1);
  EXPECT_EQ(cell_text(0, gui::RunTable::kNumber), QStringLiteral("1"));
  EXPECT_EQ(cell_text(0, gui::RunTable::kPlanner), QStringLiteral("pmd-rrt-connect"));
  EXPECT_EQ(cell_text(0, gui::RunTable::kPreset), QStringLiteral("Balanced"));
  EXPECT_EQ(cell_text(0, gui::RunTable::kSeed), QStringLiteral("1"));
  EXPECT_EQ(cell_text(0, gui::RunTable::kOutcome), QStringLiteral("Path found"));
  EXPECT_NE(cell_text(0, gui::RunTable::kLength), QStringLiteral("–"));
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return cell_text(0, gui::RunTable::kDuration) != QStringLiteral("–"); }, 8000))
      << "once it is timed";
  EXPECT_EQ(records().size(), 1U) << "its motion is the run's";
}

TEST_F(RunsInTheWindow, AreListedWhenThereIsNoPath) {
  open(cell().goal_in_wall());
  plan();
  ASSERT_EQ(rows().rowCount(), 1);
  EXPECT_EQ(cell_text(0, gui::RunTable::kOutcome), QStringLiteral("The goal is not valid"));
  EXPECT_EQ(cell_text(0, gui::RunTable::kLength), QStringLiteral("–"));
}

TEST_F(RunsInTheWindow, ArePutBackAndGiveTheIdenticalPathAgain) {
  open(cell().post());
  gui::PlanSettings& settings = window().workbench().plan_settings;
  settings.choose_planner("pmd-rrt-connect");
  part<QSpinBox>("smoothing_checks").setValue(17);
  settings.set_seed(5);
  plan();
  const std::vector<geometric::Configuration> first = shown_path();
  const geometric::Configuration goal = *window().document().scene()->goal;
  show_dock("runs");

  settings.choose_planner("rrt-connect");
  settings.set_seed(9);
  settings.set_seeds(4);
  geometric::Configuration other = goal;
  other[0] -= 0.1;
  window().editor().set_goal(other);
  plan_seeds(1);
  ASSERT_NE(shown_path(), first);

  restore(1);
  EXPECT_EQ(settings.planner()->name(), "pmd-rrt-connect");
  EXPECT_EQ(part<QSpinBox>("smoothing_checks").value(), 17);
  EXPECT_EQ(settings.request().seed, 5U);
  EXPECT_EQ(settings.seeds(), 1);
  EXPECT_EQ(*window().document().scene()->goal, goal);
  EXPECT_EQ(shown_path(), first);
  EXPECT_THAT(result(), AllOf(HasSubstr("Run 1, restored"), HasSubstr("Path found")));

  plan();
  EXPECT_EQ(shown_path(), first) << "to the last bit";
  EXPECT_EQ(rows().rowCount(), 3);

  restore(2);
  EXPECT_EQ(*window().document().scene()->goal, other);
  edits().undo();
  EXPECT_EQ(*window().document().scene()->goal, goal) << "what was restored is undone";
}

TEST_F(RunsInTheWindow, WithSeveralSeedsShowTheBest) {
  open(cell().post());
  window().workbench().plan_settings.choose_planner("rrt-connect");
  part<QSpinBox>("smoothing_checks").setValue(0);
  plan_seeds(6);
  ASSERT_EQ(rows().rowCount(), 6);
  const gui::PathRecord* shortest = &records().front();
  std::vector<std::uint64_t> seeds;
  for (const gui::PathRecord& record : records()) {
    ASSERT_TRUE(record.has_figures());
    seeds.push_back(record.run->request.seed);
    if (record.figures->length < shortest->figures->length) {
      shortest = &record;
    }
  }
  EXPECT_THAT(seeds, ::testing::UnorderedElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(shown_path(), shortest->run->result.path.waypoints);
  EXPECT_THAT(result(), AllOf(HasSubstr("Best path (shortest): seed " +
                                        std::to_string(shortest->run->request.seed)),
                              HasSubstr("6 paths from 6 seeds")));
  EXPECT_TRUE(part<QDockWidget>("runs").isHidden()) << "the view keeps its place";
  click("all_runs");
  EXPECT_FALSE(part<QDockWidget>("runs").isHidden());

  const auto best_run = shortest->run;
  window().workbench().plan_settings.set_seeds(1);
  window().workbench().plan_settings.set_seed(best_run->request.seed);
  plan();
  EXPECT_EQ(shown_path(), best_run->result.path.waypoints) << "the same alone";
}

TEST_F(RunsInTheWindow, WithSeveralSeedsAreCancelledAtOnce) {
  open(cell().wall());
  part<QSpinBox>("seeds").setValue(50);
  QSignalSpy ended(&window().session(), &gui::PlanningSession::ended);
  click("plan");
  QTest::qWait(100);
  ASSERT_TRUE(window().session().is_running());
  click("cancel");
  EXPECT_FALSE(ended.isEmpty()) << "before anything else happens";
  EXPECT_FALSE(window().session().is_running());
  EXPECT_THAT(result(), HasSubstr("of 50 seeds, then cancelled"));
  EXPECT_TRUE(part<QPushButton>("plan").isEnabled());
  open(cell().post());
  plan_seeds(2);
  EXPECT_THAT(result(), HasSubstr("2 paths from 2 seeds"));
}

TEST_F(RunsInTheWindow, WithSeveralSeedsSayWhatStoodInTheWay) {
  open(cell().wall());
  window().workbench().plan_settings.choose_planner("auto");
  part<QSpinBox>("max_samples").setValue(400);
  plan_seeds(3);
  EXPECT_THAT(result(), AllOf(HasSubstr("No path from 3 seeds"), HasSubstr("wall")));
}

TEST_F(RunsInTheWindow, OfAnotherSceneAreNotListed) {
  open(cell().post());
  plan();
  ASSERT_EQ(rows().rowCount(), 1);
  open(cell().post());
  EXPECT_EQ(rows().rowCount(), 0);
  EXPECT_FALSE(part<QPushButton>("runs_restore").isEnabled());
  plan();
  EXPECT_EQ(cell_text(0, gui::RunTable::kNumber), QStringLiteral("2"));
}

TEST(Turning, IsTheSumOfTheAnglesAtWaypoints) {
  const SmallCell cell;
  const auto scene = planning::load_scene(cell.post(), planning::PluginManager()).scene;
  const geometric::RobotModel& model = *scene->robots.front().model;
  const geometric::Configuration q = scene->robots.front().configuration;
  planning::Path path;
  path.waypoints = {q, q, q, q};
  const auto step = [&](int joint) { return 0.1 * (model.upper()[joint] - model.lower()[joint]); };
  path.waypoints[1][0] += step(0);
  path.waypoints[2][0] += 2.0 * step(0);
  EXPECT_NEAR(gui::turning_of(model, path), std::acos(-1.0), 1e-6) << "and back";
  path.waypoints[3] = path.waypoints[2];
  path.waypoints[3][1] += step(1);
  EXPECT_NEAR(gui::turning_of(model, path), std::acos(-1.0) / 2.0, 1e-6);
}

TEST(BestOfSeveral, AreThosePathsThatCostLeast) {
  const auto record = [](std::uint64_t seed, bool solved, double length, double duration) {
    auto run = std::make_shared<gui::PlanRun>();
    run->request.seed = seed;
    run->result.status = solved ? planning::PlanStatus::kSolved : planning::PlanStatus::kTimeLimit;
    gui::PathRecord one;
    one.run = run;
    one.figures.emplace();
    one.figures->length = length;
    one.figures->duration = duration;
    return one;
  };
  const std::vector<gui::PathRecord> records{record(4, true, 2.0, 1.0), record(3, true, 1.0, 3.0),
                                             record(2, true, 1.0, 3.0), record(1, false, 0.0, 0.0)};
  EXPECT_EQ(gui::best_of(records, gui::PathMerit::kShort)->run->request.seed, 2U);
  EXPECT_EQ(gui::best_of(records, gui::PathMerit::kQuick)->run->request.seed, 4U);
  const std::vector<gui::PathRecord> none{record(1, false, 0.0, 0.0)};
  EXPECT_EQ(gui::best_of(none, gui::PathMerit::kShort), none.end());
}

}  // namespace
}  // namespace handway::test
