#include "window_test.h"

#include <QApplication>
#include <QDialog>
#include <QDockWidget>
#include <QLineEdit>
#include <QTreeWidget>

#include <set>

namespace handway::test {
namespace {

class KeyboardHelp : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
      QApplication::setActiveWindow(&window());  // there may be no window manager
      window().view().setFocus();
    }
  }
  /// Returns the name of the dock that has the focus; empty: the view or the playback bar.
  [[nodiscard]] static QString pane() {
    for (const QWidget* widget = QApplication::focusWidget(); widget;
         widget = widget->parentWidget()) {
      if (qobject_cast<const QDockWidget*>(widget)) {
        return widget->objectName();
      }
    }
    return {};
  }
};

TEST_F(KeyboardHelp, F6GoesThroughAllPanesAndBack) {
  std::set<QString> seen;
  QWidget* const first = QApplication::focusWidget();
  ASSERT_EQ(first, &window().view());
  int steps = 0;
  do {
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_F6);
    seen.insert(pane());
    ++steps;
  } while (QApplication::focusWidget() != first && steps < 20);
  EXPECT_EQ(QApplication::focusWidget(), first);
  EXPECT_TRUE(seen.contains("scene")) << "the tree of the scene";
  EXPECT_GE(seen.size(), 4U);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_F6);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_F6, Qt::ShiftModifier);
  EXPECT_EQ(QApplication::focusWidget(), first);
}

TEST_F(KeyboardHelp, ListsTheShortcutsOfTheMenusAndFindsThem) {
  part<QAction>("help_shortcuts").trigger();
  auto& tree = part<QTreeWidget>("shortcuts_list");
  const auto rows = [&tree] {
    QStringList shown;
    for (int i = 0; i < tree.topLevelItemCount(); ++i) {
      for (int j = 0; j < tree.topLevelItem(i)->childCount(); ++j) {
        const QTreeWidgetItem& row = *tree.topLevelItem(i)->child(j);
        if (!row.isHidden()) {
          shown << row.text(0) + QLatin1Char('|') + row.text(1);
        }
      }
    }
    return shown;
  };
  EXPECT_GT(rows().size(), 40);
  EXPECT_TRUE(rows().contains("Undo|Ctrl+Z")) << rows().join('\n').toStdString();
  part<QLineEdit>("shortcuts_find").setText("f6");
  EXPECT_EQ(rows(), QStringList("Next pane, previous pane|F6, Shift+F6"));
  part<QDialog>("shortcuts").close();
}

}  // namespace
}  // namespace handway::test
