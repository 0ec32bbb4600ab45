#include "handway/report/rendering/csv.h"
#include "handway/report/rendering/html.h"
#include "handway/report/rendering/markdown.h"
#include "handway/report/rendering/report_files.h"
#include "handway/report/rendering/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace handway::test {
namespace {

using report::Document;
using report::Heading;
using report::Paragraph;
using report::Table;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Table planners() {
  return {{"Planner", "runs", {"median", "s"}},
          {{"auto", 10, 0.5}, {"a <b> | c", 2000, report::Number{}}}};
}

TEST(ReportAsText, LinesUpColumns) {
  EXPECT_EQ(report::to_text({planners()}),
            "  Planner    runs  median [s]\n"
            "  auto         10       0.500\n"
            "  a <b> | c  2000           -\n");
}

TEST(ReportAsText, CountsLettersAndShowsControlCharactersAsText) {
  EXPECT_EQ(report::to_text({Table{{"µs", "n"}, {{"ρ∞\x1b", 1}, {"abc", 22}}}}),
            "  µs         n\n"
            "  ρ∞\\u001b   1\n"
            "  abc       22\n");
}

TEST(ReportAsText, WritesRowsOneByOne) {
  const report::TextTable table({{"scene", 8, false}, {{"time", "ms"}, 4}});
  EXPECT_EQ(table.header(), "scene     time [ms]\n");
  EXPECT_EQ(table.row({"desk", 12}), "desk             12\n");
  EXPECT_EQ(table.row({"a long name", 12}), "a long name         12\n");
}

TEST(ReportAsText, PutsEmptyLinesBeforeHeadings) {
  EXPECT_EQ(report::to_text({Paragraph{"one"}, Heading{2, "two"}, Paragraph{"three"}}),
            "one\n\ntwo\nthree\n");
}

TEST(ReportAsMarkdown, AlignsNumbersAndEscapesTexts) {
  EXPECT_EQ(report::to_markdown({Heading{1, "A *title*"}, planners()}),
            "# A \\*title\\*\n\n"
            "| Planner | runs | median [s] |\n"
            "| --- | ---: | ---: |\n"
            "| auto | 10 | 0.500 |\n"
            "| a &lt;b> \\| c | 2000 | - |\n");
}

TEST(ReportAsMarkdown, LinksFiguresAndTheirData) {
  const report::Figure figure{"Times", {}, 1, "times.csv", "drawings/1.svg"};
  EXPECT_EQ(report::to_markdown({figure}),
            "![Times](drawings/1.svg)\n\nTimes: [times.csv](times.csv)\n");
}

TEST(ReportAsHtml, IsOneFileWithEscapedTexts) {
  const std::string html = report::to_html(
      {Heading{1, "<script>"}, planners(), report::Figure{"Times", {report::XyPlot{}}}});
  EXPECT_THAT(html, AllOf(HasSubstr("<title>&lt;script&gt;</title>"), HasSubstr("<td>0.500</td>"),
                          HasSubstr("<td class=\"text\">a &lt;b&gt; | c</td>"), HasSubstr("<svg"),
                          Not(HasSubstr("<script>")), Not(HasSubstr("src="))));
}

TEST(ReportAsHtml, ContainsPictures) {
  const std::filesystem::path folder = testing::TempDir();
  std::ofstream(folder / "picture.png") << "\x89PNG";
  const Document document = {report::Picture{"A hand", "picture.png"}};
  EXPECT_THAT(report::to_html(document, folder),
              HasSubstr("<img src=\"data:image/png;base64,iVBORw==\" alt=\"A hand\">"));
  EXPECT_THAT(report::to_html(document), HasSubstr("<img src=\"picture.png\""));
  EXPECT_THAT(report::to_html({report::Picture{"A hand", "none.png"}}, folder),
              HasSubstr("<img src=\"none.png\""));
}

TEST(ReportAsRichText, AlignsCellsByAttributesAndKeepsNumbersInOneLine) {
  EXPECT_THAT(report::to_rich_text({planners()}),
              AllOf(HasSubstr("<td align=\"right\" style=\"white-space:nowrap\">0.500</td>"),
                    Not(HasSubstr("class"))));
  const Table shares{{"share"}, {{report::Estimate{report::percent(0.98), 95.0, 99.2}}}};
  EXPECT_THAT(report::to_rich_text({shares}), HasSubstr(">98.0 % (95.0–99.2)</td>"));
}

TEST(ReportAsCsv, HasAllDigitsAndEmptyCells) {
  EXPECT_EQ(report::to_csv(
                {{"name", {"time", "s"}}, {{"=a", 1.0 / 3.0}, {"b, c", report::Number{}}, {}}}),
            "name,time [s]\n'=a,0.3333333333333333\n\"b, c\",\n,\n");
}

TEST(ReportAsCsv, OfAnEmptyTableIsItsHeader) { EXPECT_EQ(report::to_csv({{"a", "b"}}), "a,b\n"); }

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ReportFiles, WriteDrawingsBesideTheReport) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "report_files";
  std::filesystem::create_directories(folder);
  report::write_report(
      {Heading{1, "Report"}, report::Figure{"Times", {report::XyPlot{}}, 1, "", "drawings/1.svg"}},
      folder);
  EXPECT_THAT(content_of(folder / "drawings" / "1.svg"), testing::StartsWith("<svg xmlns"));
  EXPECT_THAT(content_of(folder / "report.md"), HasSubstr("](drawings/1.svg)"));
  EXPECT_THAT(content_of(folder / "report.html"), HasSubstr("<svg xmlns"));
}

}  // namespace
}  // namespace handway::test
