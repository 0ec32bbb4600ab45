#pragma once

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

  /// Asks for what a task needs. @param program words for the steps of a program of the scene;
  /// empty: an object is picked and placed. @param supports objects that it can be placed on, the
  /// proposed one first. @param simulates whether plans can be simulated.
  void ask(const QString& title, const QString& program, const QStringList& supports,
           bool simulates);
  /// Shows other steps, and keeps the plan.
  void show_steps(const QString& title, const QString& program);
  /// Asks again, without a plan.
  void ask_again();
  void show_planning();
  void show_plan(const std::vector<ShownStage>& stages, double planned_in);
  /// Shows why there is no plan. @param trials counts of the candidates; may be empty.
  void show_failure(const QString& reason, const std::vector<planning::StageTrials>& trials);
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
  QWidget* choices_;  ///< Choices of picking and placing.
  QString program_;   ///< Words for the steps of a program; empty: pick and place.
  bool simulates_ = false;
};

}  // namespace handway::gui
