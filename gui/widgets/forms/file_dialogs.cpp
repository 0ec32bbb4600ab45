#include "widgets/forms/file_dialogs.h"

#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QFileDialog>
#include <QRegularExpression>

namespace handway::gui {

QString ask_where_to_save(QWidget* parent, const QString& title, const QString& name,
                          const QString& filters) {
  QFileDialog dialog(parent, title, {}, filters);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  const auto take_type = [&dialog](const QString& filter) {
    static const QRegularExpression kEnding(QStringLiteral("\\*\\.(\\w+)"));
    dialog.setDefaultSuffix(kEnding.match(filter).captured(1));
  };
  QObject::connect(&dialog, &QFileDialog::filterSelected, &dialog, take_type);
  take_type(dialog.selectedNameFilter());
  dialog.selectFile(name);
  return dialog.exec() == QDialog::Accepted ? dialog.selectedFiles().value(0) : QString();
}

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
