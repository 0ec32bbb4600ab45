#include "features/robots/setup_dialog.h"

#include "features/editing/editing_test.h"
#include "features/robots/pair_table.h"
#include "features/robots/robot_files.h"
#include "patience.h"

#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QTabWidget>

namespace handway::test {
namespace {

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

TEST_F(RobotSetup, StopsSamplingWithWhatThereIs) {
  click("setup_stop");
  wait_for_samples();
  EXPECT_TRUE(part<QPushButton>("setup_write").isEnabled());
  EXPECT_EQ(part<QProgressBar>("setup_progress").value(), 100);
}

}  // namespace
}  // namespace handway::test
