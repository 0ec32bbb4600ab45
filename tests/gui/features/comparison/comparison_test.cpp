#include "features/comparison/comparison_window.h"
#include "patience.h"
#include "view3d/scene_view.h"
#include "window_test.h"

#include <QAction>
#include <QLabel>
#include <QTableWidget>

#include <fstream>

namespace handway::test {
namespace {

class Comparison : public WindowTest {
 protected:
  void plan_with(std::uint64_t seed) {
    const std::size_t before = history().size();
    window().workbench().plan_settings.set_seed(seed);
    plan();
    ASSERT_TRUE(QTest::qWaitFor([&] { return history().size() > before; }, kPatienceMs));
    window().player().pause();
  }
  [[nodiscard]] std::vector<gui::PathRecord> history() const {
    return window().workbench().history.paths();
  }
  [[nodiscard]] gui::ComparisonWindow& begin() const {
    part<QAction>("compare").trigger();
    auto& dialog = *window().findChild<gui::ComparisonWindow*>();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&dialog));
    QTest::qWait(100);
    return dialog;
  }
};

TEST_F(Comparison, IsNotOfferedWithoutPaths) {
  open(cell().post());
  EXPECT_FALSE(part<QAction>("compare").isEnabled());
}

TEST_F(Comparison, ShowsTheLastTwoPathsWithTheirFigures) {
  open(cell().post());
  plan_with(1);
  plan_with(2);
  gui::ComparisonWindow& dialog = begin();
  const auto& table = *dialog.findChild<QTableWidget*>(QStringLiteral("comparison_figures"));
  const gui::PathFigures figures = gui::figures_of(history().at(1));
  EXPECT_EQ(table.item(0, 1)->text(), QString::number(figures.duration, 'f', 2));
  EXPECT_GE(table.rowCount(), 9);
  const bool left_is_faster = figures.duration < gui::figures_of(history().at(0)).duration;
  EXPECT_EQ(table.item(0, 1)->font().bold(), left_is_faster);
  EXPECT_EQ(table.item(0, 2)->font().bold(), !left_is_faster);
  EXPECT_FALSE(table.item(4, 1)->font().bold()) << "waypoints are neither good nor bad";
  const QString folder = qEnvironmentVariable("HANDWAY_PICTURES");
  if (!folder.isEmpty()) {
    dialog.player().seek(0.5);
    QTest::qWait(300);
    EXPECT_TRUE(dialog.grab().save(folder + QStringLiteral("/comparison.png")));
  }
}

TEST_F(Comparison, MeasuresBothMotions) {
  open(cell().post());
  plan_with(1);
  plan_with(2);
  gui::ComparisonWindow& dialog = begin();
  const auto& table = *dialog.findChild<QTableWidget*>(QStringLiteral("comparison_figures"));
  const auto& note = *dialog.findChild<QLabel*>(QStringLiteral("comparison_note"));
  const auto row_of = [&](const QString& name) {
    const QList<QTableWidgetItem*> found = table.findItems(name, Qt::MatchExactly);
    return found.isEmpty() ? -1 : found.front()->row();
  };
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return note.text().contains("in normalised joints (dynamic time warping)"); },
      kPatienceMs));
  for (const char* const name :
       {"Log dimensionless jerk of the hand", "Log dimensionless jerk of the palm",
        "Spectral arc length of the hand", "Spectral arc length of the palm",
        "Arm off the straight motion, largest", "Palm off the straight motion, largest, mm"}) {
    const int row = row_of(QString::fromUtf8(name));
    ASSERT_GE(row, 0) << name;
    EXPECT_NE(table.item(row, 1)->text(), QStringLiteral("–")) << name;
    EXPECT_NE(table.item(row, 2)->text(), QStringLiteral("–")) << name;
  }
  EXPECT_EQ(row_of(QStringLiteral("Hand off recorded motions, RMS, °")), -1)
      << "the basis names no recording";
}

TEST_F(Comparison, WaitsForASecondPath) {
  open(cell().post());
  plan_with(1);
  const gui::ComparisonWindow& dialog = begin();
  const auto& table = *dialog.findChild<QTableWidget*>(QStringLiteral("comparison_figures"));
  const auto& note = *dialog.findChild<QLabel*>(QStringLiteral("comparison_note"));
  EXPECT_NE(table.item(0, 1)->text(), QStringLiteral("–"));
  EXPECT_EQ(table.item(0, 2)->text(), QStringLiteral("–"));
  EXPECT_TRUE(note.text().contains("one path so far"));
  plan_with(2);
  EXPECT_NE(table.item(0, 2)->text(), QStringLiteral("–"));
  EXPECT_TRUE(note.text().contains("the better of the two"));
}

TEST_F(Comparison, LooksAtBothFromTheSamePlace) {
  open(cell().post());
  plan_with(1);
  gui::ComparisonWindow& dialog = begin();
  gui::SceneView& left = dialog.views().view(0);
  gui::SceneView& right = dialog.views().view(1);
  gui::OrbitCamera::Placement placement = left.camera().placement();
  placement.azimuth += 0.5;
  left.set_camera(placement);
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return right.camera().placement().azimuth == placement.azimuth; }, kPatienceMs));
}

TEST_F(Comparison, TakesPathsOfFiles) {
  open(cell().post());
  plan_with(1);
  gui::ComparisonWindow& dialog = begin();
  dialog.open_file(0, QString::fromStdString((cell().folder() / "none.csv").string()));
  const auto& note = *dialog.findChild<QLabel*>(QStringLiteral("comparison_note"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return note.text().contains("none.csv: "); }, kPatienceMs));
}

TEST_F(Comparison, NamesTheJointsThatAFileLacks) {
  open(cell().post());
  plan_with(1);
  gui::ComparisonWindow& dialog = begin();
  const std::filesystem::path arm = cell().folder() / "arm.csv";
  std::ofstream(arm) << "time,shoulder,elbow\n0,0,0\n1,0,0.1\n";
  dialog.open_file(1, QString::fromStdString(arm.string()));
  const auto& note = *dialog.findChild<QLabel*>(QStringLiteral("comparison_note"));
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return note.text().contains("arm.csv does not have all joints: left, right stay"); },
      kPatienceMs));
  EXPECT_TRUE(note.text().contains("the better of the two"));
}

}  // namespace
}  // namespace handway::test
