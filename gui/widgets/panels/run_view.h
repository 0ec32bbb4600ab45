#pragma once

#include "widgets/panels/run_table.h"

#include <QTableView>

#include <initializer_list>

class QSortFilterProxyModel;

namespace handway::gui {

/// A view of runs, that are sorted by what is clicked on, of which one may be chosen.
class RunView : public QTableView {
  Q_OBJECT

 public:
  /// @param runs that are sorted, of a RunTable. @param columns that are shown. Outlives the view.
  RunView(QSortFilterProxyModel& runs, std::initializer_list<RunTable::Column> columns,
          QWidget* parent = nullptr);
};

}  // namespace handway::gui
