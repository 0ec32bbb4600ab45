#include "widgets/forms/file_dialogs.h"

#include <QFileDialog>
#include <QLineEdit>
#include <QRegularExpression>
#include <QTimer>

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
  // Typing then replaces the name alone. The desktop's own dialogs do so by themselves.
  QTimer::singleShot(0, &dialog, [&dialog] {
    if (auto* edit = dialog.findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))) {
      const int ending = edit->text().lastIndexOf(QLatin1Char('.'));
      edit->setSelection(0, ending > 0 ? ending : edit->text().size());
    }
  });
  return dialog.exec() == QDialog::Accepted ? dialog.selectedFiles().value(0) : QString();
}

}  // namespace handway::gui
