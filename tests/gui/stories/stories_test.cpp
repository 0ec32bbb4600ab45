/// A person's way through the whole window, on real robots and scenes. Each step leaves a picture
/// in the build folder, and none keeps the window from answering.
#include "features/devices/device_session.h"
#include "features/devices/devices_panel.h"
#include "handway/planning/core/objective.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/paths/path_check.h"
#include "small_cell.h"
#include "story.h"
#include "view3d/scene_view.h"

#include <QComboBox>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QTabWidget>
#include <QTableView>

#include <algorithm>
#include <fstream>
#include <map>
#include <string>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

TEST_F(Story, LiftsACanFromTheTableThatItStandsOn) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  ASSERT_EQ(window().message(), QString());
  select("can");
  geometric::Pose X_WO = *editor().selected_pose();
  X_WO.translation().z() -= geometric::gap_to_support(scene(), *editor().selected_object()).value();
  editor().place(X_WO);
  ASSERT_NEAR(geometric::gap_to_support(scene(), *editor().selected_object()).value(), 0.0, 1e-12);
  geometric::Configuration q = scene().goal.value();
  window().document().set_configuration(q);
  trigger("Set start here");
  ASSERT_TRUE(wait_for([&] { return !window().workbench().collisions.is_busy(); }));
  auto* fixed_to = window().findChild<QComboBox*>(QStringLiteral("fixed_to"));
  fixed_to->setCurrentIndex(fixed_to->findText(QStringLiteral("palm")));
  emit fixed_to->activated(fixed_to->currentIndex());
  ASSERT_TRUE(geometric::find_object(scene(), "can")->attachment);
  picture("lift_1_attached");
  q[1] -= 0.25;
  window().document().set_configuration(q);
  trigger("Set goal here");
  ASSERT_TRUE(plan());
  window().player().seek(0.5);
  picture("lift_2_half_way");
  const WatchedApplication::LooksAway checking_it_is_no_step_of_a_person;
  const planning::PathCheckResult checked = planning::check_path(
      planning::make_problem(window().document().scene(), window().document().loaded().basis),
      window().player().timeline().path(), 1e-3);
  EXPECT_TRUE(checked.valid()) << ::testing::PrintToString(checked.faults);
}

TEST_F(Story, OpensEverySceneThatIsShippedAndPlans) {
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "scenes")) {
    open(entry.path());
    ASSERT_EQ(window().message(), QString()) << entry.path();
    EXPECT_TRUE(plan()) << entry.path();
    window().player().seek(0.5);
    picture("open_" + QString::fromStdString(entry.path().stem().string()));
  }
}

TEST_F(Story, OpensThePublishedProblems) {
  HANDWAY_NEED_REFERENCE(reference);
  for (const char* name : {"_TwoCanb_new", "_CanBox_new", "_ShelfCan2_new", "-shelfT2_new"}) {
    open(reference / "auro" / (std::string("TX90_RHand_ICRA10_5PMD") + name + ".xml"));
    ASSERT_EQ(window().message(), QString()) << name;
    picture(QStringLiteral("published") + QLatin1String(name));
  }
}

TEST_F(Story, SaysWhatIsWrongWithAFileAndKeepsTheScene) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  const std::filesystem::path broken = folder_.path() / "broken.yaml";
  std::ofstream(broken) << "handway: 1\nname: Broken\nrobots:\n  - model: tx90_sah\nobject: []\n";
  open(broken);
  EXPECT_THAT(window().message().toStdString(), HasSubstr("broken.yaml:5"));
  EXPECT_EQ(scene().name, "Can on a table");
  picture("broken_file");
}

TEST_F(Story, PlansWithSeveralSeedsAndPutsARunBack) {
  open(source_dir() / "scenes" / "cans_on_desk.yaml");
  window().workbench().plan_settings.choose_planner("auto");
  window().workbench().plan_settings.set_seeds(6);
  ASSERT_TRUE(plan());
  picture("seeds_1_best");
  const auto best = window().session().shown_run();
  ASSERT_TRUE(best);
  window().workbench().plan_settings.choose_planner("rrt-connect");
  window().workbench().plan_settings.set_seeds(1);
  ASSERT_TRUE(plan());
  auto* runs = window().findChild<QTableView*>(QStringLiteral("runs_table"));
  ASSERT_EQ(runs->model()->rowCount(), 7);
  for (int row = 0; row < 7; ++row) {
    if (runs->model()->index(row, 0).data().toInt() == best->number) {
      runs->selectRow(row);
    }
  }
  window().findChild<QPushButton*>(QStringLiteral("runs_restore"))->click();
  EXPECT_EQ(window().workbench().plan_settings.planner()->name(), "auto");
  EXPECT_EQ(window().player().timeline().path().waypoints, best->result.path.waypoints);
  picture("seeds_2_restored");
  ASSERT_TRUE(plan());
  EXPECT_EQ(window().player().timeline().path().waypoints, best->result.path.waypoints);
}

/// One panel of the figure about objectives in docs/planners.md.
class ObjectiveFigure {
 public:
  void add(const QString& objective, const QImage& view, const planning::PathQuality& quality) {
    const int side = 83 * std::min(view.width(), view.height()) / 100;  // without cube and axes
    const QRect cut((view.width() - side) / 2, (view.height() - side) / 2, side, side);
    QPainter painter(&picture_);
    painter.setRenderHint(QPainter::TextAntialiasing);
    const QPoint corner((panels_ % 2) * (kWidth + kGap),
                        (panels_ / 2) * (kHeight + kCaption + kGap));
    painter.drawImage(corner, view.copy(cut).scaled(kWidth, kHeight, Qt::IgnoreAspectRatio,
                                                    Qt::SmoothTransformation));
    QFont font = painter.font();
    font.setPixelSize(17);
    font.setBold(true);
    painter.setFont(font);
    painter.drawText(QRect(corner.x() + 4, corner.y() + kHeight, kWidth, 30), Qt::AlignVCenter,
                     objective);
    font.setPixelSize(13);
    font.setBold(false);
    painter.setFont(font);
    painter.drawText(QRect(corner.x() + 4, corner.y() + kHeight + 28, kWidth, 22), Qt::AlignVCenter,
                     QStringLiteral("length %1 · hand to subspace %2 · clearance %3 mm · %4 s")
                         .arg(quality.length, 0, 'f', 2)
                         .arg(quality.human_likeness->mean, 0, 'f', 2)
                         .arg(1e3 * quality.mean_clearance, 0, 'f', 1)
                         .arg(quality.duration, 0, 'f', 2));
    ++panels_;
  }
  [[nodiscard]] const QImage& picture() const { return picture_; }

 private:
  static constexpr int kWidth = 480;
  static constexpr int kHeight = kWidth;
  static constexpr int kCaption = 54;
  static constexpr int kGap = 12;
  static QImage blank() {
    QImage image(2 * kWidth + kGap, 2 * (kHeight + kCaption) + kGap, QImage::Format_RGB32);
    image.fill(Qt::white);
    return image;
  }

  QImage picture_ = blank();
  int panels_ = 0;
};

TEST_F(Story, PlansTheSameProblemForEachObjective) {
  const SmallCell cell;
  const std::filesystem::path file = cell.folder() / "around_a_post.yaml";
  std::ofstream(file) << R"(handway: 1
name: Around a post
robots:
  - {name: arm, model: arm.urdf}
objects:
  - {name: post, box: {size: [0.06, 0.06, 0.2]}, pose: {xyz: [0.44, 0.36, 0]}, color: [0.75, 0.35, 0.2]}
  - {name: wall, box: {size: [0.04, 0.4, 0.2]}, pose: {xyz: [0.06, 0.62, 0]}, color: [0.5, 0.55, 0.6]}
start: {shoulder: 0, elbow: 0, left: 0.62, right: -0.54}
goal: {shoulder: 1.2, elbow: 0.2, left: 0.62, right: -0.54}
hand_basis: hand.yaml
)";
  open(file);
  ASSERT_EQ(window().message(), QString());
  trigger("Roadmap");
  trigger("Postures along the path");
  trigger("Closest points");
  window().view().set_camera(
      {{0.36, 0.33, 0.0}, 1.7, -geometric::radians(90.0), geometric::radians(75.0)});
  const planning::PlanningProblem problem =
      planning::make_problem(window().document().scene(), window().document().loaded().basis);
  ObjectiveFigure figure;
  std::map<std::string, planning::PathQuality> found;
  for (const char* objective : {"human-like", "shortest", "safest", "fastest"}) {
    window().workbench().plan_settings.apply(
        {"auto", {{"objective", objective}, {"optimize_checks", "100000"}}});
    ASSERT_TRUE(plan()) << objective;
    window().player().seek(0.0);
    found[objective] = path_quality(problem, window().player().timeline().path());
    QTest::qWait(300);
    const WatchedApplication::LooksAway taking_it_is_no_step_of_a_person;
    figure.add(QLatin1String(objective), window().view().grab().toImage(), found[objective]);
  }
  QDir().mkpath(QStringLiteral(HANDWAY_PICTURES));
  EXPECT_TRUE(figure.picture().save(QStringLiteral(HANDWAY_PICTURES "/objectives.png")));
  for (const auto& [objective, quality] : found) {
    const double slack = 1.02;  // all are optimised for so long, none for ever
    EXPECT_LE(found["human-like"].human_likeness->mean, slack * quality.human_likeness->mean);
    EXPECT_LE(found["shortest"].length, slack * quality.length) << objective;
    EXPECT_GE(slack * found["safest"].mean_clearance, quality.mean_clearance) << objective;
    EXPECT_LE(found["fastest"].duration, slack * quality.duration) << objective;
  }
}

TEST_F(Story, KeepsOptimisingThePathThatWasFound) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  window().workbench().plan_settings.apply(
      {"rrt-connect", {{"smoothing_checks", "0"}, {"objective", "safest"}}});
  ASSERT_TRUE(plan());
  trigger("Roadmap");
  window().view().set_camera(
      {{0.62, 0.15, 0.95}, 1.6, geometric::radians(-60.0), geometric::radians(18.0)});
  picture("optimise_1_planned");
  int better = 0;
  QObject::connect(&window().session(), &gui::PlanningSession::path_optimized, [&] { ++better; });
  QSignalSpy ended(&window().session(), &gui::PlanningSession::ended);
  trigger("Continue optimising");
  ASSERT_TRUE(wait_for([&] { return better > 1 || !ended.isEmpty(); }));
  picture("optimise_2_running");
  trigger("Cancel");
  ASSERT_TRUE(wait_for([&] { return !ended.isEmpty(); }));
  EXPECT_TRUE(ended.front().front().toBool());
  picture("optimise_3_stopped");
}

TEST_F(Story, SaysWhatStoodInTheWay) {
  open(source_dir() / "scenes" / "t_shape.yaml");
  window().workbench().plan_settings.apply({"rrt-connect", {{"max_samples", "500"}}});
  ASSERT_FALSE(plan());
  auto* result = window().findChild<QLabel*>(QStringLiteral("result"));
  EXPECT_THAT(result->text().toStdString(), HasSubstr("collided with"));
  window().view().set_camera(
      {{0.72, 0.12, 0.66}, 1.5, geometric::radians(-60.0), geometric::radians(12.0)});
  picture("no_path");
}

TEST_F(Story, CancelsAHardPlan) {
  HANDWAY_NEED_REFERENCE(reference);
  open(reference / "auro" / "TX90_RHand_ICRA10_5PMD-shelfT2_new.xml");
  window().workbench().plan_settings.choose_planner("full-prm");
  QSignalSpy ended(&window().session(), &gui::PlanningSession::ended);
  trigger("Plan");
  QTest::qWait(1000);
  picture("cancel_1_planning");
  trigger("Cancel");
  ASSERT_TRUE(wait_for([&] { return !ended.isEmpty(); }));
  EXPECT_FALSE(ended.front().front().toBool());
  picture("cancel_2_cancelled");
  window().workbench().plan_settings.choose_planner("auto");
}

TEST_F(Story, MovesEmulatedDevicesAndTellsWhatAnEditRevokes) {
  open(source_dir() / "scenes" / "can_in_box.yaml");
  select("box");
  picture("devices_1_properties");
  editor().select({});
  ASSERT_TRUE(plan());
  window().player().set_loop(false);
  gui::DevicesPanel& panel = *window().findChild<gui::DevicesPanel*>();
  const auto button = [&](const char* name) {
    return window().findChild<QAbstractButton*>(QLatin1String(name));
  };
  window().findChild<QTabWidget*>(QStringLiteral("control_tabs"))->setCurrentWidget(&panel);
  button("devices_connect")->click();
  ASSERT_TRUE(wait_for([&] { return button("devices_armed")->isEnabled(); }));
  picture("devices_2_cleared");
  button("devices_armed")->click();
  QSignalSpy ended(&window().workbench().driver, &gui::MotionDriver::ended);
  button("devices_run")->click();
  ASSERT_TRUE(wait_for([&] { return !ended.isEmpty(); }));
  auto* outcome = window().findChild<QLabel*>(QStringLiteral("devices_outcome"));
  ASSERT_TRUE(wait_for([&] { return outcome->text().contains(QStringLiteral("Done in")); }));
  picture("devices_3_done");
  geometric::SceneObject wall;
  wall.name = "wall";
  wall.shape = geometric::Box{{1.5, 0.02, 3.0}};
  wall.X_PO.translation() = Eigen::Vector3d(0.6, 0.3, 1.0);
  editor().apply("Add a wall", planning::with_object(editor().state(), wall), {"wall"});
  EXPECT_FALSE(button("devices_armed")->isEnabled());
  auto* motion = window().findChild<QLabel*>(QStringLiteral("devices_motion"));
  EXPECT_TRUE(wait_for([&] { return motion->text().contains(QStringLiteral("wall")); }));
  picture("devices_4_out_of_date");
}

}  // namespace
}  // namespace handway::test
