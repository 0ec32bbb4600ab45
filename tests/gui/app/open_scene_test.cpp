#include "features/editing/scene_tree.h"
#include "model/document/collision_monitor.h"
#include "patience.h"
#include "window_test.h"

#include <QPushButton>

#include <fstream>

namespace handway::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

class OpenScene : public WindowTest {
 protected:
  [[nodiscard]] std::vector<std::string> rows() const {
    std::vector<std::string> texts;
    auto* tree = window().findChild<gui::SceneTree*>();
    for (QTreeWidgetItemIterator it(tree); *it; ++it) {
      texts.push_back((*it)->text(0).toStdString());
    }
    return texts;
  }
};

TEST_F(OpenScene, BeginsEmptyWithNothingToPlan) {
  EXPECT_THAT(rows(), ::testing::IsEmpty());
  EXPECT_FALSE(part<QPushButton>("plan").isEnabled());
  EXPECT_EQ(window().message(), QString());
}

TEST_F(OpenScene, ListsRobotObjectsAndTask) {
  open(cell().post());
  EXPECT_THAT(rows(), IsSupersetOf({"arm", "palm", "finger_left", "post", "Start", "Goal"}));
  EXPECT_THAT(window().windowTitle().toStdString(), HasSubstr("Small cell"));
  EXPECT_TRUE(part<QPushButton>("plan").isEnabled());
}

TEST_F(OpenScene, AnswersABrokenFileWithOneMessageAndKeepsTheSceneBefore) {
  open(cell().post());
  open(cell().broken());
  EXPECT_THAT(window().message().toStdString(),
              ::testing::AllOf(HasSubstr("broken.yaml:5"), HasSubstr("object")));
  EXPECT_TRUE(window().isVisible());
  EXPECT_THAT(rows(), IsSupersetOf({"arm", "post"}));
  open(cell().post());
  EXPECT_EQ(window().message(), QString()) << "a scene that opens puts the message away";
}

TEST_F(OpenScene, AnswersAMissingFile) {
  open(cell().folder() / "nowhere.yaml");
  EXPECT_THAT(window().message().toStdString(), HasSubstr("nowhere.yaml"));
}

TEST_F(OpenScene, ShowsTheLastOfTwoFilesOpenedInARow) {
  const std::filesystem::path file = cell().post();
  window().open(QString::fromStdString(cell().broken().string()));
  open(file);
  EXPECT_EQ(window().message(), QString());
  EXPECT_THAT(rows(), IsSupersetOf({"arm", "post"}));
}

TEST_F(OpenScene, SaysWhatTouchesWhat) {
  open(cell().goal_in_wall());
  gui::CollisionReport report;
  QObject::connect(&window().workbench().collisions, &gui::CollisionMonitor::checked, &window(),
                   [&](const gui::CollisionReport& found) { report = found; });
  click("go_to_goal");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !report.collisions.empty(); }));
  EXPECT_EQ(report.collisions.front().b, "wall");
}

// Many published hands are like this.
TEST_F(OpenScene, ShowsARobotWithoutCollisionGeometry) {
  const std::filesystem::path file = cell().folder() / "bare.urdf";
  std::ofstream(file) << R"(<robot name="bare">
    <link name="palm"><visual><geometry><box size="0.1 0.1 0.02"/></geometry></visual></link>
    <link name="finger"><visual><geometry><box size="0.01 0.01 0.08"/></geometry></visual></link>
    <joint name="knuckle" type="revolute"><parent link="palm"/><child link="finger"/>
      <axis xyz="0 1 0"/><limit lower="0" upper="1.5" effort="1" velocity="1"/></joint>
  </robot>)";
  open(file);
  EXPECT_EQ(window().message(), QString());
  EXPECT_THAT(rows(), IsSupersetOf({"bare", "palm", "finger"}));
  gui::Workbench& workbench = window().workbench();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !workbench.collisions.is_busy(); }, kPatienceMs));
  geometric::Configuration q = window().document().configuration();
  workbench.editor.set_start(q);
  q[0] = 1.0;
  workbench.editor.set_goal(q);
  plan();
  EXPECT_FALSE(window().player().timeline().empty()) << result();
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.analysis.motion() != nullptr; }, kPatienceMs));
}

}  // namespace
}  // namespace handway::test
