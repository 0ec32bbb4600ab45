#include "plots/axis_scale.h"
#include "plots/plots.h"

#include <fmt/format.h>

#include <algorithm>

namespace handway::report {
namespace {

constexpr double kBoxRow = 26.0;
constexpr double kHalfBox = 8.0;
constexpr double kBoxGap = 8.0;
constexpr double kMostLabel = 0.4;  // of the width
constexpr double kBoxTick = 80.0;

bool has_box(const Box& box) {
  return is_drawn(box.lower_whisker) && is_drawn(box.lower_quartile) && is_drawn(box.median) &&
         is_drawn(box.upper_quartile) && is_drawn(box.upper_whisker);
}

std::vector<double> values_of(const BoxPlot& plot) {
  std::vector<double> values;
  for (const Box& box : plot.boxes) {
    if (has_box(box)) {
      values.insert(values.end(), {box.lower_whisker, box.upper_whisker});
    }
    values.insert(values.end(), box.outliers.begin(), box.outliers.end());
  }
  return values;
}

std::string box_svg(const AxisScale& scale, const Box& box, std::size_t index, double middle) {
  const std::string_view color = series_color(index);
  std::string svg;
  if (has_box(box)) {
    const double left = scale.at(box.lower_quartile);
    const double right = std::max(left + 1.0, scale.at(box.upper_quartile));
    const double median = scale.at(box.median);
    svg +=
        svg_line(scale.at(box.lower_whisker), middle, scale.at(box.upper_whisker), middle, color);
    svg += svg_rectangle({left, middle - kHalfBox, right, middle + kHalfBox}, "#fff", color);
    svg += svg_line(median, middle - kHalfBox, median, middle + kHalfBox, color, 3.0);
  }
  for (const double outlier : box.outliers) {
    if (is_drawn(outlier)) {
      svg +=
          fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\" fill=\"none\" stroke=\"{}\"/>\n",
                      scale.at(outlier), middle, color);
    }
  }
  return svg;
}

}  // namespace

Drawing draw(const BoxPlot& plot, double width) {
  double labels = 0.0;
  for (const Box& box : plot.boxes) {
    labels = std::max(labels, text_width(box.label));
  }
  labels = std::min(labels, kMostLabel * width);
  const auto rows = static_cast<double>(std::max<std::size_t>(plot.boxes.size(), 1));
  const double left = labels + 2.0 * kBoxGap;
  const std::vector<double> values = values_of(plot);
  AxisScale scale(plot.values, values, static_cast<int>((width - left) / kBoxTick));
  const Area plane{left, kBoxGap, width - std::max(2.0 * kBoxGap, scale.label_width() / 2.0),
                   kBoxGap + kBoxRow * rows};
  scale.place(plane.left, plane.right);
  std::string svg;
  for (const AxisScale::Tick& tick : scale.ticks()) {
    const double at = scale.at(tick.value);
    svg += svg_line(at, plane.top, at, plane.bottom, kGrid);
    svg += svg_text(at, plane.bottom + kLineHeight, tick.label, {.anchor = Anchor::kMiddle});
  }
  svg += svg_text(plane.center(), plane.bottom + 2.0 * kLineHeight, axis_title(plot.values),
                  {.anchor = Anchor::kMiddle, .most_width = plane.width()});
  for (std::size_t i = 0; i < plot.boxes.size(); ++i) {
    const double middle = plane.top + kBoxRow * (static_cast<double>(i) + 0.5);
    svg += "<g class=\"series\">\n";
    svg += svg_text(plane.left - kBoxGap, middle + 4.0, plot.boxes[i].label,
                    {.anchor = Anchor::kEnd, .most_width = labels});
    svg += box_svg(scale, plot.boxes[i], i, middle) + "</g>\n";
  }
  if (std::ranges::none_of(values, is_drawn)) {
    svg += svg_text(plane.center(), plane.middle() + 4.0, "no data", {.anchor = Anchor::kMiddle});
  }
  return {width, plane.bottom + 2.0 * kLineHeight + kBoxGap, svg};
}

}  // namespace handway::report
