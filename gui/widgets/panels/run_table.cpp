#include "widgets/panels/run_table.h"

#include <QFont>

#include <cstddef>
#include <utility>

namespace handway::gui {
namespace {

template <typename Value>
QVariant known(const std::optional<Value>& value) {
  return value ? QVariant::fromValue(*value) : QVariant();
}

QVariant known(const std::optional<std::uint64_t>& value) {
  return value ? QVariant(static_cast<qulonglong>(*value)) : QVariant();
}

QVariant value_of(const RunRow& row, int column) {
  switch (column) {
    case RunTable::kNumber:
      return row.number;
    case RunTable::kPlanner:
      return row.planner;
    case RunTable::kPreset:
      return row.preset;
    case RunTable::kSeed:
      return static_cast<qulonglong>(row.seed);
    case RunTable::kTime:
      return row.time_s;
    case RunTable::kOutcome:
      return row.outcome;
    case RunTable::kSamples:
      return known(row.samples);
    case RunTable::kNodes:
      return known(row.nodes);
    case RunTable::kLength:
      return known(row.length);
    case RunTable::kDuration:
      return known(row.duration);
    case RunTable::kClearance:
      return known(row.clearance);
    case RunTable::kHandDistance:
      return known(row.hand_distance);
    default:
      return {};
  }
}

int decimals_of(int column) {
  return column == RunTable::kTime || column == RunTable::kHandDistance ? 3 : 2;
}

QVariant text_of(const RunRow& row, int column) {
  const QVariant value = value_of(row, column);
  if (!value.isValid()) {
    return QStringLiteral("–");
  }
  return value.type() == QVariant::Double
             ? QString::number(value.toDouble(), 'f', decimals_of(column))
             : value;
}

bool is_words(int column) {
  return column == RunTable::kPlanner || column == RunTable::kPreset ||
         column == RunTable::kOutcome;
}

}  // namespace

void RunTable::clear() { set_rows({}); }

void RunTable::set_rows(std::vector<RunRow> rows) {
  beginResetModel();
  rows_ = std::move(rows);
  endResetModel();
}

void RunTable::add(const std::vector<RunRow>& rows) {
  if (rows.empty()) {
    return;
  }
  const int first = rowCount();
  beginInsertRows({}, first, first + static_cast<int>(rows.size()) - 1);
  rows_.insert(rows_.end(), rows.begin(), rows.end());
  endInsertRows();
}

int RunTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int RunTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(kColumns);
}

QVariant RunTable::data(const QModelIndex& index, int role) const {
  const RunRow& row = rows_[static_cast<std::size_t>(index.row())];
  if (role == Qt::DisplayRole) {
    return text_of(row, index.column());
  }
  if (role == kSortRole) {
    return value_of(row, index.column());
  }
  if (role == Qt::TextAlignmentRole) {
    return static_cast<int>((is_words(index.column()) ? Qt::AlignLeft : Qt::AlignRight) |
                            Qt::AlignVCenter);
  }
  if (role == Qt::ToolTipRole) {
    return row.tip;
  }
  if (role == Qt::FontRole && row.stands_out) {
    QFont bold;
    bold.setBold(true);
    return bold;
  }
  return {};
}

QVariant RunTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) {
    return {};
  }
  if (role == Qt::TextAlignmentRole) {
    return static_cast<int>((is_words(section) ? Qt::AlignLeft : Qt::AlignRight) |
                            Qt::AlignVCenter);
  }
  if (role == Qt::ToolTipRole && section == kHandDistance) {
    return tr(
        "Mean distance of the hand from the nearest recorded posture of a person, or from the "
        "principal motion directions if none is recorded; smaller is more human-like");
  }
  if (role == Qt::ToolTipRole && section == kLength) {
    return tr("Length in joints normalised to [0, 1]");
  }
  if (role != Qt::DisplayRole) {
    return {};
  }
  switch (section) {
    case kNumber:
      return tr("Run");
    case kPlanner:
      return tr("Planner");
    case kPreset:
      return tr("Preset");
    case kSeed:
      return tr("Seed");
    case kTime:
      return tr("Time [s]");
    case kOutcome:
      return tr("Outcome");
    case kSamples:
      return tr("Samples");
    case kNodes:
      return tr("Nodes");
    case kLength:
      return tr("Length");
    case kDuration:
      return tr("Motion [s]");
    case kClearance:
      return tr("Clearance [mm]");
    case kHandDistance:
      return tr("Hand");
    default:
      return {};
  }
}

}  // namespace handway::gui
