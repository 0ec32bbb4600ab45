#include "campaign_report.h"
#include "handway/geometric/io/number_text.h"
#include "numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

using planning::CampaignCell;

constexpr double kCellWidth = 92.0;
constexpr double kCellHeight = 44.0;
constexpr double kLeft = 130.0;
constexpr double kTop = 12.0;
constexpr double kFoot = 48.0;
constexpr double kScaleWidth = 14.0;  // width of the scale of colours, …
constexpr double kScaleGap = 24.0;    // … from the cells, and …
constexpr double kScaleRoom = 70.0;   // … for its numbers
constexpr double kLeastRatio = 2.0;   // ratio of times at the colours' ends

using Rgb = std::array<double, 3>;

// Light to dark, perceptually even, also for viewers who see few colours (from ColorBrewer's
// YlGnBu).
constexpr std::array<Rgb, 5> kScale = {
    {{255, 255, 204}, {161, 218, 180}, {65, 182, 196}, {44, 127, 184}, {37, 52, 148}}};

Rgb color_at(double share) {
  const double position = std::clamp(share, 0.0, 1.0) * (kScale.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(position), kScale.size() - 2);
  const double part = position - static_cast<double>(below);
  Rgb mixed{};
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    mixed.at(i) = std::lerp(kScale.at(below).at(i), kScale.at(below + 1).at(i), part);
  }
  return mixed;
}

/// Times on a logarithmic scale of colours.
class TimeColors {
 public:
  explicit TimeColors(const std::vector<double>& times) {
    for (const double time : times) {
      if (std::isfinite(time) && time > 0.0) {
        least_ = std::min(least_, time);
        most_ = std::max(most_, time);
      }
    }
    if (most_ < kLeastRatio * least_) {  // small differences stay pale
      most_ = kLeastRatio * least_;
    }
  }

  [[nodiscard]] bool any() const { return most_ > 0.0; }
  [[nodiscard]] double fastest() const { return least_; }
  [[nodiscard]] double slowest() const { return most_; }  ///< Upper end of the scale.

  /// Share of the scale: 0 for the least time, 1 for the most, and for infinite ones.
  [[nodiscard]] double share(double time) const {
    return std::isfinite(time) ? std::log(time / least_) / std::log(most_ / least_) : 1.0;
  }

 private:
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = 0.0;
};

// Formats three digits, in milliseconds below a second.
std::string time_text(double time) {
  constexpr double kMilli = 1e-3;
  const bool small = time < 1.0;
  const double value = small ? time / kMilli : time;
  const int decimals = value < 1.0 || (!small && value < 10.0) ? 2 : value < 10.0 ? 1 : 0;
  return fmt::format("{:.{}f} {}", value, decimals, small ? "ms" : "s");
}

double median_time(const CampaignCell& cell) {
  return cell.runs.empty() ? std::numeric_limits<double>::quiet_NaN()
                           : planning::quantile_of(cell.times(), 0.5);
}

std::string field(const CampaignCell& cell, const TimeColors& colors, double x, double y) {
  const double time = median_time(cell);
  if (std::isnan(time)) {
    return fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#ddd\"/>\n", x,
        y, kCellWidth, kCellHeight);
  }
  const double share = colors.share(time);
  const Rgb fill = color_at(share);
  const char* ink = share > 0.55 ? "#fff" : "#000";
  const double middle = x + kCellWidth / 2.0;
  const bool all = cell.solved() == cell.runs.size();
  std::string svg = fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"rgb({:.0f},{:.0f},{:.0f})\" "
      "stroke=\"#fff\"/><text x=\"{}\" y=\"{}\" text-anchor=\"middle\" "
      "style=\"fill:{};font-weight:{}\">{}</text>",
      x, y, kCellWidth, kCellHeight, fill[0], fill[1], fill[2], middle, y + (all ? 27.0 : 19.0),
      ink, time == colors.fastest() ? "bold" : "normal",
      std::isfinite(time) ? time_text(time) : "∞");
  if (!all) {
    svg += fmt::format(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" style=\"font-size:11px;fill:{}\">{} "
        "solved</text>",
        middle, y + 36.0, ink,
        percent_text(static_cast<double>(cell.solved()) / static_cast<double>(cell.runs.size())));
  }
  return svg + '\n';
}

// The scale of colours, slow above fast.
std::string scale(const TimeColors& colors, double x, double bottom) {
  std::string svg = "<defs><linearGradient id=\"times\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">";
  for (std::size_t i = 0; i < kScale.size(); ++i) {
    svg += fmt::format("<stop offset=\"{}\" stop-color=\"rgb({:.0f},{:.0f},{:.0f})\"/>",
                       static_cast<double>(i) / (kScale.size() - 1), kScale.at(i)[0],
                       kScale.at(i)[1], kScale.at(i)[2]);
  }
  svg += fmt::format(
      "</linearGradient></defs>\n<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" "
      "fill=\"url(#times)\" stroke=\"#888\"/>\n",
      x, kTop, kScaleWidth, bottom - kTop);
  const double beside = x + kScaleWidth + 6.0;
  return svg +
         fmt::format("<text x=\"{0}\" y=\"{1}\">{2}</text><text x=\"{0}\" y=\"{3}\">{4}</text>\n",
                     beside, kTop + 11.0, time_text(colors.slowest()), bottom - 1.0,
                     time_text(colors.fastest()));
}

}  // namespace

std::string heat_map_svg(const ParameterGrid& grid, std::span<const CampaignCell> cells) {
  const std::size_t columns = grid.x_values.size();
  const std::size_t rows = grid.y_values.size();
  std::vector<double> times;
  times.reserve(grid.planners.size());
  for (const std::size_t planner : grid.planners) {
    times.push_back(median_time(cells[planner]));
  }
  const TimeColors colors(times);
  const double bottom = kTop + kCellHeight * static_cast<double>(rows);
  const double right = kLeft + kCellWidth * static_cast<double>(columns);
  std::string svg;
  for (std::size_t i = 0; i < grid.planners.size(); ++i) {
    const std::size_t row = i / columns + 1;
    svg += field(cells[grid.planners[i]], colors,
                 kLeft + kCellWidth * static_cast<double>(i % columns),
                 bottom - kCellHeight * static_cast<double>(row));
  }
  if (colors.any()) {
    svg += scale(colors, right + kScaleGap, bottom);
  }
  for (std::size_t i = 0; i < columns; ++i) {
    svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                       kLeft + kCellWidth * (static_cast<double>(i) + 0.5), bottom + 18.0,
                       html_escaped(grid.x_values[i]));
  }
  for (std::size_t i = 0; i < rows; ++i) {
    svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", kLeft - 8.0,
                       bottom - kCellHeight * (static_cast<double>(i) + 0.5) + 5.0,
                       html_escaped(grid.y_values[i]));
  }
  svg += fmt::format(
      "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" style=\"font-weight:bold\">{}</text>\n",
      (kLeft + right) / 2.0, bottom + 38.0, html_escaped(grid.x));
  svg += fmt::format(
      "<text transform=\"translate(24 {}) rotate(-90)\" text-anchor=\"middle\" "
      "style=\"font-weight:bold\">{}</text>\n",
      (kTop + bottom) / 2.0, html_escaped(grid.y));
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\">\n{2}</svg>",
      right + kScaleGap + kScaleWidth + kScaleRoom, bottom + kFoot, svg);
}

namespace {

using planning::Campaign;
using planning::CampaignPlanner;
using planning::ParameterTexts;

// Sorts numbers by their size, before words.
bool comes_first(const std::string& a, const std::string& b) {
  const std::optional<double> left = geometric::parse_number(a);
  const std::optional<double> right = geometric::parse_number(b);
  if (left && right) {
    return *left < *right;
  }
  return left.has_value() != right.has_value() ? left.has_value() : a < b;
}

std::vector<std::string> sorted(const std::set<std::string>& values) {
  std::vector<std::string> list(values.begin(), values.end());
  std::ranges::sort(list, comes_first);
  return list;
}

/// Entries that differ in parameters `x` and `y` alone, by their values.
using Sheet = std::map<std::pair<std::string, std::string>, std::size_t>;

std::vector<Sheet> sheets_of(const Campaign& campaign, const std::string& planner, std::size_t x,
                             std::size_t y) {
  std::map<ParameterTexts, Sheet> by_rest;
  for (std::size_t i = 0; i < campaign.planners.size(); ++i) {
    const CampaignPlanner& entry = campaign.planners[i];
    if (entry.planner == planner) {
      ParameterTexts rest = entry.parameters;
      rest[x].second.clear();
      rest[y].second.clear();
      by_rest[rest][{entry.parameters[x].second, entry.parameters[y].second}] = i;
    }
  }
  std::vector<Sheet> sheets;
  sheets.reserve(by_rest.size());
  for (auto& [rest, sheet] : by_rest) {
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

// Removes rows and columns that lack a combination, the emptiest first.
std::optional<ParameterGrid> grid_of(const Sheet& sheet) {
  std::set<std::string> xs;
  std::set<std::string> ys;
  for (const auto& [values, index] : sheet) {
    xs.insert(values.first);
    ys.insert(values.second);
  }
  const auto count_x = [&](const std::string& x) {
    return std::ranges::count_if(ys, [&](const std::string& y) { return sheet.contains({x, y}); });
  };
  const auto count_y = [&](const std::string& y) {
    return std::ranges::count_if(xs, [&](const std::string& x) { return sheet.contains({x, y}); });
  };
  while (xs.size() > 1 && ys.size() > 1) {
    const std::string x = *std::ranges::min_element(xs, {}, count_x);
    const std::string y = *std::ranges::min_element(ys, {}, count_y);
    const double full_x = static_cast<double>(count_x(x)) / static_cast<double>(ys.size());
    const double full_y = static_cast<double>(count_y(y)) / static_cast<double>(xs.size());
    if (full_x == 1.0 && full_y == 1.0) {
      break;
    }
    if (full_x <= full_y) {
      xs.erase(x);
    } else {
      ys.erase(y);
    }
  }
  if (xs.size() < 2 || ys.size() < 2) {
    return std::nullopt;
  }
  ParameterGrid grid;
  grid.x_values = sorted(xs);
  grid.y_values = sorted(ys);
  for (const std::string& y : grid.y_values) {
    for (const std::string& x : grid.x_values) {
      grid.planners.push_back(sheet.at({x, y}));
    }
  }
  return grid;
}

}  // namespace

std::vector<ParameterGrid> parameter_grids(const Campaign& campaign) {
  std::vector<ParameterGrid> grids;
  std::set<std::string> seen;
  for (const CampaignPlanner& first : campaign.planners) {
    if (!seen.insert(first.planner).second) {
      continue;
    }
    for (std::size_t x = 0; x < first.parameters.size(); ++x) {
      for (std::size_t y = x + 1; y < first.parameters.size(); ++y) {
        for (const Sheet& sheet : sheets_of(campaign, first.planner, x, y)) {
          if (std::optional<ParameterGrid> grid = grid_of(sheet)) {
            grid->planner = first.planner;
            grid->x = first.parameters[x].first;
            grid->y = first.parameters[y].first;
            grids.push_back(std::move(*grid));
          }
        }
      }
    }
  }
  return grids;
}

ReportTable heat_map_table(const Campaign& campaign, std::span<const ParameterGrid> grids,
                           std::span<const CampaignCell> cells) {
  ReportTable table{{"problem", "planner", "label", "x", "x_value", "y", "y_value", "runs",
                     "solved", "median_time_s"},
                    {}};
  for (std::size_t begin = 0; begin < cells.size(); begin += campaign.planners.size()) {
    for (const ParameterGrid& grid : grids) {
      for (std::size_t i = 0; i < grid.planners.size(); ++i) {
        const CampaignCell& cell = cells[begin + grid.planners[i]];
        table.rows.push_back(
            {campaign.problems[static_cast<std::size_t>(cell.problem)].name, grid.planner,
             campaign.planners[grid.planners[i]].label, grid.x,
             grid.x_values[i % grid.x_values.size()], grid.y,
             grid.y_values[i / grid.x_values.size()], fmt::format("{}", cell.runs.size()),
             fmt::format("{}", cell.solved()),
             cell.runs.empty() ? "" : seconds_field(planning::quantile_of(cell.times(), 0.5))});
      }
    }
  }
  return table;
}

}  // namespace handway::tools
