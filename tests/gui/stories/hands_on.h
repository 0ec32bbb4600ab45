#pragma once

#include "story.h"
#include "view3d/scene_view.h"

#include <QAbstractSpinBox>
#include <QMenuBar>
#include <QTabBar>
#include <QTabWidget>

#include <stdexcept>
#include <string>

namespace handway::test {

/// A story that is done with the mouse and the keys alone, as a person would.
class HandsOn : public Story {
 protected:
  void SetUp() override {
    Story::SetUp();
    if (!IsSkipped()) {
      activate();
    }
  }
  /// Keys are for the active window alone, and there may be no window manager that makes it so.
  void activate() const { QApplication::setActiveWindow(&window()); }
  template <typename Widget>
  [[nodiscard]] Widget& part(const char* name) const {
    auto* widget = window().findChild<Widget*>(QLatin1String(name));
    if (!widget) {
      throw std::runtime_error(std::string("no part called ") + name);
    }
    return *widget;
  }
  static void click(QWidget& widget, const QPoint& place) {
    QTest::mouseMove(&widget, place);
    QTest::mouseClick(&widget, Qt::LeftButton, {}, place);
  }
  static void click(QWidget& widget) { click(widget, widget.rect().center()); }

  /// A key, for whatever has the focus.
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) const {
    QWidget* focus = window().focusWidget();
    QTest::keyClick(focus ? focus : &window(), key, modifiers);
  }

  static QAction& entry(const QWidget& of, const char* words) {
    for (QAction* action : of.actions()) {
      if (action->text().remove(QLatin1Char('&')) == QString::fromUtf8(words)) {
        return *action;
      }
    }
    throw std::runtime_error(std::string("no entry ") + words);
  }
  /// Clicks on a menu of the menu bar, and on an entry of it.
  void choose(const char* menu, const char* words) const {
    QMenuBar& bar = *window().menuBar();
    QAction& top = entry(bar, menu);
    click(bar, bar.actionGeometry(&top).center());
    ASSERT_TRUE(wait_for([&] { return top.menu()->isVisible(); })) << menu;
    QAction& chosen = entry(*top.menu(), words);
    ASSERT_TRUE(chosen.isEnabled()) << words;
    click(*top.menu(), top.menu()->actionGeometry(&chosen).center());
    ASSERT_TRUE(wait_for([&] { return !top.menu()->isVisible(); })) << menu;
    activate();  // a window manager does it when a menu closes
  }
  /// Clicks into a field, types over what is there, and presses Enter.
  void type(QWidget& field, const QString& text) const {
    QTest::qWait(20);  // it is laid out
    click(field);
    QTest::keyClick(window().focusWidget(), Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(window().focusWidget(), text);
    press(Qt::Key_Return);
    QCoreApplication::processEvents();
  }
  void type_into(const char* field, const char* text) const {
    type(part<QWidget>(field), QString::fromUtf8(text));
  }
  void choose_tab(const char* title) const {
    auto* tabs = part<QTabWidget>("control_tabs").findChild<QTabBar*>();
    for (int i = 0; i < tabs->count(); ++i) {
      if (tabs->tabText(i) == QLatin1String(title)) {
        tabs->setCurrentIndex(i);  // scrolled to where it is seen
        click(*tabs, tabs->tabRect(i).center());
      }
    }
  }
  void turn_joint(const char* name, const char* degrees) const {
    auto* field = part<QWidget>(name).findChild<QAbstractSpinBox*>();
    ASSERT_TRUE(field);
    type(*field, QString::fromUtf8(degrees));
  }
  [[nodiscard]] const geometric::SceneObject& object(const char* name) const {
    const geometric::SceneObject* found = geometric::find_object(scene(), name);
    if (!found) {
      throw std::runtime_error(std::string("no object called ") + name);
    }
    return *found;
  }
  void click_object(const char* name) const {
    const Eigen::Vector3d p_W = object(name).X_PO.translation();
    gui::SceneView& view = window().view();
    click(view, gui::place_of(view.camera(), view.size(), p_W).toPoint());
  }
};

}  // namespace handway::test
