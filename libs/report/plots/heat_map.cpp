#include "handway/report/document/cell.h"
#include "plots/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace handway::report {
namespace {

constexpr double kTileWidth = 92.0;
constexpr double kTileHeight = 44.0;
constexpr double kMapTop = 12.0;
constexpr double kMapGap = 8.0;
constexpr double kMapFoot = 48.0;
constexpr double kMostRowLabel = 200.0;
constexpr double kScaleWidth = 14.0;
constexpr double kScaleGap = 24.0;   // from the tiles
constexpr double kScaleRoom = 70.0;  // for the scale's numbers
constexpr double kLeastRatio = 2.0;  // of the times at the colours' ends

using Rgb = std::array<double, 3>;

// Light to dark, perceptually even, also for viewers who see few colours (from ColorBrewer's
// YlGnBu).
constexpr std::array<Rgb, 5> kScaleColors = {
    {{255, 255, 204}, {161, 218, 180}, {65, 182, 196}, {44, 127, 184}, {37, 52, 148}}};

std::string color_at(double share) {
  const double position = std::clamp(share, 0.0, 1.0) * (kScaleColors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(position), kScaleColors.size() - 2);
  const double part = position - static_cast<double>(below);
  std::array<double, 3> mixed{};
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    mixed.at(i) = std::lerp(kScaleColors.at(below).at(i), kScaleColors.at(below + 1).at(i), part);
  }
  return fmt::format("rgb({:.0f},{:.0f},{:.0f})", mixed[0], mixed[1], mixed[2]);
}

/// Times on a logarithmic scale of colours.
class TimeColors {
 public:
  explicit TimeColors(const std::vector<Tile>& tiles) {
    for (const Tile& tile : tiles) {
      if (std::isfinite(tile.seconds) && tile.seconds > 0.0) {
        fastest_ = std::min(fastest_, tile.seconds);
        slowest_ = std::max(slowest_, tile.seconds);
      }
    }
    if (slowest_ < kLeastRatio * fastest_) {  // small differences stay pale
      slowest_ = kLeastRatio * fastest_;
    }
  }

  [[nodiscard]] bool has_times() const { return std::isfinite(fastest_); }
  [[nodiscard]] double fastest() const { return fastest_; }
  [[nodiscard]] double slowest() const { return slowest_; }  ///< Upper end of the scale.

  /// Returns the share of the scale: 0 for the least time, 1 for the most, and for infinite ones.
  [[nodiscard]] double share(double time) const {
    if (!std::isfinite(time)) {
      return 1.0;
    }
    return time > 0.0 ? std::log(time / fastest_) / std::log(slowest_ / fastest_) : 0.0;
  }

 private:
  double fastest_ = std::numeric_limits<double>::infinity();
  double slowest_ = 0.0;
};

std::string tile_svg(const Tile& tile, const TimeColors& colors, const Area& area) {
  if (std::isnan(tile.seconds)) {
    return svg_rectangle(area, "none", kGrid);
  }
  constexpr double kDark = 0.55;
  const double share = colors.share(tile.seconds);
  const std::string_view ink = share > kDark ? "#fff" : "#000";
  const bool has_note = !tile.note.empty();
  std::string svg = svg_rectangle(area, color_at(share), "#fff");
  svg += svg_text(area.center(), area.top + (has_note ? 19.0 : 27.0), time_text(tile.seconds),
                  {.anchor = Anchor::kMiddle,
                   .is_bold = tile.seconds == colors.fastest(),
                   .color = ink,
                   .most_width = area.width()});
  if (has_note) {
    svg += svg_text(
        area.center(), area.top + 36.0, tile.note,
        {.anchor = Anchor::kMiddle, .size = 11.0, .color = ink, .most_width = area.width()});
  }
  return svg;
}

// The scale of colours, slow above fast. Its parts overlap, so that no gaps shine through.
std::string color_scale(const TimeColors& colors, double x, double bottom) {
  constexpr int kParts = 64;
  const double part = (bottom - kMapTop) / kParts;
  std::string svg;
  for (int i = 0; i < kParts; ++i) {
    svg += svg_rectangle({x, kMapTop + i * part, x + kScaleWidth, bottom},
                         color_at(1.0 - (i + 0.5) / kParts));
  }
  svg += svg_rectangle({x, kMapTop, x + kScaleWidth, bottom}, "none", kFrame);
  const double beside = x + kScaleWidth + 6.0;
  return svg + svg_text(beside, kMapTop + 11.0, time_text(colors.slowest())) +
         svg_text(beside, bottom - 1.0, time_text(colors.fastest()));
}

}  // namespace

Drawing draw(const HeatMap& map, double /*width*/) {
  const std::size_t columns = map.x_values.size();
  const std::size_t rows = map.y_values.size();
  double labels = 0.0;
  for (const std::string& value : map.y_values) {
    labels = std::max(labels, text_width(value));
  }
  labels = std::min(labels, kMostRowLabel);
  const double left = kMapGap + kLineHeight + labels + 2.0 * kMapGap;
  const double right = left + kTileWidth * static_cast<double>(std::max<std::size_t>(columns, 1));
  const double bottom = kMapTop + kTileHeight * static_cast<double>(std::max<std::size_t>(rows, 1));
  const Area plane{left, kMapTop, right, bottom};
  const TimeColors colors(map.tiles);
  std::string svg;
  for (std::size_t i = 0; i < std::min(map.tiles.size(), rows * columns); ++i) {
    const double x = left + kTileWidth * static_cast<double>(i % columns);
    const std::size_t row = i / columns + 1;
    const double y = bottom - kTileHeight * static_cast<double>(row);
    svg += tile_svg(map.tiles[i], colors, {x, y, x + kTileWidth, y + kTileHeight});
  }
  if (colors.has_times()) {
    svg += color_scale(colors, right + kScaleGap, bottom);
  } else if (map.tiles.empty()) {
    svg += svg_rectangle(plane, "none", kGrid);
    svg += svg_text(plane.center(), plane.middle() + 4.0, "no data", {.anchor = Anchor::kMiddle});
  }
  for (std::size_t i = 0; i < columns; ++i) {
    svg += svg_text(left + kTileWidth * (static_cast<double>(i) + 0.5), bottom + kLineHeight,
                    map.x_values[i], {.anchor = Anchor::kMiddle, .most_width = kTileWidth});
  }
  for (std::size_t i = 0; i < rows; ++i) {
    svg += svg_text(left - kMapGap, bottom - kTileHeight * (static_cast<double>(i) + 0.5) + 5.0,
                    map.y_values[i], {.anchor = Anchor::kEnd, .most_width = labels});
  }
  svg += svg_text(plane.center(), bottom + 38.0, map.x,
                  {.anchor = Anchor::kMiddle, .is_bold = true, .most_width = plane.width()});
  svg += svg_upright(kMapGap + kTextSize, plane.middle(), map.y,
                     {.anchor = Anchor::kMiddle, .is_bold = true, .most_width = plane.height()});
  return {right + kScaleGap + kScaleWidth + kScaleRoom, bottom + kMapFoot, svg};
}

}  // namespace handway::report
