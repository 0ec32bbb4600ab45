/// Pictures of the manual that need hands: the window on scenes that ship, brought to where the
/// manual describes it. The target docs-pictures runs it; others come from the stories.
#include "features/campaigns/campaigns_panel.h"
#include "features/comparison/comparison_window.h"
#include "features/editing/properties_panel.h"
#include "features/microscope/microscope_panel.h"
#include "features/planning/roadmap_display.h"
#include "handway/planning/core/observer.h"
#include "stories/story.h"
#include "view3d/scene_view.h"

#include <QCheckBox>
#include <QDockWidget>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QSlider>
#include <QTabWidget>
#include <QTableView>
#include <QToolButton>

#include <algorithm>

namespace handway::test {
namespace {

class Pictures : public Story {
 protected:
  template <typename Widget = QWidget>
  [[nodiscard]] Widget& part(const char* name) const {
    auto* widget = window().findChild<Widget*>(QLatin1String(name));
    if (!widget) {
      throw std::runtime_error(std::string("no part called ") + name);
    }
    return *widget;
  }
  void open_shipped(const char* scene) const {
    open(source_dir() / "scenes" / (std::string(scene) + ".yaml"));
    ASSERT_EQ(window().message(), QString());
  }
  void apply(const char* planner,
             const std::vector<std::pair<std::string, std::string>>& settings = {}) const {
    window().workbench().plan_settings.apply({planner, settings});
  }
  void wait_until_idle() const {
    ASSERT_TRUE(wait_for([&] { return !window().workbench().is_busy(); }));
    QTest::qWait(600);  // the fine picture
  }
  void take(const char* name) const {
    wait_until_idle();
    picture(QLatin1String(name));
  }
};

TEST_F(Pictures, BoundingSpheres) {
  open_shipped("can_in_box");
  part<QAction>("bodies_spheres").trigger();
  window().view().set_camera(
      {{0.6, 0.1, 0.75}, 2.1, geometric::radians(-55.0), geometric::radians(28.0)});
  QTest::qWait(3000);  // spheres are made in the background
  take("bounding_spheres");
}

TEST_F(Pictures, Campaigns) {
  const std::filesystem::path file = folder_.path() / "study.yaml";
  std::ofstream(file) << "campaign: 1\nname: Can on a table\nproblems: [{name: can_on_table, file: "
                      << (source_dir() / "scenes" / "can_on_table.yaml") << "}]\n"
                      << "planners: [auto, pmd-prm]\nseeds: 24\n";
  auto& panel = *window().findChild<gui::CampaignsPanel*>();
  QSignalSpy ended(&panel.runner(), &gui::CampaignRunner::ended);
  open_shipped("can_on_table");
  window().workbench().show_panel("campaigns");
  panel.open(QString::fromStdString(file.string()));
  ASSERT_TRUE(wait_for([&] { return !ended.isEmpty(); }));
  QSignalSpy planned(&window().session(), &gui::PlanningSession::ended);
  auto& runs = part<QTableView>("campaign_runs");
  QTest::mouseClick(runs.viewport(), Qt::LeftButton, {},
                    runs.visualRect(runs.model()->index(1, 0)).center());
  ASSERT_TRUE(wait_for([&] { return !planned.isEmpty(); }));
  window().player().pause();
  take("campaigns");
}

TEST_F(Pictures, Comparison) {
  open_shipped("cans_in_shelf");
  const gui::PathHistory& history = window().workbench().history;
  for (const char* planner : {"rrt-connect", "pmd-prm"}) {
    const std::size_t before = history.paths().size();
    apply(planner);
    ASSERT_TRUE(plan());
    ASSERT_TRUE(wait_for([&] { return history.paths().size() > before; }));
  }
  trigger("Compare two paths…");
  auto& dialog = *window().findChild<gui::ComparisonWindow*>();
  dialog.player().seek(0.5);
  QTest::qWait(800);
  picture("comparison", dialog);
  dialog.close();
}

TEST_F(Pictures, Constraints) {
  open_shipped("can_on_table");
  window().document().set_configuration(scene().goal.value());
  select("can");
  editor().attach("tx90_sah", "palm", {});
  editor().set_start(scene().goal.value());
  part<QCheckBox>("keep_upright").click();
  part<QCheckBox>("keep_region").click();
  window().findChild<gui::PropertiesPanel*>()->ensureWidgetVisible(&part<QCheckBox>("keep_region"));
  take("constraints");
}

TEST_F(Pictures, GoalDoctor) {
  open_shipped("can_on_table");
  geometric::Configuration q = scene().goal.value();
  q[1] += geometric::radians(3.0);
  editor().set_goal(q);
  window().document().set_configuration(q);
  ASSERT_TRUE(wait_for([&] { return part("doctor").isVisible(); }));
  take("goal_doctor");
}

TEST_F(Pictures, HumanLikeness) {
  open_shipped("can_on_table");
  ASSERT_TRUE(plan());
  window().player().seek(1.0);
  window().workbench().show_panel("hand");
  part<QPushButton>("likeness_choose").menu()->actions().front()->trigger();
  QTest::qWait(1500);  // recorded postures are read
  take("human_likeness");
}

TEST_F(Pictures, Hypercubes) {
  open_shipped("cans_on_desk");
  apply("pmd-prm", {{"rho_a", "0.05"}});
  ASSERT_TRUE(plan());
  part<QAction>("samples").trigger();
  part<QAction>("hypercubes").trigger();
  ASSERT_TRUE(
      wait_for([&] { return !window().findChild<gui::HypercubeDisplay*>()->boxes().empty(); }));
  window().player().seek(0.4);
  take("hypercubes");
}

TEST_F(Pictures, Microscope) {
  open_shipped("can_on_table");
  auto& dock = part<QDockWidget>("microscope");
  dock.show();
  dock.raise();
  part<QPushButton>("microscope_record").click();
  gui::Microscope& microscope = window().findChild<gui::MicroscopePanel*>()->microscope();
  ASSERT_TRUE(wait_for([&] { return microscope.run() != nullptr; }));
  const auto& steps = microscope.run()->steps;
  const auto refused = std::ranges::find_if(steps, [](const gui::RecordedStep& recorded) {
    return recorded.step.line == planning::algorithm_lines::kHandFree && !recorded.step.yes;
  });
  ASSERT_NE(refused, steps.end());
  microscope.go_to(static_cast<std::size_t>(refused - steps.begin()));
  take("microscope");
}

TEST_F(Pictures, MovingThePalm) {
  open_shipped("can_on_table");
  part<QAction>("palm").trigger();
  geometric::Pose X_WP = editor().selected_pose().value();
  X_WP.translation() += Eigen::Vector3d(-0.05, 0.0, 0.1);
  editor().place(X_WP);
  take("moving_the_palm");
}

TEST_F(Pictures, NoPath) {
  open_shipped("t_shape");
  apply("rrt-connect", {{"max_samples", "500"}});
  ASSERT_FALSE(plan());
  window().view().set_camera(
      {{0.72, 0.12, 0.66}, 1.5, geometric::radians(-60.0), geometric::radians(12.0)});
  take("no_path");
}

TEST_F(Pictures, PlanningPanel) {
  open_shipped("can_on_table");
  ASSERT_TRUE(plan());
  wait_until_idle();
  picture("planning_panel", part("control_tabs"));
}

TEST_F(Pictures, Roadmap) {
  open_shipped("t_shape");
  apply("pmd-rrt-connect");
  auto& dock = part<QDockWidget>("projection");
  dock.show();
  dock.raise();
  ASSERT_TRUE(plan());
  part<QAction>("samples").trigger();
  window().player().seek(0.0);
  take("roadmap");
}

TEST_F(Pictures, SamplingRegion) {
  open_shipped("can_on_table");
  apply("pmd-prm", {{"rho_a", "0.03"}});
  auto& advanced = part<QToolButton>("advanced");
  advanced.setChecked(true);
  auto& preview = part<QCheckBox>("preview_region");
  preview.click();
  QTest::qWait(2000);  // it is drawn in the background
  for (QWidget* around = &preview; around; around = around->parentWidget()) {
    if (auto* area = qobject_cast<QScrollArea*>(around)) {
      area->ensureWidgetVisible(&preview, 0, 400);
    }
  }
  QTest::qWait(100);
  take("sampling_region");
  advanced.setChecked(false);
}

TEST_F(Pictures, MeasuringInASection) {
  open_shipped("cans_in_shelf");
  part<QAction>("section").trigger();
  take("section");
}

}  // namespace
}  // namespace handway::test
