#include "features/playback/plot_columns.h"
#include "features/playback/plots_panel.h"
#include "patience.h"
#include "window_test.h"

#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QTabBar>

#include <fstream>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

/// Returns the number that a row shows.
std::string number_in(const QWidget& row) {
  return row.findChildren<QLabel*>().last()->text().toStdString();
}

class HumanLikenessMeter : public WindowTest {
 protected:
  /// Postures around the mean of the cell's hand.
  std::filesystem::path postures(const char* name = "seen.csv",
                                 const char* hand = "pincers") const {
    const std::filesystem::path file = cell().folder() / name;
    std::ofstream(file) << "# handway postures 1\n# hand: " << hand
                        << "\n# source: made up\nleft,right\n0.5,0.5\n0.2,0.4\n0.9,0.9\n";
    return file;
  }
  /// Brings the panel's page to the front.
  void show_hand() const {
    for (auto* bar : window().findChildren<QTabBar*>()) {
      for (int page = 0; page < bar->count(); ++page) {
        if (bar->tabText(page) == QStringLiteral("Hand")) {
          bar->setCurrentIndex(page);
        }
      }
    }
  }
  void compare_with(const std::filesystem::path& file) const {
    using State = gui::RecordedHand::State;
    gui::RecordedHand& recorded = window().document().recorded_hand();
    recorded.choose(file);
    ASSERT_TRUE(QTest::qWaitFor([&] { return recorded.state() != State::kReading; }, kPatienceMs));
  }
  [[nodiscard]] std::string to_subspace() const {
    return number_in(part<QWidget>("likeness_subspace"));
  }
  [[nodiscard]] std::string to_recorded() const {
    return number_in(part<QWidget>("likeness_recorded"));
  }
  [[nodiscard]] std::string note() const {
    return part<QLabel>("likeness_note").text().toStdString();
  }
  /// Sets both fingers to these parts of their ranges.
  void pose(double left, double right) const {
    const geometric::RobotModel& model = *window().document().robot()->model;
    geometric::Configuration q = window().document().configuration();
    const auto set = [&](const char* joint, double part) {
      const int variable = model.find_variable(joint).value();
      q[variable] =
          model.lower()[variable] + part * (model.upper()[variable] - model.lower()[variable]);
    };
    set("left", left);
    set("right", right);
    window().document().set_configuration(q);
  }
};

TEST_F(HumanLikenessMeter, SaysThatTheBasisKeepsNoPostures) {
  open(cell().post());
  show_hand();
  EXPECT_THAT(note(), HasSubstr("names no recorded postures"));
  EXPECT_EQ(to_recorded(), "–");
  EXPECT_FALSE(part<QPushButton>("likeness_take").isEnabled());
  pose(0.5 + 0.08, 0.5 - 0.06);  // across the only direction
  EXPECT_EQ(to_subspace(), "0.100");
}

TEST_F(HumanLikenessMeter, ComparesWithThePosturesOfAFile) {
  open(cell().post());
  show_hand();
  compare_with(postures());
  EXPECT_THAT(note(), HasSubstr("3 recorded postures"));
  pose(0.5, 0.6);
  EXPECT_EQ(to_recorded(), "0.100");
  keep_picture("likeness");
  click("likeness_take");
  EXPECT_EQ(to_recorded(), "0.000");
  pose(0.2, 0.4);
  EXPECT_EQ(to_recorded(), "0.000");
}

TEST_F(HumanLikenessMeter, TakesThePosturesThatTheBasisNames) {
  postures();
  std::ofstream(cell().folder() / "hand.yaml", std::ios::app) << "postures: seen.csv\n";
  open(cell().post());
  EXPECT_TRUE(QTest::qWaitFor([&] { return note().starts_with("3 recorded"); }, kPatienceMs));
}

TEST_F(HumanLikenessMeter, KeepsAChoiceForScenesWithTheSameHand) {
  open(cell().post());
  compare_with(postures());
  open(cell().wall());
  EXPECT_TRUE(QTest::qWaitFor([&] { return note().starts_with("3 recorded"); }, kPatienceMs));
}

TEST_F(HumanLikenessMeter, SaysWhatIsWrongWithAFile) {
  open(cell().post());
  compare_with(postures("claw.csv", "claw"));
  EXPECT_THAT(note(), HasSubstr("claw.csv: hand: found \"claw\""));
  compare_with(cell().folder() / "none.csv");
  EXPECT_THAT(note(), HasSubstr("none.csv"));
  EXPECT_EQ(to_recorded(), "–");
}

TEST_F(HumanLikenessMeter, IsDrawnAlongThePath) {
  open(cell().post());
  compare_with(postures());
  plan();
  const auto curves = [&] { return window().workbench().analysis.curves(); };
  ASSERT_TRUE(QTest::qWaitFor([&] { return curves() != nullptr; }, kPatienceMs));
  window().player().pause();
  EXPECT_EQ(curves()->to_recorded.size(), curves()->to_subspace.size());
  auto& dock = part<QDockWidget>("plots");
  dock.toggleViewAction()->trigger();
  QTest::qWait(50);
  EXPECT_GE(dock.height(), 200);
  tool<gui::PlotsPanel>().show_quantity(gui::PlotQuantity::kUnlikeness);
  QTest::qWait(50);
  EXPECT_THAT(part<QLabel>("plot_value").text().toStdString(),
              HasSubstr("to the nearest recorded posture"));
  const std::filesystem::path file = cell().folder() / "plot.csv";
  tool<gui::PlotsPanel>().write(QString::fromStdString(file.string()));
  std::string header;
  std::ifstream in(file);
  std::getline(in, header);
  EXPECT_EQ(header, "time_s,distance_to_pmds,distance_to_recorded");
}

TEST_F(HumanLikenessMeter, BringsTheSecondCurveToAPathThatIsThere) {
  open(cell().post());
  plan();
  const auto curves = [&] { return window().workbench().analysis.curves(); };
  ASSERT_TRUE(QTest::qWaitFor([&] { return curves() != nullptr; }, kPatienceMs));
  EXPECT_TRUE(curves()->to_recorded.empty());
  compare_with(postures());
  EXPECT_TRUE(QTest::qWaitFor([&] { return !curves()->to_recorded.empty(); }, kPatienceMs));
  EXPECT_EQ(window().workbench().history.records().size(), 1U) << "it is the same path";
}

}  // namespace
}  // namespace handway::test
