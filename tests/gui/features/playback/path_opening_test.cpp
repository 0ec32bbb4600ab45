#include "features/editing/editing_test.h"
#include "handway/planning/paths/path_file.h"
#include "patience.h"
#include "widgets/panels/floating_card.h"

#include <QAction>
#include <QDropEvent>
#include <QLabel>
#include <QMimeData>
#include <QSignalSpy>

#include <fstream>

namespace handway::test {
namespace {

using gui::PathValidity;
using ::testing::HasSubstr;

/// A path aside of the post, as a controller of the arm has it.
constexpr const char* kArmPath = "time,shoulder,elbow\n0,0,0\n1,-0.2,-0.5\n2,0,-0.5\n3,0,0\n";
/// Straight through the post.
constexpr const char* kThroughThePost = "time,shoulder,elbow\n0,0,0\n1,1.5,0\n";

class PathOpening : public EditingTest {
 protected:
  [[nodiscard]] QString file(const char* name, const std::string& content) const {
    std::ofstream(cell().folder() / name) << content;
    return QString::fromStdString((cell().folder() / name).string());
  }
  [[nodiscard]] gui::Workbench& workbench() const { return window().workbench(); }
  void open_path(const QString& path) const { emit workbench().path_dropped(path); }
  [[nodiscard]] bool becomes(PathValidity::State state) const {
    return QTest::qWaitFor([&] { return workbench().validity.state() == state; }, kPatienceMs);
  }
  [[nodiscard]] std::string text(const char* label) const {
    return part<QLabel>(label).text().toStdString();
  }
};

TEST_F(PathOpening, ShowsAPathThatIsValidAsIfItHadBeenPlanned) {
  const auto& to_export = part<QAction>("export_path");
  EXPECT_FALSE(to_export.isEnabled());
  open_path(file("arm.csv", kArmPath));
  ASSERT_TRUE(becomes(PathValidity::State::kValid)) << text("path_validity");
  EXPECT_EQ(window().player().timeline().path().waypoints.size(), 4U);
  EXPECT_TRUE(to_export.isEnabled());
  EXPECT_THAT(result(), HasSubstr("Opened arm.csv: 4 waypoints"));
  EXPECT_THAT(result(), HasSubstr("left, right stay at the start"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return !workbench().history.paths().empty(); }, kPatienceMs));
  EXPECT_THAT(workbench().history.paths().front().label.toStdString(), HasSubstr("arm.csv"));
  keep_picture("path_opened");
}

TEST_F(PathOpening, IsWhatTheExportWrites) {
  plan();
  const planning::Path planned = window().player().timeline().path();
  const std::filesystem::path written = cell().folder() / "written.csv";
  planning::write_path_csv(planned, *window().document().robot()->model, written);
  open_path(QString::fromStdString(written.string()));
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench().session.opened_from() == "written.csv"; },
                              kPatienceMs));
  EXPECT_EQ(window().player().timeline().path().waypoints, planned.waypoints);
  EXPECT_TRUE(becomes(PathValidity::State::kValid));
}

TEST_F(PathOpening, NeitherExportsNorClearsAPathThatHitsSomething) {
  open_path(file("through.csv", kThroughThePost));
  ASSERT_TRUE(becomes(PathValidity::State::kInvalid));
  EXPECT_THAT(text("path_validity"), HasSubstr("Not valid in this scene"));
  EXPECT_THAT(text("path_validity"), HasSubstr("post"));
  EXPECT_FALSE(part<QAction>("export_path").isEnabled());
}

TEST_F(PathOpening, KeepsThePathWhileTheSceneIsEditedAndChecksItAgain) {
  open_path(file("through.csv", kThroughThePost));
  ASSERT_TRUE(becomes(PathValidity::State::kInvalid));
  const auto waypoints = window().player().timeline().path().waypoints;
  select("post");
  geometric::Pose aside = object("post").X_PO;
  aside.translation().head<2>() = Eigen::Vector2d(-0.9, -0.9);
  editor().place(aside);
  EXPECT_TRUE(becomes(PathValidity::State::kValid)) << text("path_validity");
  EXPECT_EQ(window().player().timeline().path().waypoints, waypoints);
  actions().undo->trigger();
  EXPECT_TRUE(becomes(PathValidity::State::kInvalid));
  EXPECT_EQ(window().player().timeline().path().waypoints, waypoints);
}

TEST_F(PathOpening, GivesWayToAPlannedPath) {
  open_path(file("arm.csv", kArmPath));
  ASSERT_TRUE(becomes(PathValidity::State::kValid));
  plan();
  EXPECT_TRUE(workbench().session.opened_from().isEmpty());
  EXPECT_THAT(result(), ::testing::Not(HasSubstr("arm.csv")));
}

TEST_F(PathOpening, SaysWhereThePathBeginsElsewhere) {
  open_path(file("elsewhere.csv", "time,shoulder,elbow\n0,0,2.2\n1,-0.2,2.2\n"));
  ASSERT_TRUE(becomes(PathValidity::State::kValid));
  EXPECT_THAT(result(), HasSubstr("does not begin at the scene's start"));
}

TEST_F(PathOpening, SaysWhatIsWrongWithAFileAndKeepsThePathThatIsShown) {
  plan();
  const auto waypoints = window().player().timeline().path().waypoints;
  QSignalSpy failed(&workbench(), &gui::Workbench::failed);
  open_path(file("wrong.csv", "time,knee\n0,0\n"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !failed.isEmpty(); }, kPatienceMs));
  EXPECT_THAT(failed.front().front().toString().toStdString(), HasSubstr("wrong.csv:1"));
  EXPECT_TRUE(workbench().banner.isVisible());
  EXPECT_EQ(window().player().timeline().path().waypoints, waypoints);
}

TEST_F(PathOpening, TakesAFileThatIsDroppedOnTheWindow) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(file("arm.csv", kArmPath))});
  const QPoint place(400, 300);
  QDragEnterEvent enter(place, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&window(), &enter);
  QDropEvent drop(place, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&window(), &drop);
  EXPECT_TRUE(becomes(PathValidity::State::kValid));
  EXPECT_EQ(window().player().timeline().path().waypoints.size(), 4U);
}

TEST_F(PathOpening, NeedsASceneWithARobot) {
  workbench().close();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window().document().scene(); }, kPatienceMs));
  EXPECT_FALSE(part<QAction>("open_path").isEnabled());
}

}  // namespace
}  // namespace handway::test
