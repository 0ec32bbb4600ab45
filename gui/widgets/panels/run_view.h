#pragma once

#include "widgets/panels/run_table.h"

#include <QTableView>

#include <initializer_list>

class QSortFilterProxyModel;

namespace handway::gui {

/// A view of runs of which one may be chosen; a click on a column sorts them.
class RunView : public QTableView {
  Q_OBJECT

 public:
  /// @param runs that are sorted, of a RunTable. @param columns that are shown. Outlives the view.
  RunView(QSortFilterProxyModel& runs, std::initializer_list<RunTable::Column> columns,
          QWidget* parent = nullptr);
};

}  // namespace handway::gui
