#include "features/tasks/program_editor.h"

#include "handway/geometric/formats/program_steps.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

namespace handway::gui {
namespace {

using geometric::PickStep;
using geometric::PlaceStep;
using geometric::PostureStep;
using geometric::ProgramStep;

constexpr int kMostRows = 6;

// Words for a place step that names more than one support.
QString place_words(const PlaceStep& place) {
  const QString words = words_of(place);
  return place.pose ? QObject::tr("%1, at a pose").arg(words) : words;
}

bool is_plain(const PlaceStep& place) { return place.supports.size() == 1 && !place.pose; }

QToolButton* make_button(const char* name, const char* icon_name, const QString& tip) {
  auto* button = named(name, new QToolButton);
  button->setAutoRaise(true);
  button->setIcon(icon(QLatin1String(icon_name)));
  button->setIconSize({scaled(18), scaled(18)});
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  return button;
}

}  // namespace

QString words_of(const ProgramStep& step) {
  return QString::fromStdString(geometric::to_string(step));
}

QString words_of(const geometric::Program& program) {
  QStringList steps;
  for (const ProgramStep& step : program.steps) {
    steps << words_of(step);
  }
  return steps.join(QStringLiteral(", "));
}

QString title_of(const geometric::Program& program) {
  return program.name.empty() ? QObject::tr("Program") : QString::fromStdString(program.name);
}

ProgramEditor::ProgramEditor(QWidget* parent)
    : QWidget(parent),
      list_(named("program_steps", new QTreeWidget)),
      add_(make_button("program_add", "add", tr("Add a step after the selected one"))),
      up_(make_button("program_up", "up", tr("Move the step up"))),
      down_(make_button("program_down", "down", tr("Move the step down"))),
      duplicate_(make_button("program_duplicate", "duplicate", tr("Duplicate the step"))),
      remove_(make_button("program_remove", "delete", tr("Remove the step"))),
      name_label_(new QLabel),
      name_(named("program_name", new QComboBox)),
      lengths_(new QWidget),
      first_label_(new QLabel),
      first_(named("program_first_length", new QuantityField(QuantityField::Kind::kLength, 0.0,
                                                             geometric::kLongestStraightMotion))),
      second_label_(new QLabel),
      second_(
          named("program_second_length", new QuantityField(QuantityField::Kind::kLength, 0.0,
                                                           geometric::kLongestStraightMotion))) {
  list_->setAccessibleName(tr("Steps"));
  list_->setFrameShape(QFrame::NoFrame);
  list_->setHeaderHidden(true);
  list_->setColumnCount(2);
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->header()->setStretchLastSection(true);
  list_->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  auto* kinds = new QMenu(this);
  const auto offer_step = [&](const QString& text, const auto& make) {
    connect(kinds->addAction(text), &QAction::triggered, this,
            [this, make] { add(make(), tr("Add step")); });
  };
  const auto object = [this](int index) {
    return names_.objects.value(index, names_.objects.value(0)).toStdString();
  };
  offer_step(tr("Pick an object"), [object] { return PickStep{object(0)}; });
  offer_step(tr("Place the object"), [object] { return PlaceStep{{object(1)}}; });
  offer_step(tr("Move to a posture"), [] { return PostureStep{"start"}; });
  add_->setMenu(kinds);
  add_->setPopupMode(QToolButton::InstantPopup);
  first_->setToolTip(tr("Length of the straight motion; less where that is blocked"));
  second_->setToolTip(first_->toolTip());
  connect(list_, &QTreeWidget::currentItemChanged, this, &ProgramEditor::show_values);
  connect(up_, &QToolButton::clicked, this, [this] { move(-1); });
  connect(down_, &QToolButton::clicked, this, [this] { move(1); });
  connect(duplicate_, &QToolButton::clicked, this, &ProgramEditor::duplicate);
  connect(remove_, &QToolButton::clicked, this, &ProgramEditor::remove);
  connect(name_, qOverload<int>(&QComboBox::activated), this, &ProgramEditor::change_values);
  connect(first_, &QuantityField::quantity_edited, this, &ProgramEditor::change_values);
  connect(second_, &QuantityField::quantity_edited, this, &ProgramEditor::change_values);
  lay_out(*lengths_, in_row({first_label_, {first_, 1}, second_label_, {second_, 1}}, 8));
  lay_out(*this, in_column({list_, in_row({add_, up_, down_, duplicate_, remove_, room(1)}, 2),
                            in_row({name_label_, {name_, 1}}, 8), lengths_},
                           4));
}

void ProgramEditor::show_steps(std::vector<ProgramStep> steps, const StepNames& names) {
  const int selected = row();
  steps_ = std::move(steps);
  names_ = names;
  list_steps(selected);
}

void ProgramEditor::list_steps(int selected) {
  {
    const QSignalBlocker quiet(list_);
    list_->clear();
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      new QTreeWidgetItem(list_, {QString::number(i + 1), words_of(steps_[i])});
    }
    const int last = static_cast<int>(steps_.size()) - 1;
    list_->setCurrentItem(list_->topLevelItem(std::clamp(selected, 0, std::max(0, last))));
  }
  const int rows = std::min(kMostRows, list_->topLevelItemCount());
  list_->setFixedHeight(rows * list_->sizeHintForRow(0) + 2);
  show_values();
}

int ProgramEditor::row() const { return list_->indexOfTopLevelItem(list_->currentItem()); }

void ProgramEditor::show_values() {
  const int selected = row();
  const auto count = static_cast<int>(steps_.size());
  up_->setEnabled(selected > 0);
  down_->setEnabled(selected >= 0 && selected + 1 < count);
  duplicate_->setEnabled(selected >= 0);
  remove_->setEnabled(selected >= 0 && count > 1);
  name_->setEnabled(selected >= 0);
  if (selected < 0) {
    return;
  }
  const ProgramStep& step = steps_[static_cast<std::size_t>(selected)];
  lengths_->setVisible(std::holds_alternative<PickStep>(step) ||
                       std::holds_alternative<PlaceStep>(step));
  name_->setToolTip(QString());
  if (const auto* pick = std::get_if<PickStep>(&step)) {
    name_label_->setText(tr("Object"));
    offer(names_.objects, QString::fromStdString(pick->object));
    first_label_->setText(tr("Approach"));
    first_->show_quantity(pick->approach);
    second_label_->setText(tr("Lift"));
    second_->show_quantity(pick->lift);
  } else if (const auto* place = std::get_if<PlaceStep>(&step)) {
    name_label_->setText(tr("Place on"));
    offer(names_.objects,
          is_plain(*place) ? QString::fromStdString(place->supports.front()) : place_words(*place));
    first_label_->setText(tr("Lower"));
    first_->show_quantity(place->lower);
    second_label_->setText(tr("Retreat"));
    second_->show_quantity(place->retreat);
  } else if (const auto* move = std::get_if<PostureStep>(&step)) {
    name_label_->setText(tr("Posture"));
    offer(names_.postures, QString::fromStdString(move->posture));
  } else {
    name_label_->setText(tr("Step"));
    offer({}, words_of(step));
    name_->setToolTip(tr("The values of this step are changed in the scene's file"));
  }
  name_->setAccessibleName(name_label_->text());
  first_->setAccessibleName(first_label_->text());
  second_->setAccessibleName(second_label_->text());
}

void ProgramEditor::offer(const QStringList& names, const QString& chosen) {
  const QSignalBlocker quiet(name_);
  name_->clear();
  name_->addItems(names);
  if (name_->findText(chosen) < 0) {
    name_->insertItem(0, chosen);
  }
  name_->setCurrentText(chosen);
}

void ProgramEditor::change_values() {
  std::vector<ProgramStep> steps = steps_;
  ProgramStep& step = steps[static_cast<std::size_t>(row())];
  const std::string name = name_->currentText().toStdString();
  if (auto* pick = std::get_if<PickStep>(&step)) {
    *pick = {name, first_->quantity(), second_->quantity()};
  } else if (auto* place = std::get_if<PlaceStep>(&step)) {
    if (names_.supports.contains(name_->currentText())) {
      place->supports = {name};
      place->pose.reset();
    }
    place->lower = first_->quantity();
    place->retreat = second_->quantity();
  } else if (std::holds_alternative<PostureStep>(step)) {
    step = PostureStep{name};
  }
  take(std::move(steps), row(), tr("Change step"));
}

void ProgramEditor::add(const ProgramStep& step, const QString& what) {
  std::vector<ProgramStep> steps = steps_;
  steps.insert(steps.begin() + row() + 1, step);
  take(std::move(steps), row() + 1, what);
}

void ProgramEditor::duplicate() {
  add(steps_[static_cast<std::size_t>(row())], tr("Duplicate step"));
}

void ProgramEditor::remove() {
  std::vector<ProgramStep> steps = steps_;
  steps.erase(steps.begin() + row());
  take(std::move(steps), row(), tr("Remove step"));
}

void ProgramEditor::move(int by) {
  std::vector<ProgramStep> steps = steps_;
  const int selected = row();
  const int other = selected + by;
  std::swap(steps[static_cast<std::size_t>(selected)], steps[static_cast<std::size_t>(other)]);
  take(std::move(steps), other, tr("Move step"));
}

void ProgramEditor::take(std::vector<ProgramStep> steps, int selected, const QString& what) {
  steps_ = std::move(steps);
  list_steps(selected);
  emit edited(steps_, what);
}

}  // namespace handway::gui
