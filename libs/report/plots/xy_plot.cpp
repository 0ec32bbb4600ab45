#include "plots/axis_scale.h"
#include "plots/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace handway::report {
namespace {

constexpr double kPlotRoom = 10.0;       // around a plot
constexpr double kHeightToWidth = 0.55;  // of the plane
constexpr double kLeastHeight = 120.0;
constexpr double kMostHeight = 280.0;
constexpr double kTickGap = 6.0;    // between the plane and its labels
constexpr double kTickRoom = 90.0;  // for a label across
constexpr double kTickLine = 40.0;  // for a label upwards
constexpr double kLegendSample = 26.0;
constexpr double kHalfBar = 0.3;

/// A series with the place of its colour.
struct Colored {
  const Series& series;
  std::size_t color;
};

std::size_t point_count(const Series& series) { return std::min(series.x.size(), series.y.size()); }

bool has_point(const Series& series, std::size_t i) {
  return is_drawn(series.x[i]) && is_drawn(series.y[i]);
}

bool has_band(const Series& series, std::size_t i) {
  return i < series.low.size() && i < series.high.size() && is_drawn(series.low[i]) &&
         is_drawn(series.high[i]);
}

/// Values along one axis of all points that are drawn.
struct Extents {
  std::vector<double> x;
  std::vector<double> y;
};

Extents extents_of(const XyPlot& plot) {
  Extents all;
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < point_count(series); ++i) {
      if (!has_point(series, i)) {
        continue;
      }
      all.x.push_back(series.x[i]);
      all.y.push_back(series.y[i]);
      if (series.mark == Mark::kBars) {
        all.x.insert(all.x.end(), {series.x[i] - kHalfBar, series.x[i] + kHalfBar});
        all.y.push_back(0.0);
      }
      if (has_band(series, i)) {
        all.y.insert(all.y.end(), {series.low[i], series.high[i]});
      }
    }
  }
  return all;
}

class XyPainter {
 public:
  XyPainter(const AxisScale& x, const AxisScale& y, const Area& plane)
      : x_(x), y_(y), plane_(plane) {}

  [[nodiscard]] std::string scales(const XyPlot& plot) const {
    std::string svg;
    for (const AxisScale::Tick& tick : x_.ticks()) {
      const double at = x_.at(tick.value);
      svg += svg_line(at, plane_.top, at, plane_.bottom, kGrid);
      svg += svg_text(at, plane_.bottom + kTextSize + kTickGap, tick.label,
                      {.anchor = Anchor::kMiddle});
    }
    for (const AxisScale::Tick& tick : y_.ticks()) {
      const double at = y_.at(tick.value);
      svg += svg_line(plane_.left, at, plane_.right, at, kGrid);
      svg += svg_text(plane_.left - kTickGap, at + 4.0, tick.label, {.anchor = Anchor::kEnd});
    }
    svg += svg_rectangle(plane_, "none", kFrame);
    svg += svg_text(plane_.center(), plane_.bottom + kTickGap + 2.0 * kLineHeight - 2.0,
                    axis_title(plot.x), {.anchor = Anchor::kMiddle, .most_width = plane_.width()});
    svg += svg_upright(kPlotRoom + kTextSize - 2.0, plane_.middle(), axis_title(plot.y),
                       {.anchor = Anchor::kMiddle, .most_width = plane_.height()});
    return svg;
  }

  [[nodiscard]] std::string drawn(const Colored& colored) const {
    const Series& series = colored.series;
    std::string svg = "<g class=\"series\">\n";
    switch (series.mark) {
      case Mark::kBars:
        svg += bars(colored);
        break;
      case Mark::kDots:
        svg += dots(colored, 1.6, 0.4);
        break;
      case Mark::kPoints:
        svg += lines(colored, false) + circles(colored);
        break;
      case Mark::kLine:
        svg += lines(colored, false);
        break;
      case Mark::kSteps:
        svg += lines(colored, true);
        break;
    }
    return svg + notes(series) + "</g>\n";
  }

 private:
  // Stretches without a gap.
  [[nodiscard]] std::string lines(const Colored& colored, bool has_steps) const {
    const Series& series = colored.series;
    std::string svg;
    std::string points;
    std::string upper;
    std::vector<std::string> lower;
    double previous = 0.0;
    const auto end_stretch = [&] {
      if (!lower.empty()) {
        std::reverse(lower.begin(), lower.end());
        svg += fmt::format("<polygon points=\"{}", upper);
        for (const std::string& point : lower) {
          svg += point;
        }
        svg += fmt::format("\" fill=\"{}\" fill-opacity=\"0.2\"/>\n", series_color(colored.color));
      }
      if (!points.empty()) {
        if (has_steps) {
          points += fmt::format("{:.1f},{:.1f} ", plane_.right, previous);
        }
        points.pop_back();
        svg += fmt::format(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" "
            "stroke-linejoin=\"round\"{}/>\n",
            points, series_color(colored.color), series_dashes(colored.color));
      }
      points.clear();
      upper.clear();
      lower.clear();
    };
    for (std::size_t i = 0; i < point_count(series); ++i) {
      if (!has_point(series, i)) {
        end_stretch();
        continue;
      }
      const double x = x_.at(series.x[i]);
      const double y = y_.at(series.y[i]);
      if (has_steps && !points.empty()) {
        points += fmt::format("{:.1f},{:.1f} ", x, previous);
      }
      points += fmt::format("{:.1f},{:.1f} ", x, y);
      previous = y;
      if (has_band(series, i)) {
        upper += fmt::format("{:.1f},{:.1f} ", x, y_.at(series.high[i]));
        lower.push_back(fmt::format("{:.1f},{:.1f} ", x, y_.at(series.low[i])));
      }
    }
    end_stretch();
    return svg;
  }

  [[nodiscard]] std::string dots(const Colored& colored, double radius, double opacity) const {
    const Series& series = colored.series;
    std::string svg =
        fmt::format("<g fill=\"{}\" fill-opacity=\"{}\">\n", series_color(colored.color), opacity);
    for (std::size_t i = 0; i < point_count(series); ++i) {
      if (has_point(series, i)) {
        svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>", x_.at(series.x[i]),
                           y_.at(series.y[i]), radius);
      }
    }
    return svg + "\n</g>\n";
  }

  [[nodiscard]] std::string circles(const Colored& colored) const {
    const Series& series = colored.series;
    std::string svg;
    for (std::size_t i = 0; i < point_count(series); ++i) {
      if (has_point(series, i)) {
        svg += fmt::format(
            "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"#fff\" stroke=\"{}\" "
            "stroke-width=\"1.5\"/>\n",
            x_.at(series.x[i]), y_.at(series.y[i]), series_color(colored.color));
      }
    }
    return svg;
  }

  [[nodiscard]] std::string bars(const Colored& colored) const {
    const Series& series = colored.series;
    std::string svg;
    for (std::size_t i = 0; i < point_count(series); ++i) {
      if (has_point(series, i)) {
        const auto [top, bottom] = std::minmax({y_.at(series.y[i]), y_.at(0.0)});
        svg += fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
            "fill-opacity=\"0.3\"/>\n",
            x_.at(series.x[i] - kHalfBar), top,
            x_.at(series.x[i] + kHalfBar) - x_.at(series.x[i] - kHalfBar), bottom - top,
            series_color(colored.color));
      }
    }
    return svg;
  }

  // Below their points to the right, where a rising line is not.
  [[nodiscard]] std::string notes(const Series& series) const {
    std::string svg;
    for (std::size_t i = 0; i < std::min(series.notes.size(), point_count(series)); ++i) {
      if (has_point(series, i) && !series.notes[i].empty()) {
        svg += svg_text(x_.at(series.x[i]) + kTickGap, y_.at(series.y[i]) + kTextSize + 2.0,
                        series.notes[i], {.size = 11.0});
      }
    }
    return svg;
  }

  const AxisScale& x_;
  const AxisScale& y_;
  const Area& plane_;
};

/// Entries side by side, as many in a row as have room; adds them to a drawing.
void add_legend(Drawing& drawing, const std::vector<Colored>& entries, double left, double right) {
  double x = left;
  double y = drawing.height + kTextSize;
  for (const auto& [series, color] : entries) {
    const double width =
        std::min(kLegendSample + text_width(series.label) + 2.0 * kTextSize, right - left);
    if (x > left && x + width > right) {
      x = left;
      y += kLineHeight;
    }
    const double sample = kLegendSample - kTickGap;
    const double middle = y - 4.0;
    if (series.mark == Mark::kBars) {
      drawing.elements += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"10\" fill=\"{}\" "
          "fill-opacity=\"0.3\"/>\n",
          x, middle - 5.0, sample, series_color(color));
    } else if (series.mark == Mark::kDots) {
      drawing.elements += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n",
                                      x + sample / 2.0, middle, series_color(color));
    } else {
      drawing.elements +=
          fmt::format("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"{}\" stroke-width=\"2\"{}/>\n", x,
                      middle, sample, series_color(color), series_dashes(color));
    }
    drawing.elements +=
        svg_text(x + kLegendSample, y, series.label, {.most_width = right - x - kLegendSample});
    x += width;
  }
  drawing.height = entries.empty() ? drawing.height : y + kPlotRoom;
}

}  // namespace

Drawing draw(const XyPlot& plot, double width) {
  const Extents extents = extents_of(plot);
  const bool has_title = !plot.title.empty();
  const double top = has_title ? kLineHeight + 2.0 * kTickGap : kPlotRoom;
  const double height = std::clamp(kHeightToWidth * width, kLeastHeight, kMostHeight);
  AxisScale y(plot.y, extents.y, static_cast<int>(height / kTickLine));
  const double left = kPlotRoom + kLineHeight + y.label_width() + kTickGap;
  AxisScale x(plot.x, extents.x,
              static_cast<int>((width - left) / (plot.x.is_whole ? 0.5 : 1.0) / kTickRoom));
  const double half_label = x.ticks().empty() ? 0.0 : text_width(x.ticks().back().label) / 2.0;
  const Area plane{left, top, width - kPlotRoom - half_label, top + height};
  x.place(plane.left, plane.right);
  y.place(plane.bottom, plane.top);
  const XyPainter painter(x, y, plane);
  Drawing drawing{width, plane.bottom + kTickGap + 2.0 * kLineHeight + kTickGap,
                  painter.scales(plot)};
  if (has_title) {
    drawing.elements += svg_text(plane.center(), kLineHeight, plot.title,
                                 {.anchor = Anchor::kMiddle, .most_width = plane.width()});
  }
  std::vector<Colored> legend;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    const Colored colored{series, series.color < 0 ? i : static_cast<std::size_t>(series.color)};
    drawing.elements += painter.drawn(colored);
    if (!series.label.empty()) {
      legend.push_back(colored);
    }
  }
  if (extents.x.empty()) {
    drawing.elements +=
        svg_text(plane.center(), plane.middle(), "no data", {.anchor = Anchor::kMiddle});
  }
  add_legend(drawing, legend, plane.left, plane.right);
  return drawing;
}

}  // namespace handway::report
