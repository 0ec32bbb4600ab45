#include "features/comparison/figure_table.h"

#include "handway/geometric/math/units.h"
#include "widgets/style/theme.h"

#include <QEvent>
#include <QHeaderView>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

enum class Better { kLess, kMore, kNeither };
enum Column { kName, kLeft, kRight, kDifference, kColumns };

constexpr int kFigureRowHeight = 24;
constexpr double kNoDifference = 1e-9;

struct Figure {
  QString name;
  int decimals;
  Better better;
  std::optional<double> left;
  std::optional<double> right;
  std::optional<double> most = std::nullopt;  ///< More is not told apart.
};

QString number(double value, int decimals) {
  return QString::number(value, 'f', decimals).replace(QLatin1Char('-'), QChar(0x2212));
}

QString value_text(const Figure& figure, const std::optional<double>& value) {
  if (!value) {
    return QChar(0x2013);
  }
  const QString text = number(*value, figure.decimals);
  return figure.most && *value >= *figure.most ? QStringLiteral("≥ ") + text : text;
}

QString difference_text(const Figure& figure) {
  if (!figure.left || !figure.right) {
    return QChar(0x2013);
  }
  const double by = *figure.right - *figure.left;
  if (const QString none = number(0.0, figure.decimals);
      number(std::abs(by), figure.decimals) == none) {
    return none;
  }
  const QString text = (by > 0.0 ? QStringLiteral("+") : QString()) + number(by, figure.decimals);
  const double percent = 100.0 * by / *figure.left;
  return std::abs(*figure.left) < kNoDifference
             ? text
             : QObject::tr("%1 (%2 %)")
                   .arg(text,
                        (percent > 0.0 ? QStringLiteral("+") : QString()) + number(percent, 0));
}

bool left_is_better(const Figure& figure) {
  return figure.better == Better::kLess ? *figure.left < *figure.right
                                        : *figure.left > *figure.right;
}

// The column of the better value, if one is.
std::optional<Column> better_column(const Figure& figure) {
  if (figure.better == Better::kNeither || !figure.left || !figure.right ||
      value_text(figure, figure.left) == value_text(figure, figure.right)) {
    return std::nullopt;
  }
  return left_is_better(figure) ? kLeft : kRight;
}

using Read = std::optional<double> (*)(const PathFigures& figures);

template <auto member, auto part>
std::optional<double> distance(const PathFigures& figures) {
  return figures.*member ? std::optional((figures.*member).value().*part) : std::nullopt;
}

std::vector<Figure> figures(const std::optional<PathFigures>& left,
                            const std::optional<PathFigures>& right) {
  using planning::DistanceAlong;
  const auto most = geometric::millimetres(kMostClearance);
  std::vector<Figure> list;
  const auto add = [&](const QString& name, int decimals, Better better, Read read,
                       std::optional<double> limit = std::nullopt) {
    list.push_back({name, decimals, better, left ? read(*left) : std::nullopt,
                    right ? read(*right) : std::nullopt, limit});
  };
  const auto add_distance = [&](const QString& name, Read read) {
    add(name, 3, Better::kLess, read);
    if (!list.back().left && !list.back().right) {
      list.pop_back();
    }
  };
  using Value = std::optional<double>;
  add(QObject::tr("Duration, s"), 2, Better::kLess,
      [](const PathFigures& f) { return Value(f.duration); });
  add(QObject::tr("Length, in normalised joints"), 3, Better::kLess,
      [](const PathFigures& f) { return Value(f.length); });
  add(QObject::tr("Turning at waypoints, rad"), 2, Better::kLess,
      [](const PathFigures& f) { return Value(f.turning); });
  add(QObject::tr("Way of the palm, m"), 3, Better::kLess,
      [](const PathFigures& f) { return Value(f.palm_way); });
  add(QObject::tr("Waypoints"), 0, Better::kNeither,
      [](const PathFigures& f) { return Value(f.waypoints); });
  add(
      QObject::tr("Least clearance, mm"), 1, Better::kMore,
      [](const PathFigures& f) { return Value(geometric::millimetres(f.least_clearance)); }, most);
  add(
      QObject::tr("Mean clearance, mm"), 1, Better::kMore,
      [](const PathFigures& f) {
        return f.mean_clearance ? Value(geometric::millimetres(*f.mean_clearance)) : std::nullopt;
      },
      most);
  add_distance(QObject::tr("Hand to the PMD subspace, mean"),
               distance<&PathFigures::to_subspace, &DistanceAlong::mean>);
  add_distance(QObject::tr("Hand to the PMD subspace, largest"),
               distance<&PathFigures::to_subspace, &DistanceAlong::largest>);
  add_distance(QObject::tr("Hand to recorded postures, mean"),
               distance<&PathFigures::to_recorded, &DistanceAlong::mean>);
  add_distance(QObject::tr("Hand to recorded postures, largest"),
               distance<&PathFigures::to_recorded, &DistanceAlong::largest>);
  return list;
}

}  // namespace

FigureTable::FigureTable(QWidget* parent) : QTableWidget(parent) {
  setProperty("role", "figures");
  setColumnCount(kColumns);
  setHorizontalHeaderLabels({QString(), tr("Left"), tr("Right"), tr("Right − left")});
  for (int column = kLeft; column < kColumns; ++column) {
    horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  }
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(kFigureRowHeight);
  horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  horizontalHeader()->setSectionResizeMode(kName, QHeaderView::ResizeToContents);
  horizontalHeader()->setSectionsClickable(false);
  setShowGrid(false);
  setAlternatingRowColors(true);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setSelectionMode(QAbstractItemView::NoSelection);
  setFocusPolicy(Qt::NoFocus);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  fill();
}

void FigureTable::show_figures(const std::optional<PathFigures>& left,
                               const std::optional<PathFigures>& right) {
  left_ = left;
  right_ = right;
  fill();
}

void FigureTable::changeEvent(QEvent* event) {
  QTableWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) {
    fill();
  }
}

void FigureTable::fill() {
  const std::vector<Figure> list = figures(left_, right_);
  const QColor good = colors_of(current_theme()).good;
  setRowCount(static_cast<int>(list.size()));
  for (int row = 0; row < rowCount(); ++row) {
    const Figure& figure = list[static_cast<std::size_t>(row)];
    const std::optional<Column> better = better_column(figure);
    const std::array<QString, kColumns> texts{figure.name, value_text(figure, figure.left),
                                              value_text(figure, figure.right),
                                              difference_text(figure)};
    for (int column = 0; column < kColumns; ++column) {
      auto* item = new QTableWidgetItem(texts.at(static_cast<std::size_t>(column)));
      item->setTextAlignment((column == kName ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
      if (better == column) {
        QFont bold = font();
        bold.setBold(true);
        item->setFont(bold);
        item->setForeground(good);
        item->setToolTip(tr("The better one"));
      }
      setItem(row, column, item);
    }
  }
  setFixedHeight(horizontalHeader()->sizeHint().height() + rowCount() * kFigureRowHeight +
                 2 * frameWidth());
}

}  // namespace handway::gui
