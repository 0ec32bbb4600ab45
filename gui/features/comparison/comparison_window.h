#pragma once

#include "model/document/prepared_problem.h"
#include "model/jobs/latest_job.h"
#include "model/planning/path_history.h"
#include "model/playback/path_player.h"

#include <QDialog>

#include <array>
#include <memory>
#include <optional>

class QComboBox;
class QLabel;

namespace handway::gui {

class FigureTable;
class LockedViews;
class PlaybackBar;

/// Two paths side by side (the paper's Fig. 14): views that look from the same place, one
/// playback for both, and their figures below.
class ComparisonWindow : public QDialog {
  Q_OBJECT

 public:
  /// What paths of files are of.
  struct Query {
    std::shared_ptr<const PreparedProblem> problem;  ///< Null: there can be none.
    std::shared_ptr<const geometric::Scene> scene;
    int palm = 0;
    std::shared_ptr<const sampling::RecordedPostures> postures;  ///< May be null.
  };

  /// Begins with the last two paths of the history, or with one alone. @param history outlives it.
  ComparisonWindow(PathHistory& history, Query query, QWidget* parent = nullptr);

  /// Shows the record of that place in the history on side 0 or 1.
  void choose(std::size_t side, std::size_t index);
  [[nodiscard]] PathPlayer& player() { return player_; }
  [[nodiscard]] LockedViews& views() const { return *views_; }
  /// Reads a path and adds it to the history, for side 0 or 1.
  void open_file(std::size_t side, const QString& file);

 private:
  [[nodiscard]] QWidget* make_chooser(std::size_t side);
  void fill_choosers();
  void take_history();
  void ask_for_file(std::size_t side);
  void show_side(std::size_t side);
  void show_figures();
  void show_moment();
  void update_player();

  PathHistory& history_;
  Query query_;
  PathPlayer player_;  ///< Of the longer one.
  LatestJob job_;
  LockedViews* views_;
  PlaybackBar* bar_;
  std::array<QComboBox*, 2> choosers_;
  std::array<std::optional<PathRecord>, 2> shown_;
  std::array<PathTimeline, 2> timelines_;
  FigureTable* table_;
  QLabel* note_;
};

}  // namespace handway::gui
