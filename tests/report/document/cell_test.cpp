#include "handway/report/document/table.h"

#include <gtest/gtest.h>

#include <limits>

namespace handway::test {
namespace {

using report::Cell;
using report::fixed;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(ReportCell, RoundsNumbersForReadersOnly) {
  EXPECT_EQ(Cell(915.28).text(), "915.3");
  EXPECT_EQ(Cell(0.0013).text(), "0.0013");
  EXPECT_EQ(Cell(0.0).text(), "0");
  EXPECT_EQ(Cell(1234567.8).text(), "1234568");
  EXPECT_EQ(Cell(1234567.8).field(), "1234567.8");
  EXPECT_EQ(Cell(report::Number{.value = 17.93, .digits = report::Digits::kThree}).text(), "17.9");
}

TEST(ReportCell, KeepsFixedDecimalsInFiles) {
  EXPECT_EQ(Cell(fixed(42.1, 2)).text(), "42.10");
  EXPECT_EQ(Cell(fixed(42.1, 2)).field(), "42.10");
}

TEST(ReportCell, TellsMissingFromInfinite) {
  EXPECT_EQ(Cell(kMissing).text(), "-");
  EXPECT_EQ(Cell(kInfinite).text(), "∞");
  EXPECT_EQ(Cell(kMissing).field(), "");
  EXPECT_EQ(Cell(kInfinite).field(), "");
  EXPECT_EQ(Cell(report::percent(kMissing)).text(), "-");
}

TEST(ReportCell, ShowsIntervalsWithTheRoundingOfTheMean) {
  EXPECT_EQ(Cell(report::Estimate{report::percent(0.98), 95.0, 99.2}).text(),
            "98.0 % (95.0 to 99.2)");
  EXPECT_EQ(Cell(report::Estimate{{.value = 12.5}}).text(), "12.50");
  EXPECT_EQ(Cell(report::Estimate{{.value = 12.5}, 11.0, 14.0}).field(), "12.5");
}

TEST(ReportCell, ShowsTimesWithThreeDigits) {
  EXPECT_EQ(report::time_text(0.0125), "12 ms");
  EXPECT_EQ(report::time_text(0.00125), "1.2 ms");
  EXPECT_EQ(report::time_text(1.5), "1.50 s");
  EXPECT_EQ(report::time_text(kInfinite), "∞");
}

TEST(ReportTable, AlignsColumnsOfNumbersToTheRight) {
  const report::Table table{{"name", "count", "both"}, {{"a", 1, 2.0}, {"b", kMissing, "none"}}};
  EXPECT_FALSE(table.is_numeric(0));
  EXPECT_TRUE(table.is_numeric(1));
  EXPECT_FALSE(table.is_numeric(2));
  EXPECT_FALSE(report::Table{{"empty"}}.is_numeric(0));
}

}  // namespace
}  // namespace handway::test
