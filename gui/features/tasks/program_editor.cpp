#include "features/tasks/program_editor.h"

#include "features/tasks/step_list.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QMenu>
#include <QToolButton>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace handway::gui {
namespace {

using geometric::ProgramStep;

/// The fields of a step, which scroll in a small view and with large text.
class FieldsArea final : public PanelArea {
 public:
  explicit FieldsArea(QWidget* fields) : PanelArea(fields) {
    setHorizontalScrollBarPolicy(Qt::ScrollBarAsNeeded);
  }

  /// Has the height of two rows, or of the fields if that is less.
  [[nodiscard]] QSize minimumSizeHint() const override {
    constexpr QSize kTwoRows(160, 64);  // px
    return {scaled(kTwoRows.width()), std::min(sizeHint().height(), scaled(kTwoRows.height()))};
  }
};

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

QString words_of(const geometric::Program& program) {
  QStringList steps;
  for (const ProgramStep& step : program.steps) {
    if (!step.disabled) {
      steps << words_of(step);
    }
  }
  return steps.isEmpty() ? QObject::tr("none, all are disabled") : steps.join(QStringLiteral(", "));
}

QString title_of(const geometric::Program& program) {
  return program.name.empty() ? QObject::tr("Program") : QString::fromStdString(program.name);
}

ProgramEditor::ProgramEditor(QWidget* parent)
    : QWidget(parent),
      list_(named("program_steps", new StepList)),
      add_(make_button("program_add", "add", tr("Add a step after the selected one"))),
      up_(make_button("program_up", "up", tr("Move the step up"))),
      down_(make_button("program_down", "down", tr("Move the step down"))),
      duplicate_(make_button("program_duplicate", "duplicate", tr("Duplicate the step"))),
      disable_(make_button("program_disable", "disable",
                           tr("Disable the step: the program is planned without it"))),
      remove_(make_button("program_remove", "delete", tr("Remove the step"))),
      fields_(new StepFields) {
  list_->setToolTip(tr("Drag a step to another place"));
  offer_steps();
  disable_->setCheckable(true);
  connect(list_, &QTreeWidget::currentItemChanged, this, &ProgramEditor::show_values);
  connect(list_, &StepList::step_dragged, this, &ProgramEditor::move);
  connect(up_, &QToolButton::clicked, this, [this] { move(row(), row() - 1); });
  connect(down_, &QToolButton::clicked, this, [this] { move(row(), row() + 1); });
  connect(duplicate_, &QToolButton::clicked, this, &ProgramEditor::duplicate);
  connect(disable_, &QToolButton::clicked, this, &ProgramEditor::disable);
  connect(remove_, &QToolButton::clicked, this, &ProgramEditor::remove);
  connect(fields_, &StepFields::edited, this, [this](const ProgramStep& step) {
    std::vector<ProgramStep> steps = steps_;
    steps[static_cast<std::size_t>(row())] = step;
    take(std::move(steps), row(), tr("Change step"));
  });
  fields_->setContentsMargins(0, 0, scaled(10), 0);  // beside the scroll bar
  auto* area = new FieldsArea(fields_);
  lay_out(*this, in_column({list_,
                            in_row({add_, up_, down_, duplicate_, disable_, remove_, room(1)}, 2),
                            {area, 1}},
                           4));
}

void ProgramEditor::offer_steps() {
  auto* kinds = new QMenu(this);
  const auto offer = [&](const QString& text, const auto& make) {
    connect(kinds->addAction(text), &QAction::triggered, this,
            [this, make] { add(make(), tr("Add step")); });
  };
  const auto object = [this](int index) {
    return names_.objects.value(index, names_.objects.value(0)).toStdString();
  };
  offer(tr("Pick an object"), [object] { return geometric::PickStep{object(0)}; });
  offer(tr("Place the object"), [object] { return geometric::PlaceStep{{object(1)}}; });
  offer(tr("Move to a posture"), [] { return geometric::PostureStep{"start"}; });
  offer(tr("Move to a pose"), [this] { return names_.pose_here; });
  offer(tr("Move straight"), [] { return geometric::LineStep{{0.0, 0.0, 0.1}}; });
  offer(tr("Wait"), [] { return geometric::WaitStep{}; });
  offer(tr("Set an output"), [] { return geometric::OutputStep{"do1"}; });
  add_->setMenu(kinds);
  add_->setPopupMode(QToolButton::InstantPopup);
}

void ProgramEditor::show_steps(std::vector<ProgramStep> steps, const StepNames& names) {
  const int selected = row();
  steps_ = std::move(steps);
  names_ = names;
  list_steps(selected);
}

void ProgramEditor::list_steps(int selected) {
  list_->show_steps(steps_, selected);
  show_values();
}

int ProgramEditor::row() const { return list_->row(); }

void ProgramEditor::show_values() {
  const int selected = row();
  const auto count = static_cast<int>(steps_.size());
  up_->setEnabled(selected > 0);
  down_->setEnabled(selected >= 0 && selected + 1 < count);
  duplicate_->setEnabled(selected >= 0);
  disable_->setEnabled(selected >= 0);
  remove_->setEnabled(selected >= 0 && count > 1);
  fields_->setEnabled(selected >= 0);
  if (selected < 0) {
    return;
  }
  const ProgramStep& step = steps_[static_cast<std::size_t>(selected)];
  disable_->setChecked(step.disabled);
  fields_->show_step(step, names_);
}

void ProgramEditor::add(const ProgramStep& step, const QString& what) {
  std::vector<ProgramStep> steps = steps_;
  steps.insert(steps.begin() + row() + 1, step);
  take(std::move(steps), row() + 1, what);
}

void ProgramEditor::duplicate() {
  add(steps_[static_cast<std::size_t>(row())], tr("Duplicate step"));
}

void ProgramEditor::disable(bool disabled) {
  std::vector<ProgramStep> steps = steps_;
  steps[static_cast<std::size_t>(row())].disabled = disabled;
  take(std::move(steps), row(), disabled ? tr("Disable step") : tr("Enable step"));
}

void ProgramEditor::remove() {
  std::vector<ProgramStep> steps = steps_;
  steps.erase(steps.begin() + row());
  take(std::move(steps), row(), tr("Remove step"));
}

void ProgramEditor::move(int from, int to) {
  const auto count = static_cast<int>(steps_.size());
  if (from < 0 || to < 0 || from >= count || to >= count) {
    return;  // the steps were edited while one was dragged
  }
  std::vector<ProgramStep> steps = steps_;
  const auto first = steps.begin() + std::min(from, to);
  const auto last = steps.begin() + std::max(from, to) + 1;
  std::rotate(first, from < to ? first + 1 : last - 1, last);
  take(std::move(steps), to, tr("Move step"));
}

void ProgramEditor::take(std::vector<ProgramStep> steps, int selected, const QString& what) {
  steps_ = std::move(steps);
  list_steps(selected);
  emit edited(steps_, what);
}

}  // namespace handway::gui
