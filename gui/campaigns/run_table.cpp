#include "campaigns/run_table.h"

namespace handway::gui {
namespace {

using planning::ArchivedRun;

QVariant value_of(const ArchivedRun& run, int column) {
  switch (column) {
    case RunTable::kPlanner:
      return QString::fromStdString(run.planner.label);
    case RunTable::kSeed:
      return static_cast<qulonglong>(run.seed);
    case RunTable::kOutcome:
      return QString::fromStdString(run.status);
    case RunTable::kTime:
      return run.time_s;
    case RunTable::kSamples:
      return static_cast<qulonglong>(run.samples);
    case RunTable::kNodes:
      return run.solved ? QVariant(static_cast<qulonglong>(run.path_nodes)) : QVariant();
    case RunTable::kClearance:
      return run.solved ? QVariant(run.min_clearance_mm) : QVariant();
    default:
      return {};
  }
}

QVariant text_of(const ArchivedRun& run, int column) {
  const QVariant value = value_of(run, column);
  if (!value.isValid()) {
    return QStringLiteral("–");
  }
  if (column == RunTable::kTime) {
    return QString::number(value.toDouble(), 'f', 3);
  }
  if (column == RunTable::kClearance) {
    return QString::number(value.toDouble(), 'f', 2);
  }
  return value;
}

}  // namespace

void RunTable::clear() {
  beginResetModel();
  runs_.clear();
  endResetModel();
}

void RunTable::add(const std::vector<ArchivedRun>& runs) {
  if (runs.empty()) {
    return;
  }
  const int first = rowCount();
  beginInsertRows({}, first, first + static_cast<int>(runs.size()) - 1);
  runs_.insert(runs_.end(), runs.begin(), runs.end());
  endInsertRows();
}

int RunTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(runs_.size());
}

int RunTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(kColumns);
}

QVariant RunTable::data(const QModelIndex& index, int role) const {
  const ArchivedRun& run = runs_[static_cast<std::size_t>(index.row())];
  if (role == Qt::DisplayRole) {
    return text_of(run, index.column());
  }
  if (role == kSortRole) {
    return value_of(run, index.column());
  }
  if (role == Qt::TextAlignmentRole) {
    const bool words = index.column() == kPlanner || index.column() == kOutcome;
    return static_cast<int>((words ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
  }
  if (role == Qt::ToolTipRole) {
    return tr("Open its scene and plan it again with its seed");
  }
  return {};
}

QVariant RunTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) {
    return {};
  }
  switch (section) {
    case kPlanner:
      return tr("Planner");
    case kSeed:
      return tr("Seed");
    case kOutcome:
      return tr("Outcome");
    case kTime:
      return tr("Time [s]");
    case kSamples:
      return tr("Samples");
    case kNodes:
      return tr("Nodes");
    case kClearance:
      return tr("Clearance [mm]");
    default:
      return {};
  }
}

}  // namespace handway::gui
