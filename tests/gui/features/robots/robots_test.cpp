#include "features/editing/editing_test.h"
#include "features/editing/scene_tree.h"
#include "features/robots/add_robot_dialog.h"
#include "features/robots/robot_files.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/edits/scene_state.h"
#include "handway_test/fake_xacro.h"
#include "patience.h"
#include "widgets/panels/xacro_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QTimer>
#include <QTreeWidget>

namespace handway::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Kind = gui::SceneItem::Kind;

class Robots : public EditingTest {
 protected:
  [[nodiscard]] gui::AddRobotDialog& dialog() const { return tool<gui::AddRobotDialog>(); }
  [[nodiscard]] bool wait_until(const std::function<bool()>& condition) const {
    return QTest::qWaitFor(condition, kPatienceMs);
  }
  void settle() const {
    ASSERT_TRUE(wait_until([&] { return !editor().is_composing(); }));
  }
  void begin_to_add(const std::string& file) const {
    part<QAction>("robot").trigger();
    dialog().choose_file(files_ / file);
    ASSERT_TRUE(wait_until([&] {
      return !part<QLabel>("add_robot_note").text().startsWith(QLatin1String("Reading"));
    }));
  }
  void choose(const char* box, const QString& text) const {
    auto& choice = part<QComboBox>(box);
    const int row = choice.findText(text);
    ASSERT_GE(row, 0) << text.toStdString();
    choice.setCurrentIndex(row);
    emit choice.activated(row);
  }
  /// Mounts the gripper on the palm.
  void mount_gripper() const {
    begin_to_add("gripper.urdf");
    choose("add_robot_on", QStringLiteral("palm of arm"));
    click("add_robot_now");
    settle();
  }
  [[nodiscard]] const geometric::RobotInstance& robot() const { return scene().robots.front(); }
  /// Types a path into the file dialog that `opener` opens.
  void choose_in_dialog(const std::filesystem::path& path,
                        const std::function<void()>& opener) const {
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, &timer, [&] {
      if (auto* chooser = window().findChild<QFileDialog*>(QStringLiteral("robot_file_dialog"))) {
        timer.stop();
        chooser->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))
            ->setText(QString::fromStdString(path.string()));
        chooser->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open)->click();
      }
    });
    timer.start(50);
    opener();
    EXPECT_FALSE(timer.isActive()) << "no file dialog was opened";
  }
  /// Returns whether a scene of `name` alone opens soon.
  [[nodiscard]] bool opens_alone(const std::string& name) const {
    return wait_until([&] {
      const auto& opened = window().document().scene();
      return opened && opened->robots.front().name == name;
    });
  }

  RobotFiles files_;
};

TEST_F(Robots, AreMountedOnALinkInOneEditThatCanBeUndone) {
  const planning::SceneState before = editor().state();
  geometric::Configuration q = window().document().configuration();
  q[0] = 0.3;
  window().document().set_configuration(q);
  mount_gripper();
  ASSERT_EQ(scene().robots.size(), 1U);
  ASSERT_EQ(robot().parts.size(), 2U);
  EXPECT_EQ(robot().parts[1].name, "gripper");
  EXPECT_EQ(robot().parts[1].link, "palm");
  EXPECT_EQ(editor().undo_stack().undoText(), "Mount gripper");
  EXPECT_EQ(window().document().configuration().size(), q.size() + 3);
  EXPECT_EQ(window().document().configuration()[0], 0.3) << "the arm stays where it is shown";
  EXPECT_EQ(editor().selection(), (gui::SceneItem{Kind::kRobot, "gripper", ""}));
  EXPECT_TRUE(window().view().gizmo().is_shown());
  EXPECT_TRUE(wait_until([&] { return !window().findChild<gui::AddRobotDialog*>(); }));
  keep_picture("mounted");
  editor().undo_stack().undo();
  EXPECT_EQ(editor().state(), before);
  EXPECT_EQ(window().document().configuration(), q);
  editor().undo_stack().redo();
  EXPECT_EQ(robot().parts.size(), 2U);
}

TEST_F(Robots, GoOnTheLinkThatIsClickedWhileTheDialogIsOpen) {
  begin_to_add("camera.urdf");
  editor().click({Kind::kLink, "arm", "palm"}, false);
  EXPECT_EQ(part<QComboBox>("add_robot_on").currentText(), "palm of arm");
}

TEST_F(Robots, WithoutJointsAreMountedAsToolsAndCameras) {
  const geometric::Configuration q = window().document().configuration();
  begin_to_add("camera.urdf");
  choose("add_robot_on", QStringLiteral("palm of arm"));
  click("add_robot_now");
  settle();
  ASSERT_EQ(scene().robots.size(), 1U);
  EXPECT_EQ(robot().parts[1].name, "camera");
  EXPECT_EQ(window().document().configuration(), q);
  type("position_z", "60 mm");
  settle();
  EXPECT_NEAR(robot().parts[1].X_LB.translation().z(), 0.06, 1e-12);
  plan();
  EXPECT_FALSE(window().player().timeline().empty());
}

TEST_F(Robots, StandInFreeSpaceWithoutAMount) {
  begin_to_add("camera.urdf");
  choose("add_robot_on", part<QComboBox>("add_robot_on").itemText(0));
  part<QLineEdit>("add_robot_name").setText(QStringLiteral("eye"));
  click("add_robot_now");
  settle();
  ASSERT_EQ(scene().robots.size(), 2U);
  EXPECT_EQ(scene().robots[1].name, "eye");
  EXPECT_FALSE(scene().robots[1].X_WB.isApprox(geometric::Pose::Identity()));
  EXPECT_TRUE(scene().start) << "the query of the first robot stays";
}

TEST_F(Robots, AreOpenedAsASceneWhereThereIsNone) {
  window().document().close();
  choose_in_dialog(files_ / "gripper.urdf", [this] { part<QAction>("robot").trigger(); });
  EXPECT_TRUE(opens_alone("gripper"));
}

TEST_F(Robots, BeginANewSceneFromTheirFile) {
  part<QAction>("new_scene").trigger();
  choose_in_dialog(files_ / "gripper.urdf", [this] { click("new_scene_file"); });
  EXPECT_TRUE(opens_alone("gripper"));
}

TEST_F(Robots, SayWhatIsWrongWithTheirFile) {
  begin_to_add("broken.urdf");
  EXPECT_THAT(part<QLabel>("add_robot_note").text().toStdString(), HasSubstr("broken.urdf"));
  EXPECT_FALSE(part<QPushButton>("add_robot_now").isEnabled());
}

TEST_F(Robots, HaveMissingMeshesLookedForInAFolder) {
  begin_to_add("lost_mesh.urdf");
  EXPECT_THAT(part<QLabel>("add_robot_note").text().toStdString(), HasSubstr("no such file"));
  EXPECT_TRUE(part<QPushButton>("add_robot_search").isVisible());
  const ScratchFolder elsewhere;
  std::filesystem::copy_file(geometric::resource_dir() / "objects" / "can.stl",
                             elsewhere.path() / "lost.stl");
  choose_in_dialog(elsewhere.path(), [this] { click("add_robot_search"); });
  ASSERT_TRUE(wait_until([&] { return part<QPushButton>("add_robot_now").isEnabled(); }));
  EXPECT_FALSE(part<QPushButton>("add_robot_search").isVisible());
  EXPECT_THAT(part<QLabel>("add_robot_note").text().toStdString(), HasSubstr("lost.stl is "));
}

TEST_F(Robots, MoveOnTheirMountByNumbersAndByHandles) {
  mount_gripper();
  EXPECT_EQ(part<QComboBox>("mounted_on").currentText(), "palm of arm");
  type("position_z", "50 mm");
  settle();
  EXPECT_NEAR(robot().parts[1].X_LB.translation().z(), 0.05, 1e-12);
  geometric::Pose X_WO = *editor().selected_pose();
  X_WO.translation().z() += 0.02;
  emit window().view().dropped(editor().selection(), X_WO);
  settle();
  EXPECT_NEAR(robot().parts[1].X_LB.translation().z(), 0.07, 1e-9);
  EXPECT_EQ(editor().undo_stack().undoText(), "Move gripper");
}

TEST_F(Robots, AreMountedElsewhereTakenOffAndRemoved) {
  mount_gripper();
  choose("mounted_on", QStringLiteral("World"));
  settle();
  ASSERT_EQ(scene().robots.size(), 2U);
  EXPECT_EQ(scene().robots[1].name, "gripper");
  choose("mounted_on", QStringLiteral("palm of arm"));
  settle();
  ASSERT_EQ(scene().robots.size(), 1U);
  ASSERT_TRUE(part<QAction>("delete").isEnabled());
  part<QAction>("delete").trigger();
  settle();
  EXPECT_TRUE(robot().parts.empty());
  editor().select({Kind::kRobot, "arm", ""});
  EXPECT_FALSE(part<QAction>("delete").isEnabled()) << "a scene keeps one robot";
}

TEST_F(Robots, AreSeenInTheTreeWithWhatCarriesThem) {
  mount_gripper();
  const auto rows = window().findChild<gui::SceneTree*>()->findItems(
      QStringLiteral("gripper"), Qt::MatchExactly | Qt::MatchRecursive);
  ASSERT_EQ(rows.size(), 1);
  EXPECT_EQ(rows.front()->parent()->text(0), "arm");
  EXPECT_THAT(rows.front()->toolTip(0).toStdString(), HasSubstr("mounted on palm of arm"));
  EXPECT_GT(rows.front()->childCount(), 0);
}

TEST_F(Robots, ArePlannedWithAsAWhole) {
  mount_gripper();
  plan();
  ASSERT_FALSE(window().player().timeline().empty());
  EXPECT_EQ(window().player().timeline().at(0.0).size(), robot().model->variable_count());
  editor().undo_stack().undo();
  EXPECT_TRUE(window().player().timeline().empty()) << "the path was another robot's";
}

TEST_F(Robots, AreSavedWithTheScene) {
  mount_gripper();
  const std::filesystem::path file = files_ / "scene.yaml";
  window().document().save(file, window().workbench().plan_settings.choice());
  const geometric::Scene read = geometric::read_scene(file);
  ASSERT_EQ(read.robots.size(), 1U);
  EXPECT_EQ(read.robots.front().parts[1].name, "gripper");
}

TEST_F(Robots, AreExportedAsOne) {
  mount_gripper();
  const std::filesystem::path file = files_ / "whole.urdf";
  QTimer::singleShot(300, &window(), [&] {
    auto* dialog = window().findChild<QFileDialog*>(QStringLiteral("export_robot_dialog"));
    ASSERT_TRUE(dialog);
    dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))
        ->setText(QString::fromStdString(file.string()));
    dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Save)->click();
  });
  part<QAction>("export_robot").trigger();
  EXPECT_EQ(window().message(), QString());
  EXPECT_EQ(geometric::load_robot(file)->variable_count(), robot().model->variable_count());
  EXPECT_TRUE(std::filesystem::exists(files_ / "whole.srdf"));
}

TEST_F(Robots, CanBePlannedForInTurn) {
  begin_to_add("gripper.urdf");
  choose("add_robot_on", part<QComboBox>("add_robot_on").itemText(0));
  click("add_robot_now");
  settle();
  part<QAction>("plan_for_robot").trigger();
  EXPECT_EQ(robot().name, "gripper");
  EXPECT_FALSE(scene().goal);
  EXPECT_EQ(window().document().configuration().size(), 3);
  editor().undo_stack().undo();
  EXPECT_EQ(robot().name, "arm");
  EXPECT_TRUE(scene().goal);
}

class XacroRobots : public Robots {
 protected:
  XacroRobots() { std::ofstream(file_) << kXacroBox; }
  [[nodiscard]] QLineEdit* field(const char* name) const {
    return window().findChild<QLineEdit*>(QLatin1String(name));
  }
  [[nodiscard]] const geometric::RobotDescription& description() const {
    return robot().model->description();
  }

  FakeXacro program_;
  ScratchFolder folder_;
  std::filesystem::path file_ = folder_.path() / "box.xacro";
};

TEST_F(XacroRobots, AreOpenedWithTheArgumentsThatTheDialogAsksFor) {
  window().workbench().open(file_);
  ASSERT_TRUE(wait_until([&] { return field("xacro_size") != nullptr; }));
  EXPECT_EQ(robot().name, "arm") << "the scene stays until the dialog is answered";
  EXPECT_EQ(field("xacro_prefix")->text(), "left_");
  EXPECT_EQ(field("xacro_size")->text(), "0.1");
  keep_picture("xacro_arguments");
  field("xacro_prefix")->setText(QStringLiteral("right_"));
  click("xacro_open");
  ASSERT_TRUE(opens_alone("right_box"));
  EXPECT_EQ(description().xacro_arguments, (geometric::XacroArguments{{"prefix", "right_"}}));
  const std::filesystem::path saved = folder_.path() / "saved.yaml";
  window().document().save(saved, {});
  EXPECT_EQ(geometric::read_scene(saved).robots.front().model->name(), "right_box");
}

TEST_F(XacroRobots, AreNotOpenedIfTheDialogIsCancelled) {
  window().workbench().open(file_);
  ASSERT_TRUE(wait_until([&] { return window().findChild<gui::XacroDialog*>() != nullptr; }));
  window().findChild<gui::XacroDialog*>()->reject();
  EXPECT_TRUE(wait_until([&] { return window().findChild<gui::XacroDialog*>() == nullptr; }));
  EXPECT_EQ(robot().name, "arm");
}

TEST_F(XacroRobots, AreAddedWithArguments) {
  part<QAction>("robot").trigger();
  dialog().choose_file(file_);
  ASSERT_TRUE(wait_until([&] { return field("xacro_size") != nullptr; }));
  field("xacro_size")->setText(QStringLiteral("0.3"));
  click("xacro_open");
  ASSERT_TRUE(wait_until([&] { return part<QPushButton>("add_robot_now").isEnabled(); }));
  choose("add_robot_on", part<QComboBox>("add_robot_on").itemText(0));
  click("add_robot_now");
  settle();
  ASSERT_EQ(scene().robots.size(), 2U);
  EXPECT_EQ(scene().robots[1].model->description().xacro_arguments.at("size"), "0.3");
}

}  // namespace
}  // namespace handway::test
