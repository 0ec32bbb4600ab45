#pragma once

#include "model/planning/path_history.h"

#include <QModelIndex>
#include <QWidget>

#include <memory>
#include <vector>

class QLabel;
class QPushButton;
class QSortFilterProxyModel;

namespace handway::gui {

class RunTable;
class RunView;

/// The runs of the scene that is open, the latest first, to be looked at and put back.
class RunsPanel : public QWidget {
  Q_OBJECT

 public:
  /// @param history outlives the panel.
  explicit RunsPanel(PathHistory& history, QWidget* parent = nullptr);

  [[nodiscard]] QSize sizeHint() const override { return {640, 250}; }
  /// Those that began before are of another scene.
  void begin_anew();
  /// Makes a run stand out; null: none.
  void mark(const std::shared_ptr<const PlanRun>& run);
  void set_running(bool running);

 signals:
  void restore_requested(const handway::gui::PathRecord& record);
  void compare_requested();

 private:
  [[nodiscard]] QWidget* make_actions();
  void refresh();
  void show_actions();
  /// As sorted; none if it is not listed.
  [[nodiscard]] QModelIndex row_of(const std::shared_ptr<const PlanRun>& run) const;
  /// nullptr if none is chosen.
  [[nodiscard]] const PathRecord* chosen() const;
  void restore();

  PathHistory& history_;
  std::vector<PathRecord> records_;  ///< As in the table.
  std::vector<std::shared_ptr<const PlanRun>> of_other_scenes_;
  std::shared_ptr<const PlanRun> marked_;
  bool running_ = false;
  RunTable* table_;
  QSortFilterProxyModel* sorted_;
  RunView* view_;
  QLabel* state_;
  QPushButton* restore_;
  QPushButton* compare_;
};

}  // namespace handway::gui
