#pragma once

#include "handway/planning/campaigns/run_archive.h"

#include <QAbstractTableModel>

#include <vector>

namespace handway::gui {

/// Runs as rows.
class RunTable : public QAbstractTableModel {
  Q_OBJECT

 public:
  enum Column { kPlanner, kSeed, kTime, kOutcome, kSamples, kNodes, kClearance, kColumns };
  /// Numbers as numbers, for sorting.
  static constexpr int kSortRole = Qt::UserRole;

  using QAbstractTableModel::QAbstractTableModel;

  void clear();
  void add(const std::vector<planning::ArchivedRun>& runs);
  [[nodiscard]] const std::vector<planning::ArchivedRun>& runs() const { return runs_; }

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
  [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation,
                                    int role) const override;

 private:
  std::vector<planning::ArchivedRun> runs_;
};

}  // namespace handway::gui
