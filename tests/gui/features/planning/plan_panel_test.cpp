#include "features/planning/plan_panel.h"

#include "window_test.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>

#include <fstream>
#include <iterator>

namespace handway::test {
namespace {

class ParametersInThePanel : public WindowTest {};

// A grey button said so in its tool tip alone.
TEST_F(ParametersInThePanel, ComeWithWhatIsMissingToPlan) {
  const auto& missing = part<QLabel>("missing");
  EXPECT_EQ(missing.text(), "Open a scene first.");
  open(cell().folder() / "arm.urdf");
  EXPECT_THAT(missing.text().toStdString(), ::testing::StartsWith("The scene has no goal. Pose"));
  EXPECT_FALSE(missing.isHidden());
  window().editor().set_goal(window().document().configuration());
  EXPECT_TRUE(missing.isHidden());
}

TEST_F(ParametersInThePanel, GoBackToThePlannersOwnValues) {
  open(cell().post());
  gui::PlanSettings& settings = window().workbench().plan_settings;
  settings.choose_planner("pmd-prm");
  auto& reset = part<QPushButton>("reset_parameters");
  EXPECT_FALSE(reset.isEnabled());
  const int usual = part<QSpinBox>("k").value();

  part<QSpinBox>("k").setValue(usual + 3);
  EXPECT_EQ(settings.choice().settings.size(), 1U);
  EXPECT_TRUE(reset.isEnabled());

  click("reset_parameters");
  EXPECT_EQ(part<QSpinBox>("k").value(), usual);
  EXPECT_TRUE(settings.choice().settings.empty());
  EXPECT_EQ(settings.choice().name, "pmd-prm");
  EXPECT_FALSE(reset.isEnabled());
}

TEST_F(ParametersInThePanel, StayWhileAPlannerRuns) {
  open(cell().post());
  window().workbench().plan_settings.choose_planner("pmd-prm");
  part<QSpinBox>("k").setValue(part<QSpinBox>("k").value() + 1);
  emit window().session().started();
  EXPECT_FALSE(part<QPushButton>("reset_parameters").isEnabled());
  tool<gui::PlanPanel>().set_ready(true);
  EXPECT_TRUE(part<QPushButton>("reset_parameters").isEnabled());
}

TEST_F(ParametersInThePanel, KeepTheMarginOfARun) {
  open(cell().post());
  gui::PlanSettings& settings = window().workbench().plan_settings;
  EXPECT_EQ(settings.request().margin, 0.0);
  part<QDoubleSpinBox>("margin").setValue(7.5);
  planning::PlanRequest request = settings.request();
  EXPECT_DOUBLE_EQ(request.margin, 0.0075);
  request.margin = 0.003;
  settings.restore(request);
  EXPECT_EQ(settings.request().margin, 0.003);
  EXPECT_EQ(part<QDoubleSpinBox>("margin").value(), 3.0);
}

class PlannersInThePanel : public WindowTest {
 protected:
  [[nodiscard]] bool can_be_chosen(const char* planner) const {
    const auto& list = part<QComboBox>("planners");
    return (list.model()->index(list.findText(QLatin1String(planner)), 0).flags() &
            Qt::ItemIsEnabled) != 0;
  }
  /// The post's scene without its hand basis.
  [[nodiscard]] std::filesystem::path without_basis() const {
    std::ifstream in(cell().post());
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string basis = "hand_basis: hand.yaml\n";
    text.erase(text.find(basis), basis.size());
    const std::filesystem::path file = cell().folder() / "without_basis.yaml";
    std::ofstream(file) << text;
    return file;
  }
};

TEST_F(PlannersInThePanel, AreGreyWhereTheyNeedABasisAndTheSceneNamesNone) {
  open(without_basis());
  EXPECT_TRUE(can_be_chosen("auto"));
  EXPECT_TRUE(can_be_chosen("rrt-connect"));
  EXPECT_FALSE(can_be_chosen("pmd-prm"));
  open(cell().post());
  EXPECT_TRUE(can_be_chosen("pmd-prm"));
}

}  // namespace
}  // namespace handway::test
