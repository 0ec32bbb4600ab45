#include "features/glove/correlation_map.h"

#include "features/glove/coverage_bars.h"
#include "widgets/style/glove_colors.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace handway::gui {
namespace {

QColor mixed(const QColor& a, const QColor& b, double share) {
  const auto mix = [share](double from, double to) { return from + share * (to - from); };
  return QColor::fromRgbF(mix(a.redF(), b.redF()), mix(a.greenF(), b.greenF()),
                          mix(a.blueF(), b.blueF()));
}

}  // namespace

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
    QFont font = painter.font();
    font.setPixelSize(10);
    painter.setFont(font);
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

}  // namespace handway::gui
