#include "features/editing/scene_tree.h"
#include "model/document/collision_monitor.h"
#include "window_test.h"

#include <QPushButton>

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

}  // namespace
}  // namespace handway::test
