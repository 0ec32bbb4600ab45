#include "panels/plan_panel.h"

#include "window_test.h"

#include <QPushButton>
#include <QSpinBox>

namespace handway::test {
namespace {

class ParametersInThePanel : public WindowTest {};

TEST_F(ParametersInThePanel, GoBackToThePlannersOwnValues) {
  open(cell().post());
  auto& panel = *window().findChild<gui::PlanPanel*>();
  panel.choose_planner("pmd-prm");
  auto& reset = part<QPushButton>("reset_parameters");
  EXPECT_FALSE(reset.isEnabled());
  const int usual = part<QSpinBox>("k").value();

  part<QSpinBox>("k").setValue(usual + 3);
  EXPECT_EQ(panel.choice().settings.size(), 1U);
  EXPECT_TRUE(reset.isEnabled());

  click("reset_parameters");
  EXPECT_EQ(part<QSpinBox>("k").value(), usual);
  EXPECT_TRUE(panel.choice().settings.empty());
  EXPECT_EQ(panel.choice().name, "pmd-prm");
  EXPECT_FALSE(reset.isEnabled());
}

TEST_F(ParametersInThePanel, StayWhileAPlannerRuns) {
  open(cell().post());
  auto& panel = *window().findChild<gui::PlanPanel*>();
  panel.choose_planner("pmd-prm");
  part<QSpinBox>("k").setValue(part<QSpinBox>("k").value() + 1);
  panel.show_running();
  EXPECT_FALSE(part<QPushButton>("reset_parameters").isEnabled());
  panel.clear_result();
  panel.set_ready(true);
  EXPECT_TRUE(part<QPushButton>("reset_parameters").isEnabled());
}

}  // namespace
}  // namespace handway::test
