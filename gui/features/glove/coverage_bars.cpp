#include "features/glove/coverage_bars.h"

#include "features/glove/joint_label.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QPainter>

#include <cmath>
#include <cstddef>

namespace handway::gui {
namespace {

constexpr int kRowHeight = 21;
constexpr int kNameWidth = 118;
constexpr int kPercentWidth = 44;
constexpr int kBarHeight = 9;
constexpr double kPercentPerShare = 100.0;

}  // namespace

CoverageBars::CoverageBars(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("coverage_bars"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(tr("Range of each joint: the visited part is filled, the line is the present value"));
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
  return {scaled(300), static_cast<int>(joints_.size()) * scaled(kRowHeight)};
}

void CoverageBars::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  set_text_size(painter, 12);
  const int bar_x = kSideMargin + scaled(kNameWidth);
  const int bar_width = width() - bar_x - scaled(kPercentWidth) - kSideMargin;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointVisits& visits = joints_[j];
    const int top = static_cast<int>(j) * scaled(kRowHeight);
    painter.setPen(visits.driven ? colors.text : colors.muted);
    painter.drawText(QRect(kSideMargin, top, scaled(kNameWidth), scaled(kRowHeight)),
                     Qt::AlignVCenter, joint_label(visits.joint));
    const QRectF bar(bar_x, top + (scaled(kRowHeight) - kBarHeight) / 2.0, bar_width, kBarHeight);
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
    const QRect percent(width() - kSideMargin - scaled(kPercentWidth), top, scaled(kPercentWidth),
                        scaled(kRowHeight));
    painter.setPen(colors.muted);
    painter.drawText(
        percent, Qt::AlignVCenter | Qt::AlignRight,
        visits.driven ? QStringLiteral("%1 %").arg(std::lround(visits.share() * kPercentPerShare))
                      : tr("fixed"));
  }
}

}  // namespace handway::gui
