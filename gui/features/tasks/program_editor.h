#pragma once

#include "features/tasks/step_fields.h"
#include "handway/geometric/scene/program.h"

#include <QString>
#include <QWidget>

#include <vector>

class QToolButton;

namespace handway::gui {

class StepList;

/// Returns the words for the steps of a program that are not disabled: "pick can, place on table,
/// move to start".
[[nodiscard]] QString words_of(const geometric::Program& program);
/// Returns the name of a program; "Program" for one without a name.
[[nodiscard]] QString title_of(const geometric::Program& program);

/// Shows the steps of a program in a list, and the values of the step that is selected. Users add,
/// change, move, duplicate, disable and remove steps.
class ProgramEditor : public QWidget {
  Q_OBJECT

 public:
  explicit ProgramEditor(QWidget* parent = nullptr);

  /// Shows the steps of a program. The selected row stays.
  void show_steps(std::vector<geometric::ProgramStep> steps, const StepNames& names);

 signals:
  /// A user has changed the steps. @param what was done, for the list of edits.
  void edited(const std::vector<handway::geometric::ProgramStep>& steps, const QString& what);

 private:
  [[nodiscard]] int row() const;
  /// Fills the menu of steps to add.
  void offer_steps();
  /// Shows the values of the selected step.
  void show_values();
  /// Adds a step after the selected one. @param what was done, for the list of edits.
  void add(const geometric::ProgramStep& step, const QString& what);
  void duplicate();
  /// Disables the selected step, or enables it.
  void disable(bool disabled);
  void remove();
  /// Moves a step to another row.
  void move(int from, int to);
  /// Lists changed steps, and emits them. @param selected row.
  void take(std::vector<geometric::ProgramStep> steps, int selected, const QString& what);
  void list_steps(int selected);

  StepList* list_;
  QToolButton* add_;
  QToolButton* up_;
  QToolButton* down_;
  QToolButton* duplicate_;
  QToolButton* disable_;
  QToolButton* remove_;
  StepFields* fields_;
  std::vector<geometric::ProgramStep> steps_;
  StepNames names_;
};

}  // namespace handway::gui
