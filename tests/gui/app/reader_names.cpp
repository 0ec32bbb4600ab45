#include "reader_names.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QComboBox>
#include <QLineEdit>
#include <QScrollBar>
#include <QTabBar>
#include <QToolBar>

namespace handway::test {
namespace {

bool is_worked_with(const QWidget& widget) {
  // Parts of other widgets: fields of spin boxes and choices, buttons of tab bars, headers.
  const QWidget* parent = widget.parentWidget();
  const bool is_part =
      qobject_cast<const QAbstractSpinBox*>(parent) || qobject_cast<const QComboBox*>(parent) ||
      qobject_cast<const QTabBar*>(parent) || qobject_cast<const QLineEdit*>(parent) ||
      qobject_cast<const QScrollBar*>(&widget) ||
      widget.objectName().startsWith(QLatin1String("qt_"));
  return !is_part &&
         (qobject_cast<const QAbstractButton*>(&widget) ||
          qobject_cast<const QAbstractSpinBox*>(&widget) ||
          qobject_cast<const QAbstractSlider*>(&widget) ||
          qobject_cast<const QComboBox*>(&widget) || qobject_cast<const QLineEdit*>(&widget) ||
          qobject_cast<const QTabBar*>(&widget) ||
          (qobject_cast<const QAbstractItemView*>(&widget) && !widget.inherits("QHeaderView")));
}

}  // namespace

QStringList faults_for_readers(const QWidget& of) {
  QStringList faults;
  for (QWidget* widget : of.findChildren<QWidget*>()) {
    if (!widget->isVisibleTo(&of) || !widget->isEnabled() || !is_worked_with(*widget)) {
      continue;
    }
    const QString words =
        QStringLiteral("%1 \"%2\" in %3")
            .arg(QLatin1String(widget->metaObject()->className()), widget->objectName(),
                 widget->parentWidget() ? widget->parentWidget()->objectName() : QString());
    const QAccessibleInterface* reader = QAccessible::queryAccessibleInterface(widget);
    const auto* tabs = qobject_cast<const QTabBar*>(widget);
    const bool has_name = (tabs && (tabs->count() == 0 || !tabs->tabText(0).isEmpty())) ||
                          (reader && !reader->text(QAccessible::Name).isEmpty()) ||
                          !widget->toolTip().isEmpty();
    if (!has_name) {
      faults << words + QStringLiteral(" has no name for a screen reader");
    }
    // The bars' commands are in the menus too, STOP has keys of its own, and the arrows move
    // through the palette's list while its field has the focus.
    const bool has_other_keys = qobject_cast<const QToolBar*>(widget->parentWidget()) ||
                                widget->objectName() == QLatin1String("devices_stop") ||
                                widget->objectName() == QLatin1String("palette_list");
    const auto* field = qobject_cast<const QAbstractSpinBox*>(widget);
    if (!(widget->focusPolicy() & Qt::TabFocus) && !has_other_keys &&
        !(field && field->isReadOnly())) {
      faults << words + QStringLiteral(" is not reached by the Tab key");
    }
  }
  return faults;
}

}  // namespace handway::test
