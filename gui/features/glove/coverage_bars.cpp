#include "features/glove/coverage_bars.h"

#include "widgets/style/glove_colors.h"

#include <QPainter>

#include <cmath>

namespace handway::gui {
namespace {

constexpr int kRowHeight = 21;
constexpr int kSideMargin = 12;
constexpr int kNameWidth = 118;
constexpr int kPercentWidth = 44;
constexpr int kBarHeight = 9;
constexpr double kPercentPerShare = 100.0;

}  // namespace

QString joint_label(const std::string& joint) {
  QString text = QString::fromStdString(joint).replace(QLatin1Char('_'), QLatin1Char(' '));
  if (!text.isEmpty()) {
    text[0] = text[0].toUpper();
  }
  return text;
}

CoverageBars::CoverageBars(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("coverage_bars"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(
      tr("The range of each joint: where the hand has been is filled, the line is "
         "where it is"));
}

void CoverageBars::show_coverage(const JointCoverage& coverage) {
  const bool other_size = coverage.joints().size() != joints_.size();
  joints_ = coverage.joints();
  if (other_size) {
    updateGeometry();
  }
  update();
}

QSize CoverageBars::sizeHint() const {
  return {300, static_cast<int>(joints_.size()) * kRowHeight};
}

void CoverageBars::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  QFont font = painter.font();
  font.setPixelSize(12);
  painter.setFont(font);
  const int bar_x = kSideMargin + kNameWidth;
  const int bar_width = width() - bar_x - kPercentWidth - kSideMargin;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointVisits& visits = joints_[j];
    const int top = static_cast<int>(j) * kRowHeight;
    painter.setPen(visits.driven ? colors.text : colors.muted);
    painter.drawText(QRect(kSideMargin, top, kNameWidth, kRowHeight), Qt::AlignVCenter,
                     joint_label(visits.joint));
    const QRectF bar(bar_x, top + (kRowHeight - kBarHeight) / 2.0, bar_width, kBarHeight);
    painter.fillRect(bar, faded(colors.border, visits.driven ? 0.7 : 0.35));
    const double bin = bar.width() / JointVisits::kBins;
    for (int b = 0; b < JointVisits::kBins && visits.driven; ++b) {
      if (visits.visited.at(static_cast<std::size_t>(b))) {
        const int begin = b;
        while (b + 1 < JointVisits::kBins && visits.visited.at(static_cast<std::size_t>(b) + 1)) {
          ++b;
        }
        painter.fillRect(
            QRectF(bar.left() + begin * bin, bar.top(), (b + 1 - begin) * bin, bar.height()),
            faded(colors.accent, 0.85));
      }
    }
    const bool begun = visits.most >= visits.least;
    if (begun && visits.driven) {
      const double x = bar.left() + visits.now * (bar.width() - 2.0);
      painter.fillRect(QRectF(x, bar.top() - 3.0, 2.0, bar.height() + 6.0), colors.text);
    }
    const QRect percent(width() - kSideMargin - kPercentWidth, top, kPercentWidth, kRowHeight);
    painter.setPen(colors.muted);
    painter.drawText(
        percent, Qt::AlignVCenter | Qt::AlignRight,
        visits.driven ? QStringLiteral("%1 %").arg(std::lround(visits.share() * kPercentPerShare))
                      : tr("fixed"));
  }
}

}  // namespace handway::gui
