#pragma once

#include "handway/execution/motion/motion_run.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/timing/time_path.h"
#include "model/planning/plan_runner.h"

#include <QAbstractTableModel>
#include <QString>
#include <QTableView>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

class QSortFilterProxyModel;

namespace handway::gui {

/// A result in words with its key figures, as rich text.
/// @param note to be said first, plain text; may be empty.
[[nodiscard]] QString result_text(const planning::PlanResult& result, const QString& note = {});

/// The same without a note as plain text, for a tool tip; each figure has a line.
[[nodiscard]] QString result_tip(const planning::PlanResult& result);

/// Returns the text about a path that was replanned for an edited scene. @param source of the path,
/// one word.
[[nodiscard]] QString replanned_text(const planning::PlanResult& result, const QString& source);

/// A path that gets better, with its figures, as rich text.
[[nodiscard]] QString optimizing_text(const OptimizeProgress& progress);

/// A failure in words, as rich text.
[[nodiscard]] QString failure_text(const QString& message);

/// Returns a description of a motion, or of what prevents it (rich text).
[[nodiscard]] QString motion_text(const planning::TimedPath& motion);

/// Returns the cause that stopped a motion before its end.
[[nodiscard]] QString cause_of(const execution::MotionOutcome& outcome);

/// Returns how a motion ended (rich text).
[[nodiscard]] QString outcome_text(const execution::MotionOutcome& outcome);

/// Row of a table for a run; unknown values are empty.
struct RunRow {
  int number = 0;
  QString planner;
  QString preset;
  std::uint64_t seed = 1;
  double time_s = 0.0;  ///< Planning alone.
  QString outcome;
  std::optional<std::uint64_t> samples;
  std::optional<std::uint64_t> nodes;   ///< Nodes of the path.
  std::optional<double> length;         ///< In normalised joints.
  std::optional<double> duration;       ///< s
  std::optional<double> clearance;      ///< The least, mm.
  std::optional<double> hand_distance;  ///< From a person's postures or subspace, mean.
  QString tip;                          ///< Plain text.
  bool stands_out = false;
};

/// Runs as rows. There is a column for all that may be known of them: views hide those that they
/// have no use for.
class RunTable : public QAbstractTableModel {
  Q_OBJECT

 public:
  enum Column {
    kNumber,
    kPlanner,
    kPreset,
    kSeed,
    kTime,
    kOutcome,
    kSamples,
    kNodes,
    kLength,
    kDuration,
    kClearance,
    kHandDistance,
    kColumns
  };
  /// Numbers as numbers, for sorting.
  static constexpr int kSortRole = Qt::UserRole;

  using QAbstractTableModel::QAbstractTableModel;

  void clear();
  void add(const std::vector<RunRow>& rows);
  /// Replaces all rows.
  void set_rows(std::vector<RunRow> rows);
  [[nodiscard]] const std::vector<RunRow>& rows() const { return rows_; }

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
  [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation,
                                    int role) const override;

 private:
  std::vector<RunRow> rows_;
};

/// A view of runs, that are sorted by what is clicked on, of which one may be chosen.
class RunView : public QTableView {
  Q_OBJECT

 public:
  /// @param runs that are sorted, of a RunTable. @param columns that are shown. Outlives the view.
  RunView(QSortFilterProxyModel& runs, std::initializer_list<RunTable::Column> columns,
          QWidget* parent = nullptr);
};

}  // namespace handway::gui
