#include "panels/rejection_text.h"

#include <QObject>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace handway::gui {
namespace {

constexpr double kMost = 0.6;

int percent(std::uint64_t part, std::uint64_t whole) {
  return static_cast<int>(
      std::lround(100.0 * static_cast<double>(part) / static_cast<double>(whole)));
}

struct Stretch {
  int from = 0;  ///< Tenths.
  int to = 10;
};

// The shortest stretch of the way that holds most of the rejections.
Stretch narrowest(const std::vector<std::uint64_t>& tenths, std::uint64_t all) {
  Stretch best{0, static_cast<int>(tenths.size())};
  for (int from = 0; from < static_cast<int>(tenths.size()); ++from) {
    std::uint64_t inside = 0;
    for (int to = from + 1; to <= static_cast<int>(tenths.size()); ++to) {
      inside += tenths[static_cast<std::size_t>(to - 1)];
      if (static_cast<double>(inside) >= kMost * static_cast<double>(all)) {
        if (to - from < best.to - best.from) {
          best = {from, to};
        }
        break;
      }
    }
  }
  return best;
}

constexpr int kNearEnd = 3;  // tenths

QString advice(const Stretch& stretch, const QString& a, const QString& b) {
  if (stretch.to <= kNearEnd) {
    return QObject::tr("Try a start with more room between %1 and %2.").arg(a, b);
  }
  if (stretch.from >= 10 - kNearEnd) {
    return QObject::tr("Try a goal with more room between %1 and %2.").arg(a, b);
  }
  return QObject::tr(
             "Try more time, another planner or preset, or more room between %1 and %2 on the way.")
      .arg(a, b);
}

}  // namespace

QString rejection_text(const planning::PlanStatistics& statistics) {
  const auto& pairs = statistics.rejections;
  const std::uint64_t all =
      std::accumulate(pairs.begin(), pairs.end(), std::uint64_t{0},
                      [](std::uint64_t sum, const auto& pair) { return sum + pair.second; });
  if (all == 0) {
    return {};
  }
  const auto worst =
      std::ranges::max_element(pairs, {}, [](const auto& pair) { return pair.second; });
  const QString a = QString::fromStdString(worst->first.first);
  const QString b = QString::fromStdString(worst->first.second);
  QString text = QObject::tr("In %1 % of the samples that were refused, %2 touched %3")
                     .arg(percent(worst->second, all))
                     .arg(a, b);
  const auto& tenths = statistics.rejections_per_tenth;
  const std::uint64_t placed = std::accumulate(tenths.begin(), tenths.end(), std::uint64_t{0});
  Stretch stretch;
  if (placed > 0 && tenths.size() == 10) {
    stretch = narrowest(tenths, placed);
    if (stretch.to - stretch.from <= 5) {
      text += QObject::tr("; most of them between %1 and %2 % of the way")
                  .arg(10 * stretch.from)
                  .arg(10 * stretch.to);
    }
  }
  return text + QStringLiteral(". ") + advice(stretch, a, b);
}

}  // namespace handway::gui
