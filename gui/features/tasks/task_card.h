#pragma once

#include "features/tasks/program_editor.h"
#include "handway/geometric/scene/program.h"
#include "handway/planning/tasks/task.h"
#include "widgets/panels/floating_card.h"

#include <QPoint>
#include <QString>
#include <QStringList>

#include <functional>
#include <vector>

class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTreeWidget;

namespace handway::gui {

class FilmBar;
class NumberField;

/// A stage of a planned task, as the card shows it.
struct ShownStage {
  planning::StageKind kind = planning::StageKind::kMove;
  double duration = 0.0;   ///< s
  double clearance = 0.0;  ///< The least one, m.
  QString nearest;         ///< The pair that is nearest.
};

/// Floats over the view: where the selected object is to be placed, and the stages of the plan.
class TaskCard : public FloatingCard {
  Q_OBJECT

 public:
  /// @param to_be_seen places in the host that it leaves free, if it can.
  TaskCard(QWidget* host, std::function<std::vector<QPoint>()> to_be_seen);

  /// Asks how to pick an object and to place it. @param supports objects that it can be placed on,
  /// the proposed one first. @param simulates whether plans can be simulated.
  void ask(const QString& title, const QStringList& supports, bool simulates);
  /// Offers to plan a program of the scene, and to edit it. @param names that its steps can have.
  void ask_program(const geometric::Program& program, const StepNames& names, bool simulates);
  /// Shows other supports in an edited scene.
  /// @returns false if the chosen one is not among them: another one is chosen then.
  bool update_supports(const QStringList& supports);
  /// Shows the steps of a program, and keeps the plan.
  void show_program(const geometric::Program& program, const StepNames& names);
  /// Shows the editor of the program.
  void edit_steps();
  /// Asks again, without a plan.
  void ask_again();
  /// @param again the scene was edited, and the task is planned again.
  void show_planning(bool again);
  void show_plan(const std::vector<ShownStage>& stages, double planned_in);
  /// Shows why there is no plan. @param trials counts of the candidates; may be empty.
  void show_failure(const QString& reason, const std::vector<planning::StageTrials>& trials);
  /// Shows the reason for which the first candidate of a stage failed.
  void show_trial(const planning::StageTrials& trial);
  /// Shows the reason of show_failure() again.
  void show_reason();
  void show_simulating();
  /// Shows the result of a simulation below the plan's stages.
  void show_simulated(const QString& verdict);
  /// Shows the stage that is played; a negative one: none is.
  void show_played(int stage);

  [[nodiscard]] QString support() const;
  [[nodiscard]] bool returns() const;
  /// Returns the object's mass, kg.
  [[nodiscard]] double mass() const;
  /// Returns the share of the full speed, in (0, 1].
  [[nodiscard]] double speed() const;
  [[nodiscard]] FilmBar& film() { return *film_; }

 signals:
  void plan_wanted();
  /// A choice in the card was changed: the plan is of another one.
  void changed();
  /// A user has clicked a row: a stage of the plan, or of show_failure().
  void row_chosen(int row);
  /// The steps of the program were edited. @param what was done, for the list of edits.
  void steps_edited(const std::vector<handway::geometric::ProgramStep>& steps, const QString& what);
  void simulation_wanted();
  void stop_wanted();
  /// Play the plan, or no longer.
  void play_wanted(bool wanted);
  void export_wanted();
  void run_wanted();
  /// The steps are to be kept in the scene, or the program is to be removed from it.
  void keep_wanted();
  void closed();

 private:
  enum class State { kAsking, kWorking, kPlanned, kFailed };
  void set_up(const QString& note, State state);
  void place() override;
  /// Makes room when the editor shows other fields.
  bool event(QEvent* event) override;
  /// Height of the card for its present content, px.
  [[nodiscard]] int wanted_height(int width) const;

  /// Shows the choices for picking and placing, or the editor of a program.
  void show_kind(const QString& title, bool is_program);

  std::function<std::vector<QPoint>()> to_be_seen_;
  QLabel* title_;
  QComboBox* support_;
  NumberField* mass_;
  QSpinBox* speed_;
  QCheckBox* return_;
  QLabel* note_;
  QTreeWidget* list_;
  QWidget* search_;  ///< Progress, and the button that ends the search.
  QPushButton* play_;
  QPushButton* simulate_;
  QPushButton* export_;
  QPushButton* run_;
  FilmBar* film_;
  QPushButton* keep_;
  QPushButton* plan_;
  QPushButton* edit_;  ///< Shows the editor, or hides it.
  ProgramEditor* editor_;
  QWidget* choices_;  ///< Choices of picking and placing.
  QString program_;   ///< Words for the steps of a program; empty: pick and place.
  QString reason_;    ///< Why there is no plan.
  bool simulates_ = false;
};

}  // namespace handway::gui
