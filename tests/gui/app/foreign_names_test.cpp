/// Names from files are shown as they are written there, also those that look like HTML.
#include "features/planning/query_check.h"
#include "patience.h"
#include "widgets/panels/log_panel.h"
#include "window_test.h"

#include <QAbstractItemView>
#include <QDockWidget>
#include <QHelpEvent>
#include <QLabel>
#include <QShowEvent>
#include <QTabWidget>
#include <QTextDocument>
#include <QToolTip>

#include <fstream>

namespace handway::test {
namespace {

constexpr const char* kForeign = R"(<b>bold</b><img src="x">)";

// Returns what a person reads on a label.
QString words_on(const QLabel& label) {
  if (label.textFormat() == Qt::PlainText) {
    return label.text();
  }
  QTextDocument text;
  text.setHtml(label.text());
  return text.toPlainText();
}

// Holds the pointer still over a widget. Returns the tool tip that is shown; nullptr if none is.
const QLabel* tip_over(QWidget& widget, const QPoint& place) {
  QHelpEvent event(QEvent::ToolTip, place, widget.mapToGlobal(place));
  QApplication::sendEvent(&widget, &event);
  for (const QWidget* shown : QApplication::topLevelWidgets()) {
    if (shown->inherits("QTipLabel") && shown->isVisible()) {
      return static_cast<const QLabel*>(shown);
    }
  }
  return nullptr;
}

class ForeignNames : public WindowTest {
 protected:
  /// Returns a scene all of whose names look like HTML: an arm with one joint beside a box.
  /// @param goal of the joint, rad; 1.5 is inside of the box. @param joint that the start names.
  [[nodiscard]] std::filesystem::path scene(const std::string& goal,
                                            const std::string& joint = "joint") const {
    std::ofstream(cell().folder() / "foreign.urdf") << R"(
      <robot name="robot &lt;b>bold&lt;/b>&lt;img src=&quot;x&quot;>">
        <link name="base"><collision>
          <geometry><box size="0.05 0.05 0.05"/></geometry></collision></link>
        <link name="link &lt;b>bold&lt;/b>&lt;img src=&quot;x&quot;>"><collision>
          <origin xyz="0.2 0 0"/><geometry><box size="0.3 0.04 0.04"/></geometry></collision></link>
        <joint name="joint &lt;b>bold&lt;/b>&lt;img src=&quot;x&quot;>" type="revolute">
          <parent link="base"/><child link="link &lt;b>bold&lt;/b>&lt;img src=&quot;x&quot;>"/>
          <axis xyz="0 0 1"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
      </robot>)";
    const std::string foreign = kForeign;
    const std::filesystem::path file = cell().folder() / "foreign.yaml";
    std::ofstream(file) << "handway: 1\nname: 'scene " + foreign + "'\n"
                        << "robots:\n  - {name: 'robot " + foreign + "', model: foreign.urdf}\n"
                        << "objects:\n  - {name: 'object " + foreign +
                               "', box: {size: [0.1, 0.1, 0.1]}, pose: {xyz: [0, 0.25, 0]}}\n"
                        << "start: {'" + joint + " " + foreign + "': 0}\n"
                        << "goal: {'joint " + foreign + "': " + goal + "}\n";
    return file;
  }

  /// Brings all docks and tabs to the front, one after the other.
  void look_at_all_panels() const {
    for (QDockWidget* dock : window().findChildren<QDockWidget*>()) {
      dock->show();
      dock->raise();
      QTest::qWait(50);
    }
    for (QTabWidget* tabs : window().findChildren<QTabWidget*>()) {
      for (int i = 0; i < tabs->count(); ++i) {
        tabs->setCurrentIndex(i);
        QTest::qWait(50);
      }
      tabs->setCurrentIndex(0);
    }
  }
  /// Looks at all labels, hidden ones as they will be when they are shown. @returns how many of
  /// them show a foreign name.
  static int labels_with_a_name() {
    int count = 0;
    for (QWidget* widget : QApplication::allWidgets()) {
      auto* label = qobject_cast<QLabel*>(widget);
      if (!label) {
        continue;
      }
      QShowEvent event;
      QApplication::sendEvent(label, &event);
      const std::string seen =
          label->objectName().toStdString() + ": " + label->text().toStdString();
      EXPECT_NE(label->textFormat(), Qt::AutoText) << seen;
      const bool is_plain = label->textFormat() == Qt::PlainText;
      EXPECT_TRUE(is_plain || !label->text().contains(QLatin1String("<img"))) << seen;
      count += words_on(*label).contains(kForeign) ? 1 : 0;
    }
    return count;
  }
  /// Looks at the tool tips of all widgets on screen, and of what their lists, trees and tables
  /// hold. @returns how many of them show a foreign name.
  [[nodiscard]] int tips_with_a_name() const {
    int count = 0;
    const auto look_at = [&](QWidget& widget, const QPoint& place, const QString& tip) {
      const QLabel* shown = tip_over(widget, place);
      ASSERT_TRUE(shown) << tip.toStdString();
      EXPECT_EQ(shown->textFormat(), Qt::PlainText) << tip.toStdString();
      EXPECT_EQ(shown->text().simplified().remove(' '), tip.simplified().remove(' '));
      ++count;
    };
    for (QWidget* widget : window().findChildren<QWidget*>()) {
      if (!widget->isVisible()) {
        continue;
      }
      if (widget->toolTip().contains(kForeign)) {
        look_at(*widget, widget->rect().center(), widget->toolTip());
      }
      auto* view = qobject_cast<QAbstractItemView*>(widget);
      if (!view || !view->model() || view->model()->rowCount() == 0) {
        continue;
      }
      const QModelIndexList items =
          view->model()->match(view->model()->index(0, 0), Qt::ToolTipRole, kForeign, -1,
                               Qt::MatchContains | Qt::MatchRecursive);
      for (const QModelIndex& item : items) {
        view->scrollTo(item);
        const QPoint place = view->visualRect(item).center();
        if (view->viewport()->rect().contains(place)) {
          look_at(*view->viewport(), place, item.data(Qt::ToolTipRole).toString());
        }
      }
    }
    QToolTip::hideText();
    return count;
  }
};

TEST_F(ForeignNames, AreShownAsTheyAreInASceneWithACollision) {
  open(scene("1.5"));
  ASSERT_EQ(window().message(), QString());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::QueryCheck>().is_busy(); }, kPatienceMs));
  EXPECT_TRUE(words_on(part<QLabel>("doctor_text")).remove(QChar(0x200b)).contains(kForeign));
  window().editor().select(gui::object_item(std::string("object ") + kForeign));
  look_at_all_panels();
  EXPECT_GT(labels_with_a_name(), 0);
  show_dock("scene");
  EXPECT_GT(tips_with_a_name(), 1) << "those of robot and object in the tree";
}

TEST_F(ForeignNames, AreShownAsTheyAreAlongAPath) {
  open(scene("-1.5"));
  plan();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window().workbench().analysis.motion() != nullptr; },
                              kPatienceMs))
      << result();
  look_at_all_panels();
  const auto& motion = part<QLabel>("devices_motion");
  ASSERT_TRUE(QTest::qWaitFor([&] { return words_on(motion).contains("velocity"); }, kPatienceMs));
  EXPECT_TRUE(words_on(motion).contains(QStringLiteral("joint ") + kForeign))
      << motion.text().toStdString();
  EXPECT_GT(labels_with_a_name(), 0);
  show_dock("scene");
  show_dock("plots");
  EXPECT_GT(tips_with_a_name(), 2) << "those of the tree, and of the joint's curve";
}

TEST_F(ForeignNames, AreShownAsTheyAreInMessages) {
  open(scene("-1.5", "no joint"));
  EXPECT_TRUE(
      words_on(part<QLabel>("banner_text")).contains(QStringLiteral("no joint ") + kForeign))
      << window().message().toStdString();
  EXPECT_TRUE(
      window().workbench().log.toPlainText().contains(QStringLiteral("no joint ") + kForeign));
  EXPECT_GT(labels_with_a_name(), 0);
}

}  // namespace
}  // namespace handway::test
