#include "comparison/figure_table.h"

#include "handway/geometric/math/units.h"

#include <QHeaderView>
#include <QObject>
#include <QTableWidget>

#include <cmath>

namespace handway::gui {
namespace {

struct Figure {
  QString name;
  QString unit;
  int decimals;
  double left;
  double right;
};

QString number(double value, int decimals) {
  return QString::number(value, 'f', decimals).replace(QLatin1Char('-'), QChar(0x2212));
}

QString difference(const Figure& figure) {
  const double by = figure.right - figure.left;
  const QString text = (by > 0.0 ? QStringLiteral("+") : QString()) + number(by, figure.decimals);
  return std::abs(figure.left) < 1e-9
             ? text
             : QObject::tr("%1 (%2 %)").arg(text, number(100.0 * by / figure.left, 0));
}

std::vector<Figure> figures(const PathFigures& left, const PathFigures& right) {
  using geometric::millimetres;
  std::vector<Figure> list{
      {QObject::tr("Duration"), "s", 2, left.duration, right.duration},
      {QObject::tr("Length in normalised joints"), {}, 3, left.length, right.length},
      {QObject::tr("Way of the palm"), "m", 3, left.palm_way, right.palm_way},
      {QObject::tr("Waypoints"),
       {},
       0,
       static_cast<double>(left.waypoints),
       static_cast<double>(right.waypoints)},
      {QObject::tr("Least clearance"), "mm", 2, millimetres(left.least_clearance),
       millimetres(right.least_clearance)},
      {QObject::tr("Mean clearance (up to 100 mm)"), "mm", 1, millimetres(left.mean_clearance),
       millimetres(right.mean_clearance)}};
  if (left.has_basis && right.has_basis) {
    list.push_back(
        {QObject::tr("Mean distance to PMDs"), {}, 3, left.mean_unlikeness, right.mean_unlikeness});
    list.push_back({QObject::tr("Largest distance to PMDs"),
                    {},
                    3,
                    left.most_unlikeness,
                    right.most_unlikeness});
  }
  return list;
}

}  // namespace

void fill_figures(QTableWidget& table, const PathFigures& left, const PathFigures& right) {
  const std::vector<Figure> list = figures(left, right);
  table.setColumnCount(3);
  table.setRowCount(static_cast<int>(list.size()));
  table.setHorizontalHeaderLabels(
      {QObject::tr("Left"), QObject::tr("Right"), QObject::tr("Right − left")});
  table.setEditTriggers(QAbstractItemView::NoEditTriggers);
  table.setSelectionMode(QAbstractItemView::NoSelection);
  table.setFocusPolicy(Qt::NoFocus);
  table.horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table.verticalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  for (int row = 0; row < table.rowCount(); ++row) {
    const Figure& figure = list[static_cast<std::size_t>(row)];
    table.setVerticalHeaderItem(
        row, new QTableWidgetItem(figure.unit.isEmpty()
                                      ? figure.name
                                      : QStringLiteral("%1, %2").arg(figure.name, figure.unit)));
    const QString texts[] = {number(figure.left, figure.decimals),
                             number(figure.right, figure.decimals), difference(figure)};
    for (int column = 0; column < table.columnCount(); ++column) {
      auto* item = new QTableWidgetItem(texts[column]);
      item->setTextAlignment(Qt::AlignCenter);
      table.setItem(row, column, item);
    }
  }
  int height = table.horizontalHeader()->sizeHint().height() + 2 * table.frameWidth();
  for (int row = 0; row < table.rowCount(); ++row) {
    height += table.rowHeight(row);
  }
  table.setFixedHeight(height);
}

}  // namespace handway::gui
