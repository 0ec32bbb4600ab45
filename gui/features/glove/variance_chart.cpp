#include "features/glove/variance_chart.h"

#include "widgets/style/glove_colors.h"

#include <QPainter>
#include <QPolygonF>

#include <cmath>

namespace handway::gui {
namespace {

constexpr double kPercent = 100.0;
constexpr int kLabelled = 3;
constexpr Eigen::Index kMost = 12;
constexpr double kLabelHeight = 13.0;  // px
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
    lines << tr("%1 directions: %2 %").arg(k + 1).arg(sum * kPercent, 0, 'f', 2);
  }
  setToolTip(lines.join(QLatin1Char('\n')));
  update();
}

void VarianceChart::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont font = painter.font();
  font.setPixelSize(10);
  painter.setFont(font);
  const QRectF area = QRectF(rect()).adjusted(2, 8, -4, -16);
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
      painter.drawText(QRectF(middle - 10, area.bottom() + 2, 20, 13), Qt::AlignCenter,
                       QString::number(k + 1));
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
    if (k == 0 || sums[k - 1].y() - sums[k].y() > kLabelHeight) {
      painter.drawText(QRectF(sums[k].x() + 5, sums[k].y(), 60, kLabelHeight), Qt::AlignLeft,
                       QStringLiteral("%1 %").arg(sum * kPercent, 0, 'f', 0));
    }
  }
}

}  // namespace handway::gui
