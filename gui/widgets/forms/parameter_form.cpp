#include "widgets/forms/parameter_form.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QLocale>
#include <QSpinBox>
#include <QStringList>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace handway::gui {

NumberField::NumberField(double lower, double upper, QWidget* parent) : QDoubleSpinBox(parent) {
  setDecimals(9);
  setRange(lower, upper);
  setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  setKeyboardTracking(false);
}

QString NumberField::textFromValue(double value) const { return locale().toString(value, 'g', 6); }

namespace {

using geometric::Choice;
using geometric::Parameter;

QString help_of(const Parameter& parameter) {
  QStringList help{QString::fromStdString(parameter.help)};
  if (std::holds_alternative<int>(parameter.value) ||
      std::holds_alternative<double>(parameter.value)) {
    help << QObject::tr("From %1 to %2 %3")
                .arg(parameter.lower)
                .arg(parameter.upper)
                .arg(QString::fromStdString(parameter.unit))
                .trimmed();
  }
  help << QString::fromStdString(parameter.key);
  help.removeAll({});
  return help.join(QLatin1Char('\n'));
}

}  // namespace

// Each widget is made inside of its parent: one that moves into a parent is styled once more.
ParameterForm::ParameterForm(const std::vector<Parameter>& parameters, QWidget* parent)
    : QWidget(parent), layout_(new QFormLayout(this)) {
  layout_->setContentsMargins(0, 0, 0, 0);
  layout_->setHorizontalSpacing(10);
  layout_->setVerticalSpacing(6);
  layout_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  layout_->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  for (const Parameter& parameter : parameters) {
    QWidget* field = make_field(parameter);
    field->setObjectName(QString::fromStdString(parameter.key));
    field->setToolTip(help_of(parameter));
    const QString label = QString::fromStdString(parameter.label);
    if (auto* box = qobject_cast<QCheckBox*>(field)) {
      box->setText(label);
      layout_->addRow(box);
      names_.emplace_back(parameter.key, box);
    } else {
      auto* name = new QLabel(label, this);
      name->setToolTip(help_of(parameter));
      name->setBuddy(field);
      layout_->addRow(name, field);
      names_.emplace_back(parameter.key, name);
      if (parameter.key.starts_with("weight_")) {
        weights_row_ = weights_.empty() ? layout_->rowCount() - 1 : weights_row_;
        weights_.emplace_back(name, field);
      }
    }
  }
  show_weights();
  connect(this, &ParameterForm::edited, this, &ParameterForm::show_weights);
}

// A row whose widgets are hidden would leave a gap.
void ParameterForm::show_weights() {
  const auto* objective = findChild<QComboBox*>(QStringLiteral("objective"));
  const bool wanted = !objective || objective->currentText() == QStringLiteral("custom");
  if (wanted == has_weights_) {
    return;
  }
  has_weights_ = wanted;
  int row = weights_row_;
  for (const auto& [name, field] : weights_) {
    if (wanted) {
      layout_->insertRow(row++, name, field);
    } else {
      const QFormLayout::TakeRowResult taken = layout_->takeRow(field);
      delete taken.labelItem;
      delete taken.fieldItem;
    }
    name->setVisible(wanted);
    field->setVisible(wanted);
  }
}

void ParameterForm::set_enabled(const std::string& key, bool enabled) {
  findChild<QWidget*>(QString::fromStdString(key))->setEnabled(enabled);
  std::ranges::find(names_, key, &std::pair<std::string, QWidget*>::first)
      ->second->setEnabled(enabled);
}

void ParameterForm::mark(const std::vector<std::string>& keys) {
  for (const auto& [key, name] : names_) {
    QFont font = name->font();
    font.setBold(std::ranges::count(keys, key) > 0);
    name->setFont(font);
  }
}

QWidget* ParameterForm::make_field(const Parameter& parameter) {
  const auto report = [this, key = parameter.key](const std::string& value) {
    emit edited(key, value);
  };
  if (const bool* flag = std::get_if<bool>(&parameter.value)) {
    auto* box = new QCheckBox(this);
    box->setChecked(*flag);
    connect(box, &QCheckBox::toggled, this, [report](bool on) { report(on ? "true" : "false"); });
    return box;
  }
  if (const auto* choice = std::get_if<Choice>(&parameter.value)) {
    auto* list = new QComboBox(this);
    for (const std::string& option : choice->options) {
      list->addItem(QString::fromStdString(option));
    }
    list->setCurrentIndex(choice->index);
    connect(list, &QComboBox::currentTextChanged, this,
            [report](const QString& option) { report(option.toStdString()); });
    return list;
  }
  const QString suffix = parameter.unit.empty()
                             ? QString()
                             : QStringLiteral(" ") + QString::fromStdString(parameter.unit);
  if (const int* number = std::get_if<int>(&parameter.value)) {
    auto* field = new QSpinBox(this);
    constexpr double kMost = std::numeric_limits<int>::max();
    field->setRange(static_cast<int>(std::max(parameter.lower, -kMost)),
                    static_cast<int>(std::min(parameter.upper, kMost)));
    field->setGroupSeparatorShown(true);
    field->setSuffix(suffix);
    field->setValue(*number);
    connect(field, qOverload<int>(&QSpinBox::valueChanged), this,
            [report](int entered) { report(std::to_string(entered)); });
    return field;
  }
  auto* field = new NumberField(parameter.lower, parameter.upper, this);
  field->setSuffix(suffix);
  field->setValue(std::get<double>(parameter.value));
  connect(field, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [report](double entered) { report(fmt::format("{}", entered)); });
  return field;
}

}  // namespace handway::gui
