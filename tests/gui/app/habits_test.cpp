/// Tests habits of users, for which controls have to be and behave as expected.
#include "features/grasping/grasp_tool.h"
#include "handway/geometric/formats/scene_file.h"
#include "patience.h"
#include "view3d/scene_graph.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"
#include "window_test.h"

#include <QAction>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QTabWidget>

#include <cmath>
#include <numbers>

namespace handway::test {
namespace {

class Habits : public WindowTest {
 protected:
  [[nodiscard]] QPoint place_of(const char* button) const {
    return part<QWidget>(button).mapTo(&window(), QPoint());
  }
  [[nodiscard]] const geometric::Scene& scene() const { return *window().document().scene(); }
  [[nodiscard]] double distance() const { return window().view().camera().placement().distance; }
  /// @returns whether a command brings the camera to where that is so.
  template <typename Condition>
  [[nodiscard]] bool shows(Condition condition, const char* command = "fit") const {
    part<QAction>(command).trigger();
    return QTest::qWaitFor(condition, kPatienceMs);
  }
};

TEST_F(Habits, PlanAndCancelStayWhereTheyAre) {
  open(cell().post());
  const QPoint plan_place = place_of("plan"), cancel_place = place_of("cancel");
  plan();
  EXPECT_EQ(place_of("plan"), plan_place);
  EXPECT_EQ(place_of("cancel"), cancel_place);
  window().editor().set_goal(scene().start.value());
  QTest::qWait(100);
  EXPECT_EQ(place_of("plan"), plan_place);
}

TEST_F(Habits, EnterInAFieldGivesTheFocusBackToTheView) {
  open(cell().post());
  auto& seed = part<QSpinBox>("seed");
  seed.setFocus();
  QTest::keyClicks(&seed, QStringLiteral("7"));
  QTest::keyClick(&seed, Qt::Key_Return);
  EXPECT_TRUE(QTest::qWaitFor([&] { return window().focusWidget() == &window().view(); }, 1000));
}

TEST_F(Habits, WhatIsGreySaysWhyAndWhatToDo) {
  const auto look = [&](const char* when) {
    for (const QAction* bar : window().menuBar()->actions()) {
      for (const QAction* action : bar->menu()->actions()) {
        const bool is_undo = action->objectName() == QLatin1String("undo") ||
                             action->objectName() == QLatin1String("redo");
        EXPECT_TRUE(action->isEnabled() || action->isSeparator() || action->menu() || is_undo ||
                    action->statusTip().endsWith(QLatin1Char('.')))
            << when << ": " << qPrintable(action->text());
      }
    }
  };
  look("start page");
  open(cell().post());
  look("scene");
  geometric::Scene empty = scene();
  empty.goal.reset();
  geometric::write_scene(empty, cell().folder() / "no_goal.yaml");
  open(cell().folder() / "no_goal.yaml");
  look("scene without a goal");
  EXPECT_THAT(part<QPushButton>("plan").toolTip().toStdString(),
              ::testing::HasSubstr("Set goal here"));
}

TEST_F(Habits, KeysOfTheManualExistOnce) {
  std::map<QString, int> keys;
  for (const QAction* action : window().findChildren<QAction*>()) {
    for (const QKeySequence& key : action->shortcuts()) {
      ++keys[key.toString(QKeySequence::PortableText)];
    }
  }
  for (const char* key : {"Ctrl+N",
                          "Ctrl+O",
                          "Ctrl+S",
                          "Ctrl+Shift+S",
                          "Ctrl+Q",
                          "Ctrl+W",
                          "Ctrl+X",
                          "Ctrl+C",
                          "Ctrl+V",
                          "Ctrl+Z",
                          "Ctrl+Shift+Z",
                          "Ctrl+A",
                          "F2",
                          "Ctrl+D",
                          "Del",
                          "End",
                          "H",
                          "Ctrl+L",
                          "L",
                          "S",
                          "Ctrl+Shift+A",
                          "Ctrl+Shift+G",
                          "Ctrl+Shift+U",
                          "M",
                          "Ctrl+G",
                          "Ctrl+Alt+G",
                          "Ctrl+Shift+P",
                          "F1",
                          "Ctrl+P",
                          "Esc",
                          "Ctrl+E",
                          "F",
                          "Shift+F",
                          "0",
                          "1",
                          "2",
                          "3",
                          "5",
                          "G",
                          "N",
                          "C",
                          "D",
                          "X",
                          "Alt+1",
                          "Ctrl+,"}) {
    EXPECT_EQ(keys[QLatin1String(key)], 1) << key;
  }
}

TEST_F(Habits, EntriesOfAMenuHaveLettersOfTheirOwn) {
  open(cell().post());
  const auto letter_of = [](const QString& text) {
    return QKeySequence::mnemonic(text).toString(QKeySequence::PortableText);
  };
  for (const QAction* top : window().menuBar()->actions()) {
    EXPECT_FALSE(letter_of(top->text()).isEmpty()) << top->text().toStdString();
    std::map<QString, std::string> taken;
    std::vector<QString> without;
    for (const QAction* action : top->menu()->actions()) {
      const QString letter = letter_of(action->text());
      if (letter.isEmpty()) {
        without.push_back(action->text());
      } else {
        EXPECT_TRUE(taken.emplace(letter, action->text().toStdString()).second)
            << taken[letter] << " and " << action->text().toStdString();
      }
    }
    for (const QString& text : without) {
      for (const QChar letter : text) {
        EXPECT_TRUE(!letter.isLetter() || taken.contains(letter_of(QString("&") + letter)))
            << text.toStdString() << " could have " << QString(letter).toStdString();
      }
    }
  }
}

TEST_F(Habits, TheRoadmapAndItsCardStartHidden) {
  EXPECT_FALSE(part<QAction>("samples").isChecked());
  open(cell().post());
  plan();
  auto& card = part<QWidget>("roadmap_legend");
  EXPECT_FALSE(card.isVisible());
  part<QAction>("samples").trigger();
  EXPECT_TRUE(card.isVisible());
  const int unfolded = card.height();
  click("roadmap_fold");
  QTest::qWait(50);
  EXPECT_LT(card.height(), unfolded);
}

TEST_F(Habits, TheTimeGoesOnWhilePlanning) {
  open(cell().wall());  // no way: the planner goes on until it is stopped
  window().workbench().plan_settings.choose_planner("rrt-connect");
  click("plan");
  const auto seconds = [this] {
    const QRegularExpressionMatch found =
        QRegularExpression(QStringLiteral("([0-9.]+) s")).match(QString::fromStdString(result()));
    return found.hasMatch() ? found.captured(1).toDouble() : -1.0;
  };
  ASSERT_TRUE(QTest::qWaitFor([&] { return seconds() > 0.2; }, kPatienceMs)) << result();
  const double before = seconds();
  EXPECT_TRUE(QTest::qWaitFor([&] { return seconds() > before + 0.2; }, kPatienceMs)) << result();
  click("cancel");
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().session().is_running(); }, kPatienceMs));
}

TEST_F(Habits, PosesThatCantBeEditedDoNotLookEditable) {
  open(cell().post());
  auto& field = part<QDoubleSpinBox>("position_x");
  const auto picture = [&] {
    QTest::qWait(50);
    field.clearFocus();
    return field.grab().toImage();
  };
  window().editor().select({gui::SceneItem::Kind::kObject, "", "post"});
  const QColor editable = picture().pixelColor(4, field.height() / 2);
  window().editor().select({gui::SceneItem::Kind::kLink, "arm", "palm"});
  EXPECT_TRUE(field.isReadOnly());
  EXPECT_NE(picture().pixelColor(4, field.height() / 2), editable);
}

TEST_F(Habits, PlanningToAGraspShowsThePlanPanel) {
  auto& tabs = part<QTabWidget>("control_tabs");
  tabs.setCurrentIndex(1);
  emit tool<gui::GraspTool>().planning();
  EXPECT_EQ(tabs.currentWidget()->objectName(), QStringLiteral("plan"));
}

TEST_F(Habits, FShowsEverythingOrWhatIsSelected) {
  open(cell().post_aside());
  const double robot_alone = distance();
  window().editor().add("far", geometric::Box{{0.1, 0.1, 0.1}}, {}, {2.5, 0.0, 0.0});
  window().editor().select({});
  EXPECT_TRUE(shows([&] { return distance() > 1.3 * robot_alone; })) << distance();
  window().editor().select({gui::SceneItem::Kind::kObject, "", "far"});
  EXPECT_TRUE(shows([&] {
    const double off = std::abs(window().view().camera().placement().target.x() - 2.5);
    return distance() < 0.7 * robot_alone && off < 0.1;
  })) << distance();
  EXPECT_TRUE(shows([&] { return distance() > 1.3 * robot_alone; }, "show_all"));
}

// Reads the colours of the view from above.
TEST_F(Habits, WhatCollidesIsRedAndWhatIsRedItselfYellow) {
  open(cell().post_aside());
  constexpr geometric::Color kRed{0.85F, 0.1F, 0.1F, 1.0F}, kBlue{0.2F, 0.3F, 0.9F, 1.0F};
  window().editor().add("blue", geometric::Box{{0.1, 0.1, 0.1}}, kBlue, {0.15, 0.0, 0.0});
  window().editor().add("red", geometric::Box{{0.1, 0.1, 0.1}}, kRed, {0.4, 0.0, 0.0});
  window().editor().select({});
  gui::SceneView& view = window().view();
  view.set_camera({{0.3, 0.0, 0.1}, 1.0, 0.0, geometric::radians(89.0)});
  const auto hue_at = [&](const Eigen::Vector3d& p_W) {
    const QImage picture = view.grabFramebuffer();
    const QPointF place = gui::place_of(view.camera(), view.size(), p_W);
    return picture.pixelColor((place * view.devicePixelRatioF()).toPoint()).hslHue();
  };
  const auto is_red = [](int hue) { return hue < 20 || hue > 340; };
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        return is_red(hue_at({0.15, 0.0, 0.1}));
      },
      kPatienceMs))
      << hue_at({0.15, 0.0, 0.1});
  EXPECT_NEAR(hue_at({0.4, 0.0, 0.1}), 50, 15);
}

TEST_F(Habits, APathThatIsNoLongerValidStops) {
  open(cell().post_aside());
  plan();
  window().player().play();
  ASSERT_TRUE(window().player().is_playing());
  // The block is at the arm's goal: there is no other path.
  window().editor().add("block", geometric::Box{{0.2, 0.2, 0.2}}, {}, {0.04, 0.42, -0.1});
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().player().is_playing(); }, kPatienceMs));
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().message().isEmpty(); }, kPatienceMs));
  EXPECT_TRUE(window().message().contains(QStringLiteral("no longer valid")))
      << qPrintable(window().message());
}

}  // namespace
}  // namespace handway::test
