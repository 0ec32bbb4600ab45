#pragma once

#include "handway/geometric/scene/program.h"

#include <QString>
#include <QStringList>
#include <QWidget>

#include <vector>

class QComboBox;
class QLabel;
class QToolButton;
class QTreeWidget;

namespace handway::gui {

class QuantityField;

/// Returns the words for a step: "pick can", "place on table", "move to start".
[[nodiscard]] QString words_of(const geometric::ProgramStep& step);

/// Returns the words for all steps of a program: "pick can, place on table, move to start".
[[nodiscard]] QString words_of(const geometric::Program& program);
/// Returns the name of a program; "Program" for one without a name.
[[nodiscard]] QString title_of(const geometric::Program& program);

/// Names in the scene that steps refer to.
struct StepNames {
  QStringList objects;   ///< Objects to pick.
  QStringList supports;  ///< Objects and frames to place something on.
  QStringList postures;  ///< Postures to move to, "start" first.
};

/// Shows the steps of a program in a list, and the values of the step that is selected. Users add,
/// change, move, duplicate and remove steps.
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
  /// Shows the values of the selected step.
  void show_values();
  /// Offers names for the selected step, and what it has now.
  void offer(const QStringList& names, const QString& chosen);
  /// Takes the values of the fields for the selected step.
  void change_values();
  /// Adds a step after the selected one. @param what was done, for the list of edits.
  void add(const geometric::ProgramStep& step, const QString& what);
  void duplicate();
  void remove();
  /// Moves the selected step by one place. @param by -1: up, 1: down.
  void move(int by);
  /// Lists changed steps, and emits them. @param selected row.
  void take(std::vector<geometric::ProgramStep> steps, int selected, const QString& what);
  void list_steps(int selected);

  QTreeWidget* list_;
  QToolButton* add_;
  QToolButton* up_;
  QToolButton* down_;
  QToolButton* duplicate_;
  QToolButton* remove_;
  QLabel* name_label_;
  QComboBox* name_;  ///< The object, the support or the posture of the step.
  QWidget* lengths_;
  QLabel* first_label_;
  QuantityField* first_;  ///< Length of the straight motion at the begin of the step.
  QLabel* second_label_;
  QuantityField* second_;  ///< Length of the straight motion at its end.
  std::vector<geometric::ProgramStep> steps_;
  StepNames names_;
};

}  // namespace handway::gui
