#include "features/tasks/task_tool.h"

#include "features/editing/editing_test.h"
#include "features/export/export_dialog.h"
#include "features/export/pictures_dialog.h"
#include "features/planning/query_check.h"
#include "features/tasks/step_list.h"
#include "features/workbench.h"
#include "handway/planning/extensions/plugin.h"
#include "handway_test/paths.h"
#include "model/devices/motion_driver.h"
#include "patience.h"
#include "view3d/scene_view.h"
#include "widgets/forms/slider_row.h"
#include "widgets/panels/film_bar.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidget>
#include <QUndoStack>

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <variant>

namespace handway::test {
namespace {

class PickAndPlace : public EditingTest {
 protected:
  void SetUp() override {
    EditingTest::SetUp();
    if (!IsSkipped()) {
      open(source_dir() / "scenes" / "can_on_table.yaml");
      select("can");
      part<QAction>("pick_and_place").trigger();
    }
  }
  /// Presses Plan, and waits for the result.
  void plan() {
    click("task_plan");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::TaskTool>().is_busy(); }, 120000));
  }
  /// Shows the program of the scene, with the editor of its steps.
  void edit_program() {
    part<QMenu>("programs").actions().at(0)->trigger();
    click("task_edit");
  }
  [[nodiscard]] QStringList shown_steps() const {
    QStringList words;
    const auto& steps = part<QTreeWidget>("program_steps");
    for (int i = 0; i < steps.topLevelItemCount(); ++i) {
      words << steps.topLevelItem(i)->text(1);
    }
    return words;
  }
  /// Adds a step by the text of the menu.
  void add_step(const char* text) {
    for (QAction* action : part<QToolButton>("program_add").menu()->actions()) {
      if (action->text() == QLatin1String(text)) {
        action->trigger();
        return;
      }
    }
    FAIL() << text;
  }
  void choose(const char* list, const char* text) {
    auto& box = part<QComboBox>(list);
    ASSERT_GE(box.findText(QLatin1String(text)), 0) << text;
    box.setCurrentText(QLatin1String(text));
    emit box.activated(box.currentIndex());
  }
  void select_step(int row) {
    auto& steps = part<QTreeWidget>("program_steps");
    steps.setCurrentItem(steps.topLevelItem(row));
  }
  /// Clicks the first row of the list of stages with this text.
  void click_stage(const char* text) {
    auto& stages = part<QTreeWidget>("task_stages");
    const auto found = stages.findItems(QLatin1String(text), Qt::MatchExactly, 0);
    ASSERT_FALSE(found.isEmpty()) << text;
    QTest::mouseClick(stages.viewport(), Qt::LeftButton, {},
                      stages.visualItemRect(found.front()).center());
  }
};

TEST_F(PickAndPlace, PlansAndPlaysWithTheMouseAlone) {
  EXPECT_EQ(part<QComboBox>("task_support").currentText(), "table") << "what it stands on";
  const planning::SceneState before = editor().state();
  plan();
  const planning::TaskPlan& plan = tool<gui::TaskTool>().plan();
  ASSERT_TRUE(plan.solved) << plan.reason;
  const auto& stages = part<QTreeWidget>("task_stages");
  EXPECT_EQ(stages.topLevelItemCount(), static_cast<int>(plan.stages.size()));
  EXPECT_EQ(stages.topLevelItem(0)->text(0), "Approach");
  auto& play = part<QPushButton>("task_play");
  EXPECT_EQ(play.text(), "Stop") << "it plays by itself";
  const auto is_played = [&](const char* stage) {
    return stages.currentItem() != nullptr && stages.currentItem()->text(0) == stage;
  };
  ASSERT_TRUE(QTest::qWaitFor([&] { return is_played("Carry"); }, kPatienceMs));
  keep_picture("pick_and_place");
  EXPECT_EQ(editor().state(), before) << "only shown";
  ASSERT_TRUE(QTest::qWaitFor([&] { return play.text() == "Play"; }, kPatienceMs));
  EXPECT_EQ(editor().state(), before);
}

TEST_F(PickAndPlace, SavesItsFilmAsPictures) {
  plan();
  ASSERT_TRUE(tool<gui::TaskTool>().plan().solved);
  part<gui::FilmBar>("task_film").findChild<QToolButton*>("film_pictures")->click();
  auto* dialog = window().findChild<gui::PicturesDialog*>();
  ASSERT_NE(dialog, nullptr);
  EXPECT_EQ(dialog->windowTitle(), "Export pictures of the task");
  const QTemporaryDir folder;
  dialog->choose(gui::PicturesDialog::Kind::kStrip);
  dialog->set_file(folder.filePath("task.png"));
  QSignalSpy exported(dialog, &gui::PicturesDialog::exported);
  dialog->findChild<QPushButton*>("pictures_export")->click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !exported.isEmpty(); }, kPatienceMs));
  const QImage strip(folder.filePath("task.png"));
  EXPECT_GT(strip.width(), 5 * strip.height());
  keep_picture("saved_task");
}

TEST_F(PickAndPlace, ShowsTheStageThatIsClicked) {
  plan();
  ASSERT_TRUE(tool<gui::TaskTool>().plan().solved);
  click_stage("Lift");
  const auto& moment = *part<gui::FilmBar>("task_film").findChild<QSlider*>();
  const int at = moment.value();
  EXPECT_GT(at, 0);
  QTest::qWait(5 * gui::FilmBar::kFrameTimeMs);
  EXPECT_EQ(moment.value(), at) << "at a pause";
  EXPECT_EQ(part<QTreeWidget>("task_stages").currentItem()->text(0), "Lift");
}

TEST_F(PickAndPlace, EditsTheStepsOfAProgram) {
  edit_program();
  EXPECT_THAT(shown_steps(), ::testing::ElementsAre("pick can", "place on table", "move to start"));
  type("program_first_length", "5 cm");
  EXPECT_NEAR(std::get<geometric::PickStep>(scene().programs.at(0).steps[0]).approach, 0.05, 1e-9);
  select_step(2);
  EXPECT_FALSE(part<QWidget>("program_first_length").isVisible()) << "a move has no lengths";
  click("program_duplicate");
  click("program_up");
  click("program_up");
  keep_picture("program_editor");
  EXPECT_THAT(shown_steps(), ::testing::ElementsAre("pick can", "move to start", "place on table",
                                                    "move to start"));
  EXPECT_EQ(scene().programs.at(0).steps.size(), 4U);
  click("program_remove");
  EXPECT_EQ(shown_steps().size(), 3);
  for (int edit = 0; edit < 5; ++edit) {
    editor().undo_stack().undo();
  }
  EXPECT_EQ(std::get<geometric::PickStep>(scene().programs.at(0).steps[0]).approach, 0.1);
  EXPECT_THAT(shown_steps(), ::testing::ElementsAre("pick can", "place on table", "move to start"));
}

TEST_F(PickAndPlace, MakesANewProgram) {
  part<QMenu>("programs").actions().back()->trigger();
  ASSERT_EQ(scene().programs.size(), 2U);
  EXPECT_THAT(shown_steps(), ::testing::ElementsAre("move to start"));
  EXPECT_TRUE(part<QTreeWidget>("program_steps").isVisible());
  EXPECT_FALSE(part<QToolButton>("program_remove").isEnabled()) << "a program has a step";
  part<QToolButton>("program_add").menu()->actions().at(0)->trigger();
  auto& object = part<QComboBox>("program_name");
  object.setCurrentText("can");
  emit object.activated(object.currentIndex());
  EXPECT_THAT(shown_steps(), ::testing::ElementsAre("move to start", "pick can"));
  editor().undo_stack().undo();
  editor().undo_stack().undo();
  editor().undo_stack().undo();
  EXPECT_EQ(scene().programs.size(), 1U);
  EXPECT_FALSE(part<QTreeWidget>("program_steps").isVisible());
}

TEST_F(PickAndPlace, EditsPosesAndLines) {
  edit_program();
  add_step("Move to a pose");
  const auto goal = [this] {
    return std::get<geometric::PoseStep>(scene().programs.at(0).steps.at(1)).goal;
  };
  const geometric::Pose here = goal().X_WG;
  EXPECT_EQ(goal().link, "palm") << "where it is shown";
  choose("program_frame", "table");
  EXPECT_EQ(goal().reference, "table");
  const geometric::Pose X_WF = *geometric::standing_pose(scene(), "table");
  EXPECT_TRUE((X_WF * goal().X_WG).isApprox(here, 1e-9)) << "the pose stays";
  type("program_position_x", "20 cm");
  EXPECT_NEAR(goal().X_WG.translation().x(), 0.2, 1e-9);
  EXPECT_TRUE(goal().X_WG.linear().isApprox((X_WF.inverse() * here).linear(), 1e-9));
  choose("program_name", "forearm_link");
  EXPECT_EQ(goal().link, "forearm_link");
  keep_picture("program_pose");
  choose("program_frame", "world");
  EXPECT_EQ(goal().reference, "");

  add_step("Move straight");
  const auto line = [this] {
    return std::get<geometric::LineStep>(scene().programs.at(0).steps.at(2));
  };
  EXPECT_FALSE(part<QWidget>("program_position_x").isVisible());
  EXPECT_EQ(line().shift, Eigen::Vector3d(0.0, 0.0, 0.1));
  type("program_line_z", "0");
  EXPECT_EQ(line().shift.z(), 0.1) << "a line has a length";
  type("program_line_y", "-5 cm");
  EXPECT_TRUE(line().shift.isApprox(Eigen::Vector3d(0.0, -0.05, 0.0), 1e-9));
  choose("program_frame", "palm");
  EXPECT_EQ(line().reference, "palm");
  EXPECT_EQ(shown_steps().at(2), "line of 50 mm");
  editor().undo_stack().undo();
  EXPECT_EQ(line().reference, "");
}

TEST_F(PickAndPlace, EditsWaitsAndOutputs) {
  edit_program();
  add_step("Wait");
  part<QDoubleSpinBox>("program_wait").setValue(2.5);
  EXPECT_EQ(std::get<geometric::WaitStep>(scene().programs.at(0).steps.at(1)).duration, 2.5);
  add_step("Set an output");
  const auto output = [this] {
    return std::get<geometric::OutputStep>(scene().programs.at(0).steps.at(2));
  };
  auto& name = part<QLineEdit>("program_output_name");
  name.setText("do7");
  emit name.editingFinished();
  EXPECT_EQ(output().name, "do7");
  name.setText(" ");
  emit name.editingFinished();
  EXPECT_EQ(output().name, "do7") << "an output has a name";
  EXPECT_FALSE(part<QDoubleSpinBox>("program_output_number").isVisible());
  choose("program_output_value", "Off");
  EXPECT_FALSE(std::get<bool>(output().value));
  choose("program_output_value", "Number");
  part<QDoubleSpinBox>("program_output_number").setValue(0.5);
  EXPECT_EQ(std::get<double>(output().value), 0.5);
  keep_picture("program_output");
  EXPECT_THAT(shown_steps(), ::testing::ElementsAre("pick can", "wait 2.5 s", "set do7 to 0.5",
                                                    "place on table", "move to start"));
}

TEST_F(PickAndPlace, DisablesSteps) {
  edit_program();
  auto& steps = part<QTreeWidget>("program_steps");
  select_step(1);
  click("program_disable");
  EXPECT_TRUE(scene().programs.at(0).steps.at(1).disabled);
  EXPECT_TRUE(steps.topLevelItem(1)->font(1).strikeOut());
  EXPECT_EQ(part<QLabel>("task_note").text(), "Steps: pick can, move to start");
  EXPECT_TRUE(part<QToolButton>("program_disable").isChecked());
  keep_picture("program_disabled");
  select_step(0);
  EXPECT_FALSE(part<QToolButton>("program_disable").isChecked());
  type("program_first_length", "5 cm");
  EXPECT_TRUE(scene().programs.at(0).steps.at(1).disabled) << "others are as they were";
  select_step(1);
  type("program_first_length", "5 cm");
  EXPECT_TRUE(scene().programs.at(0).steps.at(1).disabled) << "also with other values";
  click("program_disable");
  EXPECT_FALSE(steps.topLevelItem(1)->font(1).strikeOut());
  editor().undo_stack().undo();
  EXPECT_TRUE(scene().programs.at(0).steps.at(1).disabled);
}

TEST_F(PickAndPlace, MovesAStepThatIsDragged) {
  edit_program();
  auto& steps = part<gui::StepList>("program_steps");
  // Drops the selected step on the upper or the lower half of another one's row.
  const auto drop = [&](int row, bool below) {
    const QRect there = steps.visualItemRect(steps.topLevelItem(row));
    const QMimeData data;
    QDropEvent event(QPoint(there.center().x(), below ? there.bottom() : there.top() + 1),
                     Qt::MoveAction, &data, Qt::LeftButton, Qt::NoModifier);
    steps.dropEvent(&event);
    EXPECT_NE(event.dropAction(), Qt::MoveAction) << "else the list removes the row";
    QCoreApplication::processEvents();
  };
  select_step(0);
  drop(2, true);
  EXPECT_THAT(shown_steps(), ::testing::ElementsAre("place on table", "move to start", "pick can"));
  EXPECT_EQ(steps.row(), 2) << "it stays selected";
  drop(1, false);
  EXPECT_THAT(shown_steps(), ::testing::ElementsAre("place on table", "pick can", "move to start"));
  drop(1, true);
  EXPECT_THAT(shown_steps(), ::testing::ElementsAre("place on table", "pick can", "move to start"));
  editor().undo_stack().undo();
  editor().undo_stack().undo();
  EXPECT_THAT(shown_steps(), ::testing::ElementsAre("pick can", "place on table", "move to start"));
}

TEST_F(PickAndPlace, PausesWhereAProgramWaits) {
  part<QMenu>("programs").actions().back()->trigger();
  add_step("Wait");
  part<QDoubleSpinBox>("program_wait").setValue(0.5);
  add_step("Set an output");
  select_step(0);
  click("program_remove");
  plan();
  ASSERT_TRUE(tool<gui::TaskTool>().plan().solved) << tool<gui::TaskTool>().plan().reason;
  const auto& stages = part<QTreeWidget>("task_stages");
  ASSERT_EQ(stages.topLevelItemCount(), 2);
  EXPECT_EQ(stages.topLevelItem(0)->text(0), "Wait");
  EXPECT_EQ(stages.topLevelItem(0)->text(1), "0.50 s");
  EXPECT_EQ(stages.topLevelItem(1)->text(0), "Set output");
  const auto& moment = *part<gui::FilmBar>("task_film").findChild<QSlider*>();
  EXPECT_EQ(moment.maximum() + 1, 500 / gui::FilmBar::kFrameTimeMs + 2)
      << "a frame every 20 ms, and one of the output";
}

class PickAndPlaceWithPlugins : public PickAndPlace {
 protected:
  [[nodiscard]] std::shared_ptr<planning::PluginManager> plugins() const override {
    auto all = std::make_shared<planning::PluginManager>();
    all->load_plugins(planning::plugin_directory());
    return all;
  }
};

TEST_F(PickAndPlaceWithPlugins, ExportsTheWholeTask) {
  plan();
  ASSERT_TRUE(tool<gui::TaskTool>().plan().solved);
  ASSERT_TRUE(part<QPushButton>("task_export").isVisible());
  click("task_export");
  auto* dialog = window().findChild<gui::ExportDialog*>();
  ASSERT_NE(dialog, nullptr);
  EXPECT_EQ(dialog->windowTitle(), "Export the task");
  const ScratchFolder folder;
  dialog->set_folder(QString::fromStdString((folder.path() / "out").string()));
  dialog->choose_format("val3");
  QStringList written;
  QObject::connect(dialog, &gui::ExportDialog::exported, &window(),
                   [&](const QStringList& files) { written = files; });
  auto& too_close = *dialog->findChild<QCheckBox*>("export_too_close");
  auto& now = *dialog->findChild<QPushButton*>("export_now");
  const auto is_ready = [&] {
    if (too_close.isVisible() && !too_close.isChecked()) {
      too_close.click();
    }
    return now.isEnabled();
  };
  const auto said = [&] {
    QStringList texts;
    for (const QLabel* label : dialog->findChildren<QLabel*>()) {
      texts << label->text();
    }
    return texts.join(QLatin1Char('\n')).toStdString();
  };
  ASSERT_TRUE(QTest::qWaitFor(is_ready, 60000)) << said();
  now.click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !written.isEmpty(); }, 20000));
  std::ifstream file(folder.path() / "out" / "place_can" / "runPath.pgx");
  const std::string program(std::istreambuf_iterator<char>(file), {});
  for (const char* stage : {"// stage: lift (pick can)", "// stage: open (place on table)"}) {
    EXPECT_THAT(program, ::testing::HasSubstr(stage));
  }
}

TEST_F(PickAndPlaceWithPlugins, WarnsOfOutputsThatAFormatCantSet) {
  part<QMenu>("programs").actions().back()->trigger();
  add_step("Set an output");
  plan();
  ASSERT_TRUE(tool<gui::TaskTool>().plan().solved) << tool<gui::TaskTool>().plan().reason;
  click("task_export");
  auto* dialog = window().findChild<gui::ExportDialog*>();
  ASSERT_NE(dialog, nullptr);
  const auto says = [&](const char* text) {
    return std::ranges::any_of(dialog->findChildren<QLabel*>(), [&](const QLabel* label) {
      return label->text().contains(QLatin1String(text));
    });
  };
  dialog->choose_format("csv");
  EXPECT_TRUE(QTest::qWaitFor([&] { return says("csv does not set the output do1 to true"); },
                              kPatienceMs));
  dialog->choose_format("val3");
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return says("The motion takes") && !says("does not set the output"); }, kPatienceMs));
}

TEST_F(PickAndPlaceWithPlugins, SimulatesWhetherTheHandHoldsTheObject) {
  plan();
  ASSERT_TRUE(tool<gui::TaskTool>().plan().solved);
  const planning::SceneState before = editor().state();
  click("task_simulate");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::TaskTool>().is_busy(); }, 60000));
  ASSERT_TRUE(tool<gui::TaskTool>().simulation().has_value());
  const gui::SimulatedTask& simulated = *tool<gui::TaskTool>().simulation();
  EXPECT_TRUE(simulated.result.held());
  EXPECT_THAT(part<QLabel>("task_note").text().toStdString(),
              ::testing::HasSubstr("Simulated with 0.1 kg and friction 0.6: the object is held."));
  auto& moment = *part<gui::FilmBar>("task_film").findChild<QSlider*>();
  EXPECT_EQ(moment.maximum() + 1, static_cast<int>(simulated.frames.size()));
  const auto lifted = std::ranges::find_if(simulated.frames, [](const gui::TaskFrame& frame) {
    return frame.X_WO.at(0).translation().z() > 0.78;  // m; the table's top is at 0.74
  });
  ASSERT_NE(lifted, simulated.frames.end());
  EXPECT_GE(lifted->forces.size(), 2U);
  moment.setValue(static_cast<int>(lifted - simulated.frames.begin()));
  EXPECT_EQ(part<QPushButton>("task_play").text(), "Stop") << "at a pause";
  keep_picture("simulated_task");
  click("task_play");
  EXPECT_FALSE(moment.isEnabled());
  EXPECT_EQ(editor().state(), before) << "only shown";
}

TEST_F(PickAndPlace, KeepsTheStepsAsAProgramOfTheScene) {
  plan();
  click("task_keep");
  ASSERT_EQ(scene().programs.size(), 2U);
  EXPECT_EQ(scene().programs[0].name, "program") << "it had none";
  EXPECT_EQ(scene().programs[1].name, "place can");
  EXPECT_EQ(scene().programs[1].steps.size(), 3U);
  EXPECT_TRUE(tool<gui::TaskTool>().plan().solved) << "the plan is kept, too";
  EXPECT_FALSE(part<QComboBox>("task_support").isVisible());
  EXPECT_EQ(part<QPushButton>("task_keep").text(), "Remove");
  click("task_keep");
  ASSERT_EQ(scene().programs.size(), 1U);
  EXPECT_FALSE(part<QPushButton>("task_plan").isVisible());
  editor().undo_stack().undo();
  editor().undo_stack().undo();
  EXPECT_EQ(scene().programs.at(0).name, "");
}

TEST_F(PickAndPlace, PlansAProgramOfTheScene) {
  part<QMenu>("programs").actions().at(0)->trigger();
  EXPECT_FALSE(part<QComboBox>("task_support").isVisible());
  EXPECT_EQ(part<QLabel>("task_note").text().toStdString(),
            "Steps: pick can, place on table, move to start");
  plan();
  ASSERT_TRUE(tool<gui::TaskTool>().plan().solved);
  keep_picture("program_of_the_scene");
}

/// A plan that runs on an emulated arm and hand, from the card to the panel Devices.
class PickAndPlaceOnDevices : public PickAndPlace {
 protected:
  void SetUp() override {
    PickAndPlace::SetUp();
    if (IsSkipped()) {
      return;
    }
    plan();
    QObject::connect(&driver(), &gui::MotionDriver::part_begun, &window(),
                     [this](int, const QString& name) { parts_ << name; });
    QObject::connect(&driver(), &gui::MotionDriver::ended, &window(),
                     [this](const execution::MotionOutcome& outcome) { outcome_ = outcome; });
    click("task_run");
    ASSERT_TRUE(part<QPushButton>("devices_connect").isVisible()) << "its panel comes forward";
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return window().document().problem()->if_ready() != nullptr; }, kPatienceMs));
    click("devices_connect");
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return driver().state() == gui::MotionDriver::State::kConnected; }, kPatienceMs));
  }
  [[nodiscard]] gui::MotionDriver& driver() const { return window().workbench().driver; }
  /// Sets the speed, ticks that the robot may move, and presses Run.
  void run(double speed) {
    auto& row = part<gui::SliderRow>("devices_speed");
    row.set_value(speed);
    emit row.value_edited(speed);
    auto& armed = part<QCheckBox>("devices_armed");
    ASSERT_TRUE(QTest::qWaitFor([&] { return armed.isEnabled(); }, kPatienceMs))
        << text("devices_motion");
    EXPECT_THAT(text("devices_motion"), ::testing::HasSubstr("place_can"));
    armed.click();
    click("devices_run");
  }
  [[nodiscard]] std::string text(const char* label) const {
    return part<QLabel>(label).text().toStdString();
  }
  [[nodiscard]] bool reaches_part(const char* name) {
    return QTest::qWaitFor([&] { return parts_.contains(QLatin1String(name)); }, kPatienceMs);
  }

  QStringList parts_;
  std::optional<execution::MotionOutcome> outcome_;
};

TEST_F(PickAndPlaceOnDevices, MovesTheObjectInTheSceneToo) {
  const geometric::Pose before = geometric::find_object(scene(), "can")->X_PO;
  const geometric::Pose placed = tool<gui::TaskTool>().plan().stages.back().state.find("can")->X_PO;
  run(1.0);
  ASSERT_TRUE(reaches_part("carry (place on table)"));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return text("devices_progress").find("carry (place on table)") != std::string::npos; },
      kPatienceMs));
  keep_picture("task_on_devices");
  ASSERT_TRUE(QTest::qWaitFor([&] { return outcome_.has_value(); }, kPatienceMs));
  EXPECT_TRUE(outcome_->done) << outcome_->fault << outcome_->collision;
  EXPECT_TRUE(parts_.contains("hold (pick can)"));
  EXPECT_TRUE(geometric::find_object(scene(), "can")->X_PO.isApprox(placed));
  EXPECT_TRUE(tool<gui::TaskTool>().plan().stages.empty()) << "it is planned again from there";
  editor().undo_stack().undo();
  EXPECT_TRUE(geometric::find_object(scene(), "can")->X_PO.isApprox(before));
}

TEST_F(PickAndPlaceOnDevices, HoldsForGoodWhenTheSceneIsEdited) {
  run(0.3);
  ASSERT_TRUE(reaches_part("approach (pick can)"));
  editor().set_goal(*scene().start, *scene().start);
  ASSERT_TRUE(QTest::qWaitFor([&] { return driver().is_held(); }, kPatienceMs));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return text("devices_problem").find("plan the task again") != std::string::npos; },
      kPatienceMs));
  click("devices_hold");  // Continue
  ASSERT_TRUE(QTest::qWaitFor([&] { return driver().is_held(); }, kPatienceMs));
  driver().stop();
  ASSERT_TRUE(QTest::qWaitFor([&] { return outcome_.has_value(); }, kPatienceMs));
  EXPECT_FALSE(outcome_->done);
  EXPECT_EQ(outcome_->fault, "");
}

TEST_F(PickAndPlace, ForgetsThePlanWhenSomethingElseIsAskedFor) {
  plan();
  ASSERT_TRUE(tool<gui::TaskTool>().plan().solved);
  part<QDoubleSpinBox>("task_mass").setValue(0.3);
  EXPECT_FALSE(part<QTreeWidget>("task_stages").isVisible());
  EXPECT_TRUE(tool<gui::TaskTool>().plan().stages.empty());
}

TEST_F(PickAndPlace, PlansAgainWithTheSameGraspWhenTheObjectIsMoved) {
  plan();
  ASSERT_TRUE(tool<gui::TaskTool>().plan().solved);
  const auto grasp_of_can = [this] {
    const gui::TaskTool& task = tool<gui::TaskTool>();
    return planning::grasps_of({geometric::PickStep{"can"}, geometric::PlaceStep{{"table"}}},
                               task.plan())
        .at("can")
        .at(0);
  };
  const geometric::Pose X_OP = grasp_of_can().X_OP;
  geometric::Pose aside = geometric::find_object(scene(), "can")->X_PO;
  aside.translation().y() += 0.05;
  editor().place(aside);
  EXPECT_TRUE(tool<gui::TaskTool>().plan().stages.empty()) << "it was of another scene";
  EXPECT_THAT(part<QLabel>("task_note").text().toStdString(), ::testing::HasSubstr("again"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::TaskTool>().is_busy(); }, 120000));
  const planning::TaskPlan& plan = tool<gui::TaskTool>().plan();
  ASSERT_TRUE(plan.solved) << plan.reason;
  EXPECT_TRUE(plan.stages.front().state.find("can")->X_PO.isApprox(aside));
  EXPECT_TRUE(grasp_of_can().X_OP.isApprox(X_OP, 1e-6));
  EXPECT_EQ(part<QPushButton>("task_play").text(), "Play") << "it doesn't play while one edits";
  keep_picture("followed_task");
}

TEST_F(PickAndPlace, LeavesRoomForTheCardAboutTheGoal) {
  window().resize(1440, 900);
  plan();
  geometric::Pose aside = geometric::find_object(scene(), "can")->X_PO;
  aside.translation().y() += 0.05;  // where the goal has the fingers
  editor().place(aside);
  const gui::DoctorCard& doctor = tool<gui::QueryCheck>().card();
  ASSERT_TRUE(QTest::qWaitFor([&] { return doctor.isVisible(); }, kPatienceMs));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::TaskTool>().is_busy(); }, 120000));
  const auto& task = tool<gui::TaskCard>();
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return !doctor.geometry().intersects(task.geometry()); }, kPatienceMs));
  keep_picture("task_and_doctor");
}

TEST_F(PickAndPlace, PlansAgainOnceAnEditMakesItPossible) {
  const geometric::Pose near = geometric::find_object(scene(), "can")->X_PO;
  geometric::Pose away = near;
  away.translation().x() += 5.0;
  editor().place(away);
  plan();
  ASSERT_FALSE(tool<gui::TaskTool>().plan().solved);
  editor().place(near);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::TaskTool>().is_busy(); }, 120000));
  EXPECT_TRUE(tool<gui::TaskTool>().plan().solved);
}

TEST_F(PickAndPlace, KeepsTheChoiceOfTheSupportInAnEditedScene) {
  editor().add("shelf", geometric::Box{{0.3, 0.3, 0.02}}, {}, {0.5, 0.4, 0.9});
  auto& supports = part<QComboBox>("task_support");
  ASSERT_TRUE(supports.isVisible());
  ASSERT_GE(supports.findText("shelf"), 0);
  supports.setCurrentText("shelf");
  editor().add("ball", geometric::Sphere{0.03}, {}, {0.5, -0.4, 1.2});
  EXPECT_EQ(supports.currentText(), "shelf");
}

TEST_F(PickAndPlace, EndsWhenTheObjectIsRemoved) {
  plan();
  select("can");
  editor().remove();
  EXPECT_FALSE(part<QPushButton>("task_plan").isVisible());
  EXPECT_FALSE(tool<gui::TaskTool>().is_busy());
  EXPECT_TRUE(tool<gui::TaskTool>().plan().stages.empty());
}

TEST_F(PickAndPlace, SaysWhyThereIsNoPlan) {
  geometric::Pose away = geometric::find_object(scene(), "can")->X_PO;
  away.translation().x() += 5.0;
  editor().place(away);
  part<QAction>("pick_and_place").trigger();
  plan();
  EXPECT_FALSE(tool<gui::TaskTool>().plan().solved);
  EXPECT_THAT(part<QLabel>("task_note").text().toStdString(),
              ::testing::HasSubstr("out of the arm's reach"));
  const QString reason = part<QLabel>("task_note").text();
  click_stage("Close the hand");
  EXPECT_THAT(part<QLabel>("task_note").text().toStdString(),
              ::testing::HasSubstr("Close the hand: 1 of 1 failed. The first:"));
  keep_picture("failed_stage");
  click_stage("Close the hand");
  EXPECT_EQ(part<QLabel>("task_note").text(), reason);
}

TEST_F(PickAndPlace, EndsItsSearchWhenItIsStopped) {
  click("task_plan");
  click("task_stop");
  EXPECT_FALSE(tool<gui::TaskTool>().is_busy());
  EXPECT_EQ(part<QLabel>("task_note").text().toStdString(), "The search was stopped.");
}

}  // namespace
}  // namespace handway::test
