#include "widgets/forms/file_dialogs.h"

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

}  // namespace handway::gui
