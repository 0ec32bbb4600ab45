#include "campaign_plots.h"

#include "report_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace handway::tools {
namespace {

constexpr double kWidth = 760.0;
constexpr double kLeft = 60.0;
constexpr double kRight = 20.0;
constexpr double kPlotHeight = 260.0;
constexpr double kRowHeight = 26.0;
constexpr double kTop = 12.0;
constexpr double kAxisHeight = 40.0;
constexpr double kShortest = 1e-6;  // s; what is shorter is drawn here
// Okabe and Ito's colours, told apart by all eyes.
constexpr std::array<const char*, 7> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#000000"};

const char* color(std::size_t i) { return kColors[i % kColors.size()]; }

/// Seconds on a logarithmic axis across the drawing; whole decades.
class TimeAxis {
 public:
  TimeAxis(std::span<const PlotSeries> series, double left) : left_(left) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const PlotSeries& one : series) {
      for (const double value : one.values) {
        if (std::isfinite(value)) {
          least = std::min(least, std::max(value, kShortest));
          most = std::max(most, std::max(value, kShortest));
        }
      }
    }
    if (most > 0.0) {
      first_ = static_cast<int>(std::floor(std::log10(least)));
      last_ = std::max(first_ + 1, static_cast<int>(std::ceil(std::log10(most))));
    }
  }

  [[nodiscard]] double x(double value) const {
    const double decades = std::log10(std::max(value, kShortest)) - first_;
    return left_ + (kWidth - kRight - left_) * decades / (last_ - first_);
  }
  [[nodiscard]] std::string svg(double top, double bottom) const {
    std::string svg;
    for (int decade = first_; decade <= last_; ++decade) {
      const double at = x(std::pow(10.0, decade));
      svg += fmt::format(
          "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#ddd\"/>"
          "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
          at, top, bottom, bottom + 16.0, std::pow(10.0, decade));
    }
    return svg + fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">time [s]</text>\n",
                             (left_ + kWidth - kRight) / 2.0, bottom + 33.0);
  }

 private:
  double left_;
  int first_ = -3;
  int last_ = 1;
};

std::string drawing(double height, const std::string& content) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\">\n{2}</svg>",
      kWidth, height, content);
}

std::string step_line(const TimeAxis& axis, const PlotSeries& series, const char* stroke,
                      double bottom) {
  std::string points;
  double y = bottom;
  for (const planning::EcdfStep& step : planning::ecdf_of(series.values)) {
    const double x = axis.x(step.value);
    const double next = bottom - kPlotHeight * step.share;
    points += fmt::format("{0:.1f},{1:.1f} {0:.1f},{2:.1f} ", x, y, next);
    y = next;
  }
  points += fmt::format("{:.1f},{:.1f}", kWidth - kRight, y);
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                     points, stroke);
}

std::string box(const TimeAxis& axis, const planning::BoxPlot& plot, const char* stroke,
                double middle) {
  constexpr double kHalf = 8.0;
  std::string svg = fmt::format(
      "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{}\" y2=\"{}\" stroke=\"{}\"/>"
      "<rect x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\" fill=\"#fff\" stroke=\"{}\"/>"
      "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"3\"/>\n",
      axis.x(plot.lower_whisker), axis.x(plot.upper_whisker), middle, middle, stroke,
      axis.x(plot.lower_quartile), middle - kHalf,
      std::max(1.0, axis.x(plot.upper_quartile) - axis.x(plot.lower_quartile)), 2.0 * kHalf, stroke,
      axis.x(plot.median), axis.x(plot.median), middle - kHalf, middle + kHalf, stroke);
  for (const double outlier : plot.outliers) {
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{}\" r=\"2\" fill=\"none\" stroke=\"{}\"/>",
                       axis.x(outlier), middle, stroke);
  }
  return svg;
}

}  // namespace

std::string ecdf_svg(std::span<const PlotSeries> series) {
  constexpr double kLegendLine = 18.0;
  constexpr int kShareLines = 5;
  const TimeAxis axis(series, kLeft);
  const double bottom = kTop + kPlotHeight;
  std::string svg = axis.svg(kTop, bottom);
  for (int i = 0; i <= kShareLines; ++i) {
    const double share = static_cast<double>(i) / kShareLines;
    const double y = bottom - kPlotHeight * share;
    svg += fmt::format(
        "<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>"
        "<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:.0f} %</text>\n",
        kLeft, kWidth - kRight, y, y, kLeft - 6.0, y + 4.0, 100.0 * share);
  }
  double legend = bottom + kAxisHeight + kLegendLine;
  for (std::size_t i = 0; i < series.size(); ++i) {
    svg += step_line(axis, series[i], color(i), bottom);
    svg += fmt::format(
        "<rect x=\"{}\" y=\"{:.1f}\" width=\"18\" height=\"4\" fill=\"{}\"/>"
        "<text x=\"{}\" y=\"{:.1f}\">{}</text>\n",
        kLeft, legend - 6.0, color(i), kLeft + 26.0, legend, html_escaped(series[i].label));
    legend += kLegendLine;
  }
  return drawing(legend, svg);
}

std::string box_plot_svg(std::span<const PlotSeries> series) {
  constexpr double kLabels = 220.0;
  const TimeAxis axis(series, kLabels);
  const double bottom = kTop + kRowHeight * static_cast<double>(series.size());
  std::string svg = axis.svg(kTop, bottom);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double middle = kTop + kRowHeight * (static_cast<double>(i) + 0.5);
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", kLabels - 8.0,
                       middle + 4.0, html_escaped(series[i].label));
    std::vector<double> finite = series[i].values;
    std::erase_if(finite, [](double value) { return !std::isfinite(value); });
    if (!finite.empty()) {
      svg += box(axis, planning::box_plot_of(finite), color(i), middle);
    }
  }
  return drawing(bottom + kAxisHeight, svg);
}

}  // namespace handway::tools
