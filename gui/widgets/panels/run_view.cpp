#include "widgets/panels/run_view.h"

#include "widgets/style/theme.h"

#include <QHeaderView>
#include <QSortFilterProxyModel>

#include <algorithm>

namespace handway::gui {
namespace {

constexpr int kRowHeight = 24;  // px
constexpr int kLeastColumn = 36;

// Wide enough for what is usually there, px.
int width_of(int column) {
  switch (column) {
    case RunTable::kNumber:
      return 46;
    case RunTable::kPlanner:
      return 104;
    case RunTable::kPreset:
      return 84;
    case RunTable::kSeed:
      return 50;
    case RunTable::kOutcome:
      return 106;
    case RunTable::kDuration:
      return 78;
    case RunTable::kClearance:
      return 112;
    default:
      return 64;
  }
}

}  // namespace

RunView::RunView(QSortFilterProxyModel& runs, std::initializer_list<RunTable::Column> columns,
                 QWidget* parent)
    : QTableView(parent) {
  runs.setSortRole(RunTable::kSortRole);
  setModel(&runs);
  for (int column = 0; column < RunTable::kColumns; ++column) {
    setColumnHidden(column, std::ranges::find(columns, column) == columns.end());
  }
  for (int column = 0; column < RunTable::kColumns; ++column) {
    setColumnWidth(column, scaled(width_of(column)));
  }
  setSortingEnabled(true);
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setShowGrid(false);
  setWordWrap(false);
  setProperty("role", "runs");
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(scaled(kRowHeight));
  horizontalHeader()->setHighlightSections(false);
  horizontalHeader()->setMinimumSectionSize(scaled(kLeastColumn));
}

}  // namespace handway::gui
