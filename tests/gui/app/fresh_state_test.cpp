/// Tests that everything that is shown belongs to the open scene.
#include "features/planning/query_check.h"
#include "patience.h"
#include "widgets/panels/playback_bar.h"
#include "window_test.h"

#include <QLabel>
#include <QPushButton>
#include <QSpinBox>

namespace handway::test {
namespace {

class FreshState : public WindowTest {
 protected:
  [[nodiscard]] gui::SceneEditor& editor() const { return window().workbench().editor; }
  void wait_for_times() const {
    ASSERT_TRUE(QTest::qWaitFor([&] { return window().workbench().analysis.motion() != nullptr; },
                                kPatienceMs));
  }
  /// Returns the playback bar's text of times.
  [[nodiscard]] QString times() const {
    for (const auto* label : tool<gui::PlaybackBar>().findChildren<QLabel*>()) {
      if (label->objectName() == QLatin1String("playback_time")) {
        return label->text();
      }
    }
    return {};
  }
};

TEST_F(FreshState, TheCollisionCardGoesWithItsScene) {
  open(cell().goal_in_wall());
  const gui::DoctorCard& card = tool<gui::QueryCheck>().card();
  ASSERT_TRUE(QTest::qWaitFor([&] { return card.isVisible(); }, kPatienceMs));
  bool was_shown = false;
  QObject::connect(&window().document(), &gui::Document::opened, &window(),
                   [&] { was_shown = card.isVisible(); });
  open(cell().post_aside());
  EXPECT_FALSE(was_shown) << "from the moment on that the next scene is there";
  EXPECT_FALSE(card.isVisible());
}

TEST_F(FreshState, TheCollisionCardCanNotBeUsedBeforeAnEditWasLookedAt) {
  open(cell().goal_in_wall());
  const gui::DoctorCard& card = tool<gui::QueryCheck>().card();
  ASSERT_TRUE(QTest::qWaitFor([&] { return card.isVisible(); }, kPatienceMs));
  auto& use = part<QPushButton>("doctor_use");
  editor().set_start(*window().document().scene()->start);
  EXPECT_FALSE(use.isEnabled());
  EXPECT_TRUE(QTest::qWaitFor([&] { return use.isEnabled(); }, kPatienceMs));
}

TEST_F(FreshState, SeedsAreThoseOfTheScene) {
  open(cell().post());
  part<QSpinBox>("seed").setValue(7);
  part<QSpinBox>("seeds").setValue(5);
  part<QDoubleSpinBox>("margin").setValue(12.0);
  open(cell().post_aside());
  EXPECT_EQ(part<QSpinBox>("seed").value(), 1);
  EXPECT_EQ(part<QSpinBox>("seeds").value(), 1);
  EXPECT_EQ(part<QDoubleSpinBox>("margin").value(), 0.0);
}

TEST_F(FreshState, TimesArePendingUntilTheyAreKnown) {
  open(cell().post());
  plan();
  window().player().pause();
  wait_for_times();
  ASSERT_TRUE(times().endsWith(" s")) << times().toStdString();
  const QString before = times();
  editor().select(gui::object_item("post"));
  geometric::Pose X_WO = *editor().selected_pose();
  X_WO.translation().x() += 0.001;
  QStringList shown;
  QObject::connect(&window().player(), &gui::PathPlayer::retimed, &window(),
                   [&] { shown << times(); });
  QObject::connect(&window().player(), &gui::PathPlayer::timeline_changed, &window(),
                   [&] { shown << times(); });
  editor().place(X_WO);
  EXPECT_EQ(times(), "timing…");
  wait_for_times();
  ASSERT_TRUE(QTest::qWaitFor([&] { return times().endsWith(" s"); }, kPatienceMs));
  for (const QString& text : shown) {
    EXPECT_TRUE(text == "timing…" || text == times()) << text.toStdString();
  }
}

TEST_F(FreshState, TheTimelineIsWhereTheRobotIs) {
  open(cell().post());
  plan();
  wait_for_times();
  gui::PathPlayer& player = window().player();
  player.pause();
  player.seek(1.0);
  window().workbench().posing.set(*window().document().scene()->start);
  EXPECT_EQ(player.fraction(), 0.0);
  EXPECT_TRUE(times().startsWith("0.00")) << times().toStdString();
  geometric::Configuration aside = *window().document().scene()->start;
  aside[0] += 0.2;
  window().workbench().posing.set(aside);
  EXPECT_FALSE(player.is_at_robot());
  EXPECT_TRUE(times().startsWith("off path")) << times().toStdString();
  window().workbench().posing.set(*window().document().scene()->goal);
  EXPECT_EQ(player.fraction(), 1.0);
}

TEST_F(FreshState, ARobotBesideThePathStaysThereWhenTheSceneIsEdited) {
  open(cell().post());
  plan();
  wait_for_times();
  window().player().pause();
  geometric::Configuration aside = *window().document().scene()->start;
  aside[0] += 0.2;
  window().workbench().posing.set(aside);
  editor().select(gui::object_item("post"));
  geometric::Pose X_WO = *editor().selected_pose();
  X_WO.translation().x() += 0.001;
  editor().place(X_WO);
  wait_for_times();
  EXPECT_TRUE(window().document().configuration().isApprox(aside));
}

// Two windows may have one scene open.
TEST_F(FreshState, AFileThatAnotherWindowHasChangedIsKnown) {
  open(cell().post());
  gui::Document& document = window().document();
  EXPECT_FALSE(document.is_changed_on_disk());
  document.save(document.file(), {});
  EXPECT_FALSE(document.is_changed_on_disk());
  (void)cell().wall();  // the same file
  EXPECT_TRUE(document.is_changed_on_disk());
  open(document.file());
  EXPECT_FALSE(document.is_changed_on_disk());
}

}  // namespace
}  // namespace handway::test
