#pragma once

#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "widgets/panels/floating_card.h"

#include <QPoint>
#include <QString>

#include <functional>
#include <vector>

class QLabel;
class QProgressBar;
class QPushButton;
class QToolButton;
class QTreeWidget;

namespace handway::gui {

class FilmBar;

/// Origin of the grasps of a list.
enum class GraspOrigin {
  kSearch,
  kFile,  ///< The scene keeps them.
  kEdit   ///< They were listed before the scene was edited.
};

/// Floats in the corner of the view where it covers least of what is grasped: ways to do so, the
/// best first, to choose from.
class GraspCard : public FloatingCard {
  Q_OBJECT

 public:
  /// @param to_be_seen places in the host that it leaves free, if it can.
  GraspCard(QWidget* host, std::function<std::vector<QPoint>()> to_be_seen);

  void show_search(const QString& object);
  /// Shows the grasps found while the search runs. @param fraction of it that is done, in [0, 1].
  void show_progress(const std::vector<planning::Pregrasp>& grasps, double fraction);
  /// Shows the grasps once all are known. @param note says which grasps these are.
  void show_grasps(const std::vector<planning::Pregrasp>& grasps, const QString& note,
                   GraspOrigin origin);
  /// Lists the same grasps in another order.
  void show_ranked(const std::vector<planning::Pregrasp>& grasps);
  /// @param origin where no grasp came from.
  void show_failure(const QString& object, const QString& reason, GraspOrigin origin);
  /// Shows or hides the column for simulated grasps, which is empty until their results come.
  void show_tests(bool possible);
  /// Shows the grasps without tests. @param reason why they can't be simulated.
  void show_untested(const QString& reason);
  /// Shows how a row's grasp held in simulation.
  void show_hold(int index, const planning::HoldResult& result);
  /// Shows in words what is simulated at the moment; empty: the film is over.
  void show_film(const QString& what);
  [[nodiscard]] int row() const;
  [[nodiscard]] FilmBar& film() { return *film_bar_; }

 signals:
  /// The row that is looked at.
  void looked_at(int index);
  /// Plan to this one.
  void chosen(int index);
  void closed();
  /// Search no longer, and keep what was found.
  void stop_requested();
  /// Search instead of showing what the scene keeps.
  void search_requested();
  /// Save all of them for the object.
  void keep_requested();
  /// Show the simulation of this one, or no longer.
  void film_wanted(int index, bool wanted);

 private:
  /// Enables the film of the row that is looked at, once it is simulated.
  void update_film();
  /// Parts that are shown besides title and note.
  struct Parts {
    bool list = false;
    bool progress = false;  ///< The progress of a search.
    bool others = false;    ///< The button that searches for others.
    bool keep = false;      ///< The button that keeps the grasps.
  };
  void set_up(const QString& note, const Parts& parts);
  /// Lists them, the row that is looked at staying the same grasp.
  void list(const std::vector<planning::Pregrasp>& grasps);
  void place() override;

  std::function<std::vector<QPoint>()> to_be_seen_;
  QLabel* title_;
  QWidget* details_;  ///< All that is hidden when it is folded.
  QToolButton* fold_;
  QLabel* note_;
  QTreeWidget* list_;
  QWidget* search_;  ///< Progress and button to end the search.
  QProgressBar* progress_;
  QPushButton* film_;
  FilmBar* film_bar_;
  QPushButton* search_others_;
  QPushButton* keep_;
  QPushButton* plan_;
  Parts parts_;
  QString note_before_film_;
  std::vector<planning::Pregrasp> listed_;
  bool is_chosen_ = false;  ///< A person has chosen the row.
};

}  // namespace handway::gui
