#include "handway/report/rendering/svg.h"

#include "handway/report/document/escaping.h"
#include "plots/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace handway::report {
namespace {

constexpr double kFigureWidth = 760.0;
constexpr double kLeastPlotWidth = 300.0;

}  // namespace

std::string to_svg(const Figure& figure) {
  const std::size_t columns = static_cast<std::size_t>(std::max(1, figure.columns));
  const double plot_width = std::max(kLeastPlotWidth, kFigureWidth / static_cast<double>(columns));
  double width = columns == 1 ? 0.0 : plot_width * static_cast<double>(columns);
  double height = 0.0;
  double row_height = 0.0;
  std::string content;
  for (std::size_t i = 0; i < figure.plots.size(); ++i) {
    if (i % columns == 0) {
      height += row_height;
      row_height = 0.0;
    }
    const Drawing plot =
        std::visit([&](const auto& data) { return draw(data, plot_width); }, figure.plots[i]);
    const double left = plot_width * static_cast<double>(i % columns);
    content += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">\n{}</g>\n", left, height,
                           plot.elements);
    width = std::max(width, left + plot.width);
    row_height = std::max(row_height, plot.height);
  }
  height += row_height;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\" font-family=\"sans-serif\" "
      "font-size=\"{2:g}\" fill=\"{3}\">\n<title>{4}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{5}</svg>\n",
      std::max(width, 1.0), std::max(height, 1.0), kTextSize, kInk, html_escaped(figure.caption),
      content);
}

}  // namespace handway::report
