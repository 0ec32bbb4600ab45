#include "features/glove/coverage_bars.h"

#include "widgets/style/theme.h"

#include <QPainter>

#include <algorithm>
#include <cmath>

namespace handway::gui {

double JointVisits::share() const {
  return static_cast<double>(std::ranges::count(visited, true)) / kBins;
}

void JointCoverage::restart(const std::vector<std::string>& joints,
                            const std::vector<bool>& driven) {
  joints_.assign(joints.size(), {});
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints_[j].joint = joints[j];
    joints_[j].driven = driven[j];
  }
}

void JointCoverage::add(const Eigen::VectorXd& posture) {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointVisits& visits = joints_[j];
    visits.now = std::clamp(posture[static_cast<Eigen::Index>(j)], 0.0, 1.0);
    visits.least = std::min(visits.least, visits.now);
    visits.most = std::max(visits.most, visits.now);
    const int bin =
        std::min(static_cast<int>(visits.now * JointVisits::kBins), JointVisits::kBins - 1);
    visits.visited.at(static_cast<std::size_t>(bin)) = true;
  }
}

double JointCoverage::share() const {
  double sum = 0.0;
  int driven = 0;
  for (const JointVisits& visits : joints_) {
    if (visits.driven) {
      sum += visits.share();
      ++driven;
    }
  }
  return driven > 0 ? sum / driven : 0.0;
}

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
