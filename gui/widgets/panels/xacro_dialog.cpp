#include "widgets/panels/xacro_dialog.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/theme.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include <algorithm>
#include <string>

namespace handway::gui {
namespace {

constexpr int kWidth = 520;         // px
constexpr int kHeight = 420;        // px
constexpr int kHeightOfRow = 38;    // px
constexpr int kHeightAround = 150;  // px, of words and buttons

}  // namespace

XacroDialog::XacroDialog(const std::filesystem::path& file, const geometric::XacroFile& contents,
                         QWidget* parent)
    : QDialog(parent), file_(file) {
  setObjectName(QStringLiteral("xacro_dialog"));
  setWindowTitle(tr("Arguments of %1").arg(QString::fromStdString(file.filename().string())));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* page = new QWidget;
  auto* form = new QFormLayout(page);
  form->setContentsMargins(0, 0, 0, 0);
  form->setHorizontalSpacing(12);
  form->setVerticalSpacing(8);
  for (const geometric::XacroArgument& argument : contents.arguments) {
    const QString name = QString::fromStdString(argument.name);
    auto* field = new QLineEdit(QString::fromStdString(argument.default_text.value_or("")));
    field->setObjectName(QStringLiteral("xacro_") + name);
    field->setAccessibleName(name);
    field->setPlaceholderText(argument.default_text ? tr("empty") : tr("no default"));
    form->addRow(new QLabel(name), field);
    fields_.emplace_back(argument, field);
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  auto* open = named("xacro_open", new QPushButton(tr("Open")));
  open->setProperty("role", "primary");
  open->setDefault(true);
  buttons->addButton(open, QDialogButtonBox::AcceptRole);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  QLabel* about = note(words(contents));
  about->setTextFormat(Qt::PlainText);
  about->setWordWrap(true);
  lay_out(*this, in_column({about, {new PanelArea(page), 1}, buttons}, 10), {16, 16, 16, 12});
  const int rows = kHeightAround + kHeightOfRow * static_cast<int>(contents.arguments.size());
  resize(within_window(*this, {scaled(kWidth), scaled(std::min(rows, kHeight))}));
}

QString XacroDialog::words(const geometric::XacroFile& contents) const {
  QString text = tr("The robot is made with these values. Those of the file are filled in.");
  if (!contents.unread.empty()) {
    text += tr(" Arguments may be missing: %1 was not found.")
                .arg(QString::fromStdString(contents.unread.front()));
  }
  return text;
}

geometric::XacroArguments XacroDialog::arguments() const {
  geometric::XacroArguments arguments;
  for (const auto& [argument, field] : fields_) {
    const std::string text = field->text().toStdString();
    if (text != argument.default_text.value_or("")) {
      arguments[argument.name] = text;
    }
  }
  return arguments;
}

void with_xacro_arguments(QWidget* parent, const std::filesystem::path& file,
                          const std::function<void(const geometric::XacroArguments&)>& use) {
  geometric::XacroFile contents;
  if (geometric::has_extension(file, ".xacro")) {
    try {
      contents = geometric::read_xacro_file(file);
    } catch (const geometric::InputError&) {
      contents = {};  // its reader says what is wrong
    }
  }
  if (contents.arguments.empty()) {
    use({});
    return;
  }
  auto* dialog = new XacroDialog(file, contents, parent);
  QObject::connect(dialog, &QDialog::accepted, dialog, [dialog, use] { use(dialog->arguments()); });
  dialog->open();
}

}  // namespace handway::gui
