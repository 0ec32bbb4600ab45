#include "features/playback/joint_curve_list.h"
#include "features/playback/plot_columns.h"
#include "features/playback/plots_panel.h"
#include "patience.h"
#include "pressed_mouse.h"
#include "widgets/plots/cursor_plot.h"
#include "window_test.h"

#include <QComboBox>
#include <QLabel>
#include <QWheelEvent>

#include <algorithm>
#include <fstream>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

class Plots : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) {
      return;
    }
    open(cell().post());
    show_dock("plots");
  }
  void plan_and_wait() {
    plan();
    ASSERT_TRUE(QTest::qWaitFor([&] { return analysis().curves() != nullptr; }, kPatienceMs));
    window().player().pause();
  }
  [[nodiscard]] gui::MotionAnalysis& analysis() const { return window().workbench().analysis; }
  [[nodiscard]] gui::PlotsPanel& panel() const { return tool<gui::PlotsPanel>(); }
  [[nodiscard]] std::string note() const {
    for (const auto* label : panel().findChildren<QLabel*>()) {
      if (label->isVisible() && label->wordWrap()) {
        return label->text().toStdString();
      }
    }
    return {};
  }
  [[nodiscard]] std::string written(const char* name) const {
    const std::filesystem::path file = cell().folder() / name;
    panel().write(QString::fromStdString(file.string()));
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(Plots, SayWhatIsMissingBeforeThereIsAPath) {
  EXPECT_THAT(note(), HasSubstr("No path yet"));
  keep_picture("plots_empty");
}

TEST_F(Plots, DrawTheArmOverTheTimeThatTheRobotTakes) {
  plan_and_wait();
  EXPECT_EQ(note(), "");
  EXPECT_EQ(panel().joints().chosen().size(), 2U);
  const planning::Motion& motion = *analysis().motion();
  EXPECT_DOUBLE_EQ(panel().plot().span().second, motion.trajectory.duration());
  EXPECT_DOUBLE_EQ(window().player().duration(), motion.trajectory.duration());
  keep_picture("plots_position");
}

TEST_F(Plots, HaveTheirCursorWhereThePlaybackIs) {
  plan_and_wait();
  window().player().seek(0.5);
  EXPECT_NEAR(panel().plot().cursor(), 0.5 * window().player().duration(), 1e-9);
}

TEST_F(Plots, MoveTheRobotByTheirCursor) {
  plan_and_wait();
  gui::CursorPlot& plot = panel().plot();
  const double duration = window().player().duration();
  QTest::mousePress(plot.canvas(), Qt::LeftButton, {}, plot.place_of(0.25 * duration));
  EXPECT_NEAR(window().player().fraction(), 0.25, 0.02);
  move_pressed_mouse(*plot.canvas(), plot.place_of(0.75 * duration));
  EXPECT_NEAR(window().player().fraction(), 0.75, 0.02);
  EXPECT_TRUE(window().document().configuration().isApprox(
      window().player().timeline().at(window().player().fraction())));
}

TEST_F(Plots, ZoomAndShowAllAgain) {
  plan_and_wait();
  gui::CursorPlot& plot = panel().plot();
  const double end = plot.span().second;
  const QPoint middle = plot.place_of(0.5 * end);
  QWheelEvent wheel(middle, plot.canvas()->mapToGlobal(middle), {}, {0, 240}, Qt::NoButton,
                    Qt::NoModifier, Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(plot.canvas(), &wheel);
  EXPECT_GT(plot.span().first, 0.0);
  EXPECT_LT(plot.span().second, end);
  QTest::mouseDClick(plot.canvas(), Qt::LeftButton, {}, middle);
  EXPECT_EQ(plot.span(), std::pair(0.0, end));
}

TEST_F(Plots, NameTheClosestPairWhereTheCursorIs) {
  plan_and_wait();
  panel().show_quantity(gui::PlotQuantity::kClearance);
  const std::vector<double>& clearance = analysis().curves()->clearance;
  const auto least = std::ranges::min_element(clearance) - clearance.begin();
  window().player().seek(static_cast<double>(least) / static_cast<double>(clearance.size() - 1));
  EXPECT_THAT(part<QLabel>("plot_value").text().toStdString(), HasSubstr("post"));
  keep_picture("plots_clearance");
}

TEST_F(Plots, TellHowFarTheHandIsFromItsBasis) {
  plan_and_wait();
  panel().show_quantity(gui::PlotQuantity::kUnlikeness);
  EXPECT_EQ(analysis().curves()->to_subspace.size(), analysis().curves()->clearance.size());
  EXPECT_TRUE(written("plot.csv").starts_with("time_s,distance_to_pmds\n0,"));
}

TEST_F(Plots, AreWrittenAsTablesAndPictures) {
  plan_and_wait();
  panel().show_quantity(gui::PlotQuantity::kVelocity);
  EXPECT_TRUE(
      written("plot.csv").starts_with("time_s,shoulder_deg_per_s,elbow_deg_per_s\n0,0,0\n"));
  EXPECT_NE(written("plot.svg").find("<svg"), std::string::npos);
  EXPECT_EQ(written("plot.png").substr(1, 3), "PNG");
}

TEST_F(Plots, AreEmptyAgainWhenAnotherSceneIsOpened) {
  plan_and_wait();
  open(cell().wall());
  EXPECT_EQ(analysis().state(), gui::MotionAnalysis::State::kNoPath);
  EXPECT_THAT(note(), HasSubstr("No path yet"));
}

}  // namespace
}  // namespace handway::test
