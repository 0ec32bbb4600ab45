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
class QTreeWidget;

namespace handway::gui {

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

  /// Asks where to place an object. @param supports objects that it can be placed on.
  /// @param proposed index of one of them.
  void ask(const QString& object, const QStringList& supports, int proposed);
  void show_planning();
  void show_plan(const std::vector<ShownStage>& stages, double planned_in);
  /// Shows why there is no plan. @param trials counts of the candidates; may be empty.
  void show_failure(const QString& reason, const std::vector<planning::StageTrials>& trials);
  /// Shows the stage that is played; a negative one: none is.
  void show_played(int stage);

  [[nodiscard]] QString support() const;
  [[nodiscard]] bool returns() const;

 signals:
  void plan_wanted();
  void stop_wanted();
  /// Play the plan, or no longer.
  void play_wanted(bool wanted);
  void export_wanted();
  void closed();

 private:
  void set_up(const QString& note, bool planning, bool with_list, bool playable);
  void place() override;

  std::function<std::vector<QPoint>()> to_be_seen_;
  QLabel* title_;
  QComboBox* support_;
  QCheckBox* return_;
  QLabel* note_;
  QTreeWidget* list_;
  QWidget* search_;  ///< Progress, and the button that ends the search.
  QPushButton* play_;
  QPushButton* export_;
  QPushButton* plan_;
};

}  // namespace handway::gui
