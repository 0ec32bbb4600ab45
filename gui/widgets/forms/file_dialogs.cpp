#include "widgets/forms/file_dialogs.h"

#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QFileDialog>

namespace handway::gui {

FileDialogTooltips::FileDialogTooltips(QObject* parent) : QObject(parent) {
  qApp->installEventFilter(this);
}

bool FileDialogTooltips::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Show && qobject_cast<QFileDialog*>(watched)) {
    for (auto* choice : watched->findChildren<QComboBox*>()) {
      choice->setToolTip(choice->currentText());
      connect(choice, &QComboBox::currentTextChanged, choice, &QWidget::setToolTip,
              Qt::UniqueConnection);
    }
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace handway::gui
