#pragma once

#include "handway/planning/core/plan_result.h"
#include "widgets/panels/floating_card.h"

#include <string>
#include <vector>

class QGridLayout;
class QLabel;

namespace handway::gui {

/// Floats in a corner of the view: which ghost is where a search without a path came to from the
/// start and from the goal, and what collided most.
class FrontierLegend : public FloatingCard {
  Q_OBJECT

 public:
  explicit FrontierLegend(QWidget* host);

  /// @param colliding the bodies that collided most; may be empty.
  void show_frontier(const planning::SearchReach& reach, const std::vector<std::string>& colliding);

 signals:
  /// Show the robot at one of the two.
  void visited(bool from_start);
  void closed();

 private:
  void place() override;
  QLabel* add_row(QGridLayout& rows, const char* name, bool from_start);

  QLabel* from_start_;
  QLabel* from_goal_;
  QLabel* colliding_;
};

}  // namespace handway::gui
