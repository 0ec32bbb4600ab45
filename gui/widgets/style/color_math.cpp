#include "widgets/style/color_math.h"

#include <algorithm>
#include <cmath>

namespace handway::gui {
namespace {

constexpr double kEnough = 3.0;  // of drawings
constexpr int kShades = 20;

double linear(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double luminance(const QColor& color) {
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
         0.0722 * linear(color.blueF());
}

}  // namespace

QColor mixed(const QColor& from, const QColor& to, double share) {
  const auto mix = [share](double a, double b) { return a + share * (b - a); };
  return QColor::fromRgbF(mix(from.redF(), to.redF()), mix(from.greenF(), to.greenF()),
                          mix(from.blueF(), to.blueF()), from.alphaF());
}

double contrast(const QColor& a, const QColor& b) {
  const auto [low, high] = std::minmax({luminance(a), luminance(b)});
  return (high + 0.05) / (low + 0.05);
}

QColor seen_on(const QColor& background, const QColor& color) {
  const QColor far = contrast(background, Qt::white) > contrast(background, Qt::black)
                         ? QColor(Qt::white)
                         : QColor(Qt::black);
  QColor seen = color;
  for (int step = 1; step <= kShades && contrast(seen, background) < kEnough; ++step) {
    seen = mixed(color, far, static_cast<double>(step) / kShades);
  }
  return seen;
}

}  // namespace handway::gui
