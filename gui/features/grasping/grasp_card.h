#pragma once

#include "handway/planning/grasps/pregrasp_search.h"
#include "widgets/panels/floating_card.h"

#include <vector>

class QLabel;
class QPushButton;
class QTreeWidget;

namespace handway::gui {

/// Floats in a corner of the view: ways to grasp an object, the best first, to choose from.
class GraspCard : public FloatingCard {
  Q_OBJECT

 public:
  explicit GraspCard(QWidget* host);

  void show_search(const QString& object);
  void show_grasps(const QString& object, const std::vector<planning::Pregrasp>& grasps);
  void show_failure(const QString& object, const QString& reason);

 signals:
  /// The row that is looked at.
  void looked_at(int index);
  /// Plan to this one.
  void chosen(int index);
  void closed();

 private:
  void set_up(const QString& title, const QString& note, bool with_list);
  void place() override;

  QLabel* title_;
  QLabel* note_;
  QTreeWidget* list_;
  QPushButton* plan_;
};

}  // namespace handway::gui
