/// Drawings of figures: well-formed, complete, readable.
#include "handway/report/rendering/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace handway::test {
namespace {

using report::BoxPlot;
using report::Figure;
using report::HeatMap;
using report::Mark;
using report::XyPlot;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::Ge;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Le;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// A drawing that was read back; a test fails if it is not well-formed.
class Svg {
 public:
  explicit Svg(const report::Plot& plot) : Svg(Figure{"A figure", {plot}}) {}
  explicit Svg(const Figure& figure) : text_(report::to_svg(figure)) {
    const pugi::xml_parse_result result = document_.load_string(text_.c_str());
    EXPECT_TRUE(result) << result.description() << '\n' << text_;
  }

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] pugi::xml_node root() const { return document_.child("svg"); }
  [[nodiscard]] std::size_t count(const char* path) const {
    return document_.select_nodes(path).size();
  }
  /// Texts that are seen, without tips.
  [[nodiscard]] std::vector<std::string> labels() const {
    std::vector<std::string> labels;
    for (const pugi::xpath_node& node : document_.select_nodes("//text/text()")) {
      labels.emplace_back(node.node().value());
    }
    return labels;
  }
  /// Numbers of all points of lines: across, upwards, across, …
  [[nodiscard]] std::vector<double> points() const {
    std::vector<double> numbers;
    for (const pugi::xpath_node& node : document_.select_nodes("//polyline")) {
      std::string list = node.node().attribute("points").value();
      for (std::size_t begin = 0; begin < list.size();) {
        std::size_t used = 0;
        numbers.push_back(std::stod(list.substr(begin), &used));
        begin += used + 1;
      }
    }
    return numbers;
  }

 private:
  std::string text_;
  pugi::xml_document document_;
};

XyPlot two_lines() {
  return {"Two lines",
          {"time", "s"},
          {"error", "mm"},
          {{"first", Mark::kLine, {0, 1, 2}, {1, 4, 2}},
           {"second", Mark::kPoints, {0, 1, 2}, {2, 3, 4}}}};
}

TEST(ReportPlot, HasASeriesEachAndUnitsAtTheAxes) {
  const Svg svg(two_lines());
  EXPECT_EQ(svg.count("//g[@class='series']"), 2U);
  EXPECT_EQ(svg.count("//polyline"), 2U);
  EXPECT_THAT(svg.labels(), IsSupersetOf({"Two lines", "time [s]", "error [mm]", "first", "second",
                                          "0.0", "2.0"}));
}

TEST(ReportPlot, IsDarkOnWhite) {
  const Svg svg(two_lines());
  EXPECT_STREQ(svg.root().attribute("fill").value(), "#222");
  EXPECT_STREQ(svg.root().child("rect").attribute("fill").value(), "#fff");
  EXPECT_STREQ(svg.root().child("rect").attribute("width").value(), "100%");
}

TEST(ReportPlot, LeavesOutWhatHasNoPlaceAndEndsTheLineThere) {
  const Svg svg(XyPlot{"",
                       {"x"},
                       {"y"},
                       {{"", Mark::kLine, {0, 1, 2, 3, 4, 5}, {1, 2, kNan, 3, 2, kInf}},
                        {"", Mark::kDots, {kNan, 1}, {1, 1e300}}}});
  EXPECT_EQ(svg.count("//polyline"), 2U);
  EXPECT_EQ(svg.count("//circle"), 0U);
  EXPECT_THAT(svg.text(), AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
}

TEST(ReportPlot, SaysThatItHasNoData) {
  EXPECT_THAT(Svg(XyPlot{"", {"x"}, {"y"}, {{"none", Mark::kLine, {}, {}}}}).labels(),
              Contains("no data"));
  EXPECT_THAT(Svg(BoxPlot{{"time", "s"}, {{.label = "never solved"}}}).labels(),
              IsSupersetOf({"no data", "never solved", "time [s]"}));
  EXPECT_THAT(Svg(BoxPlot{}).labels(), Contains("no data"));
  EXPECT_THAT(Svg(HeatMap{}).labels(), Contains("no data"));
  EXPECT_EQ(Svg(Figure{}).count("//text"), 0U);
}

TEST(ReportPlot, KeepsItsPointsInThePicture) {
  XyPlot plot = two_lines();
  plot.series[0].y = {-1e99, 0.0, 1e99};
  plot.y.least = 0.0;
  const Svg svg(plot);
  EXPECT_THAT(svg.points(), Each(AllOf(Ge(0.0), Le(svg.root().attribute("width").as_double()))));
}

TEST(ReportPlot, HasATickForAConstantAndForTinyAndHugeNumbers) {
  for (const double value : {0.0, 5.0, -3e-12, 7e12}) {
    const Svg svg(XyPlot{"", {"x"}, {"y"}, {{"", Mark::kLine, {0, 1}, {value, value}}}});
    EXPECT_GE(svg.labels().size(), 6U) << value;
    EXPECT_THAT(svg.points(), Each(Ge(0.0))) << value;
  }
}

TEST(ReportPlot, HasWholeDecadesOnALogarithmicAxis) {
  const Svg svg(XyPlot{"",
                       {.title = "time", .unit = "s", .is_logarithmic = true},
                       {"runs", "%"},
                       {{"steps", Mark::kSteps, {0.0, 0.02, 3.0}, {0, 50, 100}}}});
  EXPECT_THAT(svg.labels(), IsSupersetOf({"0.01", "0.1", "1", "10"}));
  EXPECT_THAT(svg.text(), AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
}

TEST(ReportPlot, CutsLongNamesAndEscapesThem) {
  const std::string name = std::string(300, 'n') + "<&\"ü>";
  XyPlot plot = two_lines();
  plot.title = plot.x.title = plot.y.title = plot.series[0].label = name;
  const Svg svg(plot);
  EXPECT_EQ(svg.count("//text/title"), 4U);
  EXPECT_THAT(svg.root().select_node("//text/title").node().child_value(), HasSubstr(name));
  const Svg boxes(BoxPlot{{name}, {{.label = name}}});
  EXPECT_EQ(boxes.count("//text/title"), 2U);
  const Svg map(HeatMap{name, name, {name}, {name}, {{1.0, name}}});
  EXPECT_EQ(map.count("//text/title"), 5U);
  for (const Svg* one : {&svg, &boxes, &map}) {
    for (const std::string& label : one->labels()) {
      EXPECT_LE(label.size(), 110U) << label;
    }
  }
}

TEST(ReportPlot, DrawsBandsBarsAndNotes) {
  const Svg svg(XyPlot{"",
                       {.title = "n", .is_whole = true},
                       {"share", "%"},
                       {{"each", Mark::kBars, {1, 2}, {60, 30}},
                        {"sum", Mark::kPoints, {1, 2}, {60, 90}, {50, 80}, {70, 95}, {"60 %"}}}});
  EXPECT_EQ(svg.count("//g[@class='series']//rect"), 2U);
  EXPECT_EQ(svg.count("//polygon"), 1U);
  EXPECT_THAT(svg.labels(), IsSupersetOf({"60 %", "each", "sum", "1", "2"}));
}

TEST(ReportBoxPlot, HasABoxEachAndItsOutliers) {
  const Svg svg(BoxPlot{
      {.title = "time", .unit = "s", .is_logarithmic = true},
      {{"auto", 0.1, 0.2, 0.3, 0.4, 0.5, {2.0, 3.0}}, {"slow", 1.0, 1.0, 1.0, 1.0, 1.0, {}}}});
  EXPECT_EQ(svg.count("//g[@class='series']"), 2U);
  EXPECT_EQ(svg.count("//g[@class='series']/rect"), 2U);
  EXPECT_EQ(svg.count("//circle"), 2U);
  EXPECT_THAT(svg.labels(), IsSupersetOf({"auto", "slow", "time [s]", "0.1", "1"}));
}

TEST(ReportHeatMap, HasATimeForEachTile) {
  const Svg svg(HeatMap{"n_a", "k", {"5", "10"}, {"3"}, {{0.0125, ""}, {kInf, "0.0 % solved"}}});
  EXPECT_THAT(svg.labels(),
              IsSupersetOf({"n_a", "k", "5", "10", "3", "12 ms", "∞", "0.0 % solved", "25 ms"}));
  EXPECT_EQ(svg.count("//text[@font-weight='bold']"), 3U) << "the axes and the least time";
}

TEST(ReportFigure, PutsPlotsSideBySide) {
  const Svg one(Figure{"Four", {two_lines()}, 2});
  const Svg four(Figure{"Four", {two_lines(), two_lines(), two_lines(), two_lines()}, 2});
  EXPECT_EQ(four.count("//g[@class='series']"), 8U);
  EXPECT_EQ(four.root().attribute("width").as_double(), one.root().attribute("width").as_double());
  EXPECT_NEAR(four.root().attribute("height").as_double(),
              2.0 * one.root().attribute("height").as_double(), 1.0);
}

}  // namespace
}  // namespace handway::test
