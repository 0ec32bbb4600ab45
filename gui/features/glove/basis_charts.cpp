#include "features/glove/basis_charts.h"

#include "features/glove/joint_label.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QHelpEvent>
#include <QPainter>
#include <QPolygonF>
#include <QStringList>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace handway::gui {

CorrelationMap::CorrelationMap(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("correlation_map"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void CorrelationMap::set_correlations(const std::vector<std::string>& joints,
                                      const Eigen::MatrixXd& correlations) {
  joints_ = joints;
  correlations_ = correlations;
  update();
}

QRectF CorrelationMap::square() const {
  const double side = std::min(width() - 4, height() - 8 - 8);
  return {(width() - side) / 2.0, 8.0, side, side};
}

void CorrelationMap::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  const QRectF area = square();
  const auto count = static_cast<double>(correlations_.rows());
  for (Eigen::Index i = 0; i < correlations_.rows(); ++i) {
    for (Eigen::Index j = 0; j < correlations_.cols(); ++j) {
      const double value = correlations_(i, j);
      const double side = area.width() / count;
      const QRectF cell(area.left() + static_cast<double>(j) * side,
                        area.top() + static_cast<double>(i) * side, side, side);
      painter.fillRect(
          cell.adjusted(0.0, 0.0, -0.5, -0.5),
          mixed(colors.window, value >= 0.0 ? colors.accent : colors.bad, std::abs(value)));
    }
  }
  painter.setPen(QPen(colors.border, 1.0));
  painter.drawRect(area);
  if (correlations_.size() == 0) {
    set_text_size(painter, 10);
    painter.setPen(colors.muted);
    painter.drawText(area, Qt::AlignCenter, tr("no postures"));
  }
}

bool CorrelationMap::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && correlations_.size() > 0) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const QPointF inside = help->pos() - square().topLeft();
    const double side = square().width() / static_cast<double>(correlations_.rows());
    const auto column = static_cast<Eigen::Index>(std::floor(inside.x() / side));
    const auto row = static_cast<Eigen::Index>(std::floor(inside.y() / side));
    if (row >= 0 && column >= 0 && row < correlations_.rows() && column < correlations_.cols()) {
      QToolTip::showText(help->globalPos(),
                         tr("%1 and %2: %3")
                             .arg(joint_label(joints_[static_cast<std::size_t>(row)]),
                                  joint_label(joints_[static_cast<std::size_t>(column)]))
                             .arg(correlations_(row, column), 0, 'f', 2),
                         this);
      return true;
    }
    QToolTip::hideText();
  }
  return QWidget::event(event);
}

namespace {

constexpr double kPercentOfAll = 100.0;
constexpr int kLabelled = 3;
constexpr Eigen::Index kMost = 12;
constexpr int kLabelHeight = 13;  // px
constexpr double kBarShare = 0.62;

}  // namespace

VarianceChart::VarianceChart(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("variance_chart"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void VarianceChart::set_shares(const Eigen::VectorXd& shares) {
  shares_ = shares.head(std::min<Eigen::Index>(shares.size(), kMost));
  QStringList lines;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < shares_.size(); ++k) {
    sum += shares_[k];
    lines << tr("%1 directions: %2 %").arg(k + 1).arg(sum * kPercentOfAll, 0, 'f', 2);
  }
  setToolTip(lines.join(QLatin1Char('\n')));
  update();
}

void VarianceChart::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  set_text_size(painter, 10);
  const QRectF area = QRectF(rect()).adjusted(2, 8, -4, -scaled(16));
  painter.setPen(QPen(faded(colors.border, 0.9), 1.0));
  for (const double level : {0.0, 0.5, 1.0}) {
    const double y = area.bottom() - level * area.height();
    painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
  }
  if (shares_.size() == 0) {
    painter.setPen(colors.muted);
    painter.drawText(area, Qt::AlignCenter, tr("no postures"));
    return;
  }
  const double step = area.width() / static_cast<double>(shares_.size());
  QPolygonF sums;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < shares_.size(); ++k) {
    sum += shares_[k];
    const double middle = area.left() + (static_cast<double>(k) + 0.5) * step;
    sums << QPointF(middle, area.bottom() - sum * area.height());
    const double height = shares_[k] * area.height();
    painter.fillRect(
        QRectF(middle - kBarShare * step / 2, area.bottom() - height, kBarShare * step, height),
        faded(colors.accent, 0.35));
    if (k == 0 || (k + 1) % 4 == 0) {
      painter.setPen(colors.muted);
      painter.drawText(QRectF(middle - scaled(10), area.bottom() + 2, scaled(20), scaled(13)),
                       Qt::AlignCenter, QString::number(k + 1));
    }
  }
  painter.setPen(QPen(colors.accent, 1.6));
  painter.drawPolyline(sums);
  painter.setBrush(colors.surface);
  for (const QPointF& point : sums) {
    painter.drawEllipse(point, 2.2, 2.2);
  }
  sum = 0.0;
  painter.setPen(colors.text);
  for (int k = 0; k < std::min<int>(kLabelled, static_cast<int>(shares_.size())); ++k) {
    sum += shares_[k];
    if (k == 0 || sums[k - 1].y() - sums[k].y() > scaled(kLabelHeight)) {
      painter.drawText(QRectF(sums[k].x() + 5, sums[k].y(), scaled(60), scaled(kLabelHeight)),
                       Qt::AlignLeft, QStringLiteral("%1 %").arg(sum * kPercentOfAll, 0, 'f', 0));
    }
  }
}

}  // namespace handway::gui
