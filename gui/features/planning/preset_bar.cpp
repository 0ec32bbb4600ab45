#include "features/planning/preset_bar.h"

#include "handway/geometric/io/input_error.h"
#include "widgets/forms/arrangement.h"

#include <QAction>
#include <QComboBox>
#include <QInputDialog>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>

#include <algorithm>

namespace handway::gui {

PresetBar::PresetBar(const planning::PlannerRegistry& registry, QWidget* parent)
    : QWidget(parent),
      registry_(registry),
      list_(named("presets", new QComboBox)),
      more_(named("preset_menu", new QToolButton)),
      rename_(nullptr),
      remove_(nullptr) {
  list_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  more_->setText(QStringLiteral("⋯"));
  more_->setToolTip(tr("Save these values as a preset of your own"));
  more_->setProperty("role", "more");
  more_->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(more_);
  menu->addAction(tr("Save as preset…"), this, &PresetBar::ask_to_save);
  menu->addSeparator();
  rename_ = menu->addAction(tr("Rename…"), this, &PresetBar::ask_for_other_name);
  remove_ = menu->addAction(tr("Delete"), this, [this] {
    attempt(tr("The preset was not deleted"), [this] { remove(); });
  });
  more_->setMenu(menu);
  lay_out(*this, in_row({{list_, 1}, more_}, 6));
  connect(list_, qOverload<int>(&QComboBox::activated), this,
          [this](int row) { apply(list_->itemData(row).toString()); });
}

void PresetBar::show_planner(planning::Planner& planner, bool reset) {
  const bool other_kind = !fresh_ || fresh_->name() != planner.name();
  const QString before = presets_.empty() ? QString() : chosen().name;
  planner_ = &planner;
  if (other_kind) {
    fresh_ = registry_.create(planner.name());
  }
  fill();
  const auto fitting = std::ranges::find_if(presets_, [&](const PlannerPreset& preset) {
    return has_values_of(preset, *fresh_, planner);
  });
  if (fitting != presets_.end()) {
    choose(fitting->name);
  } else {
    choose(reset || other_kind ? presets_.front().name : before);
  }
}

void PresetBar::fill() {
  presets_ = store_.of(planner_->name());
  chosen_ = 0;
  const QSignalBlocker quiet(list_);
  list_->clear();
  bool own_follow = false;
  for (const PlannerPreset& preset : presets_) {
    if (!preset.is_built_in && !own_follow) {
      list_->insertSeparator(list_->count());
      own_follow = true;
    }
    list_->addItem(preset.name, preset.name);
    list_->setItemData(list_->count() - 1, preset.purpose, Qt::ToolTipRole);
  }
}

const PlannerPreset& PresetBar::chosen() const { return presets_[chosen_]; }

void PresetBar::choose(const QString& name) {
  const auto found = std::ranges::find(presets_, name, &PlannerPreset::name);
  chosen_ = found == presets_.end() ? 0 : static_cast<std::size_t>(found - presets_.begin());
  const QSignalBlocker quiet(list_);
  list_->setCurrentIndex(list_->findData(chosen().name));
  list_->setToolTip(chosen().purpose.isEmpty() ? tr("A preset of your own") : chosen().purpose);
  rename_->setEnabled(!chosen().is_built_in);
  remove_->setEnabled(!chosen().is_built_in);
  look_again();
}

void PresetBar::look_again() {
  if (!planner_) {
    return;
  }
  modified_ = !has_values_of(chosen(), *fresh_, *planner_);
  emit changed();
}

std::vector<std::string> PresetBar::modified_keys() const {
  std::vector<std::string> keys;
  if (!modified_) {
    return keys;
  }
  const std::unique_ptr<planning::Planner> as_chosen = registry_.create(planner_->name());
  try {
    apply_preset(chosen(), *fresh_, *as_chosen);
  } catch (const geometric::InputError&) {
    return keys;
  }
  const std::vector<geometric::Parameter> wanted = as_chosen->parameters();
  for (const geometric::Parameter& parameter : planner_->parameters()) {
    if (geometric::to_text(parameter) !=
        geometric::to_text(geometric::find_parameter(wanted, parameter.key))) {
      keys.push_back(parameter.key);
    }
  }
  return keys;
}

QString PresetBar::words() const {
  if (presets_.empty()) {
    return {};
  }
  return modified_ ? tr("%1, modified").arg(chosen().name) : chosen().name;
}

void PresetBar::apply(const QString& name) {
  const auto found = std::ranges::find(presets_, name, &PlannerPreset::name);
  if (found == presets_.end()) {
    return;
  }
  try {
    apply_preset(*found, *fresh_, *planner_);
  } catch (const geometric::InputError& error) {
    choose(chosen().name);
    emit failed(tr("The preset %1 does not fit the planner").arg(name),
                QString::fromUtf8(error.what()));
    return;
  }
  choose(name);
  emit applied();
}

void PresetBar::restore() { apply(chosen().name); }

void PresetBar::save_as(const QString& name) {
  PlannerPreset preset;
  preset.name = name.trimmed();
  const std::vector<geometric::Parameter> own = fresh_->parameters();
  for (const geometric::Parameter& parameter : planner_->parameters()) {
    std::string value = geometric::to_text(parameter);
    if (value != geometric::to_text(geometric::find_parameter(own, parameter.key))) {
      preset.settings.emplace_back(parameter.key, std::move(value));
    }
  }
  store_.save(planner_->name(), preset);
  fill();
  choose(preset.name);
}

void PresetBar::rename(const QString& name) {
  store_.rename(planner_->name(), chosen().name, name.trimmed());
  fill();
  choose(name.trimmed());
}

void PresetBar::remove() {
  store_.remove(planner_->name(), chosen().name);
  show_planner(*planner_, true);
}

void PresetBar::attempt(const QString& title, const std::function<void()>& what) {
  try {
    what();
  } catch (const std::exception& error) {
    emit failed(title, QString::fromUtf8(error.what()));
  }
}

void PresetBar::ask_to_save() {
  bool wanted = false;
  const QString suggestion = chosen().is_built_in ? QString() : chosen().name;
  const QString name = QInputDialog::getText(
      this, tr("Save as preset"),
      tr("Name of the preset of %1:").arg(QString::fromStdString(planner_->name())),
      QLineEdit::Normal, suggestion, &wanted);
  if (wanted) {
    attempt(tr("The preset was not saved"), [&] { save_as(name); });
  }
}

void PresetBar::ask_for_other_name() {
  bool wanted = false;
  const QString name =
      QInputDialog::getText(this, tr("Rename the preset"), tr("New name of %1:").arg(chosen().name),
                            QLineEdit::Normal, chosen().name, &wanted);
  if (wanted) {
    attempt(tr("The preset was not renamed"), [&] { rename(name); });
  }
}

}  // namespace handway::gui
