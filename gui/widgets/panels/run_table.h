#pragma once

#include <QAbstractTableModel>
#include <QString>

#include <cstdint>
#include <optional>
#include <vector>

namespace handway::gui {

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

}  // namespace handway::gui
