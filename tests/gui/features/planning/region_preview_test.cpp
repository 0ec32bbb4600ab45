#include "features/planning/planning_commands.h"
#include "features/planning/region_tool.h"
#include "handway/planning/planners/planner.h"
#include "window_test.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QSlider>
#include <QSpinBox>
#include <QToolButton>

namespace handway::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class RegionPreviewInThePanel : public WindowTest {
 protected:
  void open_with(const char* planner) {
    open(cell().post());
    window().workbench().plan_settings.choose_planner(planner);
    part<QToolButton>("advanced").setChecked(true);
  }
  void switch_on() {
    part<QCheckBox>("preview_region").setChecked(true);
    settle();
  }
  void settle() {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::RegionTool>().is_busy(); }));
  }
  [[nodiscard]] bool is_shown() const { return tool<gui::RegionTool>().is_shown(); }
  [[nodiscard]] std::string note() const {
    return part<QLabel>("preview_note").text().toStdString();
  }
};

TEST_F(RegionPreviewInThePanel, IsOffUntilItIsAskedFor) {
  open_with("pmd-prm");
  EXPECT_FALSE(is_shown());
  EXPECT_FALSE(part<QSlider>("preview_rho").isVisible());
  switch_on();
  EXPECT_TRUE(is_shown());
  EXPECT_TRUE(part<QSlider>("preview_rho").isVisible());
  part<QCheckBox>("preview_region").setChecked(false);
  EXPECT_FALSE(is_shown());
}

TEST_F(RegionPreviewInThePanel, FollowsTheParametersField) {
  open_with("pmd-prm");
  switch_on();
  const std::string before = note();
  EXPECT_THAT(before, HasSubstr("mm of the straight motion"));
  const int position = part<QSlider>("preview_rho").value();
  part<QDoubleSpinBox>("rho_a").setValue(0.04);
  settle();
  EXPECT_GT(part<QSlider>("preview_rho").value(), position);
  EXPECT_NE(note(), before);
  EXPECT_THAT(note(), Not(HasSubstr("only change the display")));
}

TEST_F(RegionPreviewInThePanel, SetsTheParameterThatIsDragged) {
  open_with("pmd-prm");
  switch_on();
  part<QSlider>("preview_rho").setValue(600);
  settle();
  const auto parameters = window().workbench().plan_settings.planner()->parameters();
  const double entered = std::get<double>(geometric::find_parameter(parameters, "rho_a").value);
  EXPECT_DOUBLE_EQ(part<QDoubleSpinBox>("rho_a").value(), entered);
  EXPECT_NEAR(entered, 0.017, 0.001) << "the slider is logarithmic";
  EXPECT_TRUE(is_shown());
}

TEST_F(RegionPreviewInThePanel, IsForLookingOnlyWherePlannersChooseTheirWidth) {
  open_with("auto");
  switch_on();
  EXPECT_THAT(note(), HasSubstr("only change the display"));
  part<QSlider>("preview_rho").setValue(100);
  settle();
  EXPECT_TRUE(is_shown());
}

TEST_F(RegionPreviewInThePanel, SaysThatAPlannerHasNoRegion) {
  open_with("rrt-connect");
  switch_on();
  settle();
  EXPECT_FALSE(is_shown());
  EXPECT_THAT(note(), HasSubstr("everywhere"));
  window().workbench().plan_settings.choose_planner("pmd-rrt-connect");
  settle();
  EXPECT_TRUE(is_shown());
}

TEST_F(RegionPreviewInThePanel, NeedsNoScene) {
  switch_on();
  EXPECT_FALSE(is_shown());
  open_with("pmd-prm");
  settle();
  EXPECT_TRUE(is_shown());
}

}  // namespace
}  // namespace handway::test
