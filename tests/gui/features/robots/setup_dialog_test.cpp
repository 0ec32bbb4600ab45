#include "features/robots/setup_dialog.h"

#include "features/editing/editing_test.h"
#include "features/robots/group_table.h"
#include "features/robots/pair_table.h"
#include "features/robots/robot_files.h"
#include "handway/geometric/formats/srdf.h"
#include "patience.h"

#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QTabWidget>

#include <fstream>

namespace handway::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class RobotSetup : public EditingTest {
 protected:
  void SetUp() override {
    EditingTest::SetUp();
    if (!IsSkipped()) {
      open(files_ / "gripper.urdf");
      part<QAction>("robot_setup").trigger();
    }
  }
  void wait_for_samples() const {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::SetupDialog>().is_busy(); }, kPatienceMs));
  }

  [[nodiscard]] QTreeWidgetItem& row_of(const char* joint) const {
    return *part<gui::GroupTable>("setup_joints")
                .findItems(QLatin1String(joint), Qt::MatchExactly)
                .front();
  }
  /// Returns the owner of a joint by the boxes: "arm", "hand", "arm and hand" or "".
  [[nodiscard]] std::string owner_of(const char* joint) const {
    const bool arm = row_of(joint).checkState(1) == Qt::Checked;
    const bool hand = row_of(joint).checkState(2) == Qt::Checked;
    return std::string(arm ? "arm" : "") + (arm && hand ? " and " : "") + (hand ? "hand" : "");
  }
  void write() const {
    click("setup_write");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !editor().is_composing(); }, kPatienceMs));
  }
  /// Joints of a group in the scene, and in the SRDF; a joint in one alone fails.
  [[nodiscard]] std::vector<std::string> written(const char* group) const {
    const auto joints_in = [&](const geometric::RobotDescription& robot) {
      const auto found = std::ranges::find(robot.groups, group, &geometric::JointGroup::name);
      return found == robot.groups.end() ? std::vector<std::string>{} : found->joints;
    };
    geometric::RobotDescription robot = scene().robots.front().model->description();
    const std::vector<std::string> joints = joints_in(robot);
    geometric::read_srdf(files_ / "gripper.srdf", robot);
    EXPECT_EQ(joints_in(robot), joints) << "of the file";
    return joints;
  }

  RobotFiles files_;
};

TEST_F(RobotSetup, ListsFindingsWithTheirMendsAndShowsThem) {
  wait_for_samples();
  const auto& dialog = tool<gui::SetupDialog>();
  ASSERT_FALSE(dialog.findings().empty());
  auto& list = part<QListWidget>("setup_findings");
  ASSERT_EQ(list.count(), static_cast<int>(dialog.findings().size()));
  EXPECT_THAT(list.item(0)->text().toStdString(), HasSubstr(dialog.findings().front().mend));
  list.setCurrentRow(0);
  EXPECT_THAT(part<QLabel>("setup_groups").text().toStdString(), HasSubstr("Palm</b> base"));
  keep_picture("robot_setup");
}

TEST_F(RobotSetup, WritesTheSrdfAndGoesOnWithIt) {
  EXPECT_THAT(part<QLabel>("setup_outcome").text().toStdString(), HasSubstr("no SRDF yet"));
  wait_for_samples();
  const auto before = scene().robots.front().model;
  click("setup_write");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !editor().is_composing(); }, kPatienceMs));
  EXPECT_TRUE(std::filesystem::exists(files_ / "gripper.srdf"));
  EXPECT_NE(scene().robots.front().model, before);
  EXPECT_TRUE(scene().robots.front().model->find_group("hand"));
  EXPECT_THAT(part<QLabel>("setup_outcome").text().toStdString(), HasSubstr("Wrote"));
  EXPECT_EQ(editor().undo_stack().undoText(), "Set up gripper");
}

TEST_F(RobotSetup, LetsPairsOfLinksBeDecidedByHand) {
  wait_for_samples();
  part<QTabWidget>("setup_tabs").setCurrentIndex(1);
  auto& table = part<gui::PairTable>("setup_pairs");
  const auto row_of = [&](const QString& links) {
    const auto rows = table.findItems(links, Qt::MatchExactly);
    return rows.isEmpty() ? nullptr : rows.front();
  };
  const QString links = QStringLiteral("finger_a and finger_b");
  ASSERT_TRUE(row_of(links));
  const bool touches = row_of(links)->checkState(0) == Qt::Checked;
  row_of(links)->setCheckState(0, touches ? Qt::Unchecked : Qt::Checked);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        return row_of(links)->text(1) ==
               (touches ? QLatin1String("Checked") : QLatin1String("Allowed by hand"));
      },
      kPatienceMs));
  click("setup_write");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !editor().is_composing(); }, kPatienceMs));
  const auto& allowed = scene().robots.front().model->description().allowed_collisions;
  EXPECT_EQ(allowed.reason("finger_a", "finger_b").has_value(), !touches);
}

TEST_F(RobotSetup, ListsPairsByWhyTheyMayTouch) {
  wait_for_samples();
  auto& kind = part<QComboBox>("setup_pair_kind");
  EXPECT_EQ(kind.itemText(0), "All pairs (6)");
  const int adjacent = kind.findText(QStringLiteral("Adjacent (3)"));
  ASSERT_GE(adjacent, 0);
  kind.setCurrentIndex(adjacent);
  const auto& table = part<gui::PairTable>("setup_pairs");
  int shown = 0;
  for (int row = 0; row < table.topLevelItemCount(); ++row) {
    shown += table.topLevelItem(row)->isHidden() ? 0 : 1;
  }
  EXPECT_EQ(shown, 3);
}

TEST_F(RobotSetup, MovesJointsBetweenGroups) {
  wait_for_samples();
  part<QTabWidget>("setup_tabs").setCurrentIndex(2);
  for (const char* joint : {"a", "bend", "b"}) {
    EXPECT_EQ(owner_of(joint), "hand");
  }
  row_of("a").setCheckState(1, Qt::Checked);
  ASSERT_TRUE(QTest::qWaitFor([&] { return owner_of("a") == "arm"; }, kPatienceMs));
  row_of("b").setCheckState(2, Qt::Unchecked);
  ASSERT_TRUE(QTest::qWaitFor([&] { return owner_of("b").empty(); }, kPatienceMs));
  EXPECT_THAT(part<QLabel>("setup_groups").text().toStdString(), HasSubstr("Arm</b> a"));
  keep_picture("robot_setup_joints");
  write();
  EXPECT_THAT(written("arm"), ElementsAre("a"));
  EXPECT_THAT(written("hand"), ElementsAre("bend"));
  editor().undo_stack().undo();
  EXPECT_FALSE(scene().robots.front().model->find_group("arm")) << "an edit like any other";
}

TEST_F(RobotSetup, DecidesForAllJointsThatAreSelected) {
  wait_for_samples();
  part<gui::GroupTable>("setup_joints").selectAll();
  row_of("bend").setCheckState(1, Qt::Checked);
  ASSERT_TRUE(QTest::qWaitFor([&] { return owner_of("b") == "arm"; }, kPatienceMs));
  EXPECT_EQ(owner_of("a"), "arm");
  write();
  EXPECT_THAT(written("arm"), ElementsAre("a", "bend", "b"));
  EXPECT_THAT(written("hand"), ElementsAre());
  EXPECT_TRUE(scene().robots.front().model->description().end_effectors.empty());
}

TEST_F(RobotSetup, KeepsTheRestOfAnSrdfWhoseGroupsAreMoved) {
  wait_for_samples();
  std::ofstream(files_ / "gripper.srdf")
      << "<robot name=\"gripper\"><!-- by hand -->"
         "<group name=\"hand\"><joint name=\"a\"/><joint name=\"b\"/></group>"
         "<group name=\"left\"><joint name=\"a\"/></group>"
         "<group_state name=\"open\" group=\"left\"><joint name=\"a\" value=\"0.2\"/></group_state>"
         "</robot>";
  part<QPushButton>("setup_close").click();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  open(files_ / "gripper.urdf");
  part<QAction>("robot_setup").trigger();
  wait_for_samples();
  EXPECT_EQ(owner_of("bend"), "") << "as the SRDF says";
  row_of("b").setCheckState(2, Qt::Unchecked);
  ASSERT_TRUE(QTest::qWaitFor([&] { return owner_of("b").empty(); }, kPatienceMs));
  write();
  EXPECT_THAT(written("hand"), ElementsAre("a"));
  EXPECT_THAT(written("left"), ElementsAre("a"));
  std::ifstream file(files_ / "gripper.srdf");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(text, AllOf(HasSubstr("by hand"), HasSubstr("open")));
  click("setup_as_found");
  EXPECT_EQ(owner_of("bend"), "hand");
  EXPECT_EQ(owner_of("b"), "hand");
}

TEST_F(RobotSetup, StopsSamplingWithWhatThereIs) {
  click("setup_stop");
  wait_for_samples();
  EXPECT_TRUE(part<QPushButton>("setup_write").isEnabled());
  EXPECT_FALSE(part<QProgressBar>("setup_progress").isVisible());
  EXPECT_TRUE(part<QPushButton>("setup_again").isVisible());
}

}  // namespace
}  // namespace handway::test
