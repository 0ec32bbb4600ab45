#pragma once

#include "handway/planning/queries/motion_likeness.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"
#include "model/planning/path_history.h"
#include "model/playback/path_player.h"
#include "model/playback/path_timeline.h"

#include <QDialog>
#include <QTableWidget>
#include <QWidget>

#include <array>
#include <memory>
#include <optional>

class QComboBox;
class QLabel;

namespace handway::gui {

class PlaybackBar;
class Workbench;
class SceneView;

/// A motion of the history with its measures.
struct MeasuredMotion {
  std::shared_ptr<const planning::Motion> motion;  ///< Null: not measured.
  planning::MotionLikeness likeness;
  Eigen::MatrixXd comparable;  ///< planning::comparable_motion(); empty if it can't be timed.

  [[nodiscard]] bool is_of(const std::optional<PathRecord>& record) const {
    return record && motion == record->motion && comparable.size() > 0;
  }
};

/// The figures of two paths side by side, with what the right one has more or less; the better
/// of two numbers is bold and green where more or less is better.
class FigureTable : public QTableWidget {
  Q_OBJECT

 public:
  explicit FigureTable(QWidget* parent = nullptr);

  /// Shows dashes for figures that are missing.
  void show_figures(const std::optional<PathFigures>& left,
                    const std::optional<PathFigures>& right);
  /// Shows rows for the measures of the motions, unless both are missing. @param left, right may be
  /// null.
  void show_motions(const planning::MotionLikeness* left, const planning::MotionLikeness* right);

  /// Height of a dozen rows, or of all if there are fewer.
  [[nodiscard]] QSize sizeHint() const override;

 private:
  void fill();

  std::optional<PathFigures> left_;
  std::optional<PathFigures> right_;
  std::optional<planning::MotionLikeness> left_motion_;
  std::optional<planning::MotionLikeness> right_motion_;
  int usual_height_ = 0;
};

/// Two views side by side that always look from the same place.
class LockedViews : public QWidget {
  Q_OBJECT

 public:
  explicit LockedViews(QWidget* parent = nullptr);

  [[nodiscard]] SceneView& view(std::size_t index) const { return *views_.at(index); }

 private:
  /// Copies the camera of this view to the other one.
  void follow(std::size_t index);

  std::array<SceneView*, 2> views_;
};

/// Two paths side by side (the paper's Fig. 14): views that look from the same place, one
/// playback for both, and their figures below.
class ComparisonWindow : public QDialog {
  Q_OBJECT

 public:
  /// Problem that paths of files are checked in.
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
  /// Measures the motions that are shown and not measured yet, in the background.
  void measure_motions();
  void measure_motion(std::size_t side);
  [[nodiscard]] const MeasuredMotion* measured(std::size_t side) const;
  [[nodiscard]] QString note_on_both() const;
  /// Sentences about the measured motions.
  [[nodiscard]] QStringList notes_on_motions() const;
  void show_moment();
  void update_player();

  PathHistory& history_;
  Query query_;
  PathPlayer player_;  ///< Plays the longer path.
  LatestJob job_;
  std::array<LatestJob, 2> measuring_;
  LockedViews* views_;
  PlaybackBar* bar_;
  std::array<QComboBox*, 2> choosers_;
  std::array<std::optional<PathRecord>, 2> shown_;
  std::array<PathTimeline, 2> timelines_;
  std::array<MeasuredMotion, 2> measured_;
  FigureTable* table_;
  QLabel* note_;
};

/// Adds the command "compare", enabled while there is a path to compare.
void add_comparison(Workbench& workbench);

}  // namespace handway::gui
