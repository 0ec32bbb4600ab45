#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

/// @file
/// Figures as data: rendering/svg.h draws them.
namespace handway::report {

/// Axis of a plot.
struct Axis {
  std::string title;
  std::string unit = {};  ///< May be empty.
  bool is_logarithmic = false;
  bool is_whole = false;                                    ///< Ticks are at whole numbers.
  double least = std::numeric_limits<double>::quiet_NaN();  ///< NaN: chosen from the data.
  double most = std::numeric_limits<double>::quiet_NaN();   ///< NaN: chosen from the data.
};

/// Drawing of a series.
enum class Mark {
  kLine,
  kPoints,  ///< A line with a circle at each point.
  kSteps,   ///< A line that goes across, then up, and to the end of the plot at last.
  kDots,    ///< No line.
  kBars,    ///< Bars from 0, centred on their points, for whole numbers across.
};

/// Points of one kind. Points with a number that is not finite are left out; lines end there.
struct Series {
  std::string label;  ///< In the legend; empty: not listed there.
  Mark mark = Mark::kLine;
  std::vector<double> x = {};
  std::vector<double> y = {};
  std::vector<double> low = {};         ///< Lower ends of a band about the line; empty: none.
  std::vector<double> high = {};        ///< Upper ends of the band.
  std::vector<std::string> notes = {};  ///< Texts beside the first points; may be empty.
  int color = -1;                       ///< Index of its colour; -1: that of its place.
};

/// Series over two axes.
struct XyPlot {
  std::string title;  ///< Above the plot; may be empty.
  Axis x;
  Axis y;
  std::vector<Series> series;
};

/// Values of one box of a box plot.
struct Box {
  std::string label;
  double lower_whisker = std::numeric_limits<double>::quiet_NaN();  ///< NaN: only a label.
  double lower_quartile = std::numeric_limits<double>::quiet_NaN();
  double median = std::numeric_limits<double>::quiet_NaN();
  double upper_quartile = std::numeric_limits<double>::quiet_NaN();
  double upper_whisker = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> outliers = {};
};

/// Boxes below each other.
struct BoxPlot {
  Axis values;
  std::vector<Box> boxes;
};

/// A field of a heat map.
struct Tile {
  double seconds = std::numeric_limits<double>::quiet_NaN();  ///< NaN: empty. Infinite: slowest.
  std::string note = {};                                      ///< Below the time; may be empty.
};

/// Times over two parameters as colours on a logarithmic scale and as numbers, the least in bold.
struct HeatMap {
  std::string x;  ///< Parameter across.
  std::string y;  ///< Parameter upwards.
  std::vector<std::string> x_values;
  std::vector<std::string> y_values;
  std::vector<Tile> tiles;  ///< Index of y · size of x_values + x, all of them.
};

using Plot = std::variant<XyPlot, BoxPlot, HeatMap>;  ///< A plot of any kind.

/// A figure of one or several plots, row by row.
struct Figure {
  std::string caption;
  std::vector<Plot> plots;
  int columns = 1;
  std::string data_file = {};  ///< File with its numbers, beside the report; may be empty.
  std::string file = {};       ///< File of the drawing (SVG), beside the report; may be empty.
};

/// A picture in a file of its own.
struct Picture {
  std::string caption;
  std::string file;  ///< PNG, beside the report.
};

}  // namespace handway::report
