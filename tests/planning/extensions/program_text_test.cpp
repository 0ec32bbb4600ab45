#include "handway/planning/extensions/program_text.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>

namespace handway::planning {
namespace {

TEST(FixedDecimals, HaveNoExponentAndNoNegativeZero) {
  EXPECT_EQ(fixed_decimals(1e-9, 6), "0.000000");
  EXPECT_EQ(fixed_decimals(-1e-9, 6), "0.000000");
  EXPECT_EQ(fixed_decimals(-12.3456789, 3), "-12.346");
  EXPECT_EQ(fixed_decimals(123456789.0, 1), "123456789.0");
}

TEST(DurationDecimals, AreNeverShorter) {
  EXPECT_EQ(duration_decimals(0.1234, 3), "0.124");
  EXPECT_EQ(duration_decimals(0.123, 3), "0.123");
  EXPECT_EQ(duration_decimals(0.1 + 0.2, 3), "0.300") << "rounding of a sum does not count";
  EXPECT_EQ(duration_decimals(0.0, 3), "0.000");
}

TEST(PrintableLine, IsOneLineOfAscii) {
  EXPECT_EQ(printable_line("a\nmovej(b)\r\t\"c\"\\"), "a?movej(b)???c??");
  EXPECT_EQ(printable_line("Stäubli"), "St??ubli");
  EXPECT_EQ(printable_line("lift the can", 4), "lift");
}

TEST(ProgramName, KeepsTheRulesOfALanguage) {
  constexpr auto kKeywords = std::to_array<std::string_view>({"end", "def"});
  EXPECT_EQ(program_name("can_on_table", 24, kKeywords), "can_on_table");
  EXPECT_EQ(program_name("End", 24, kKeywords), "hw_End");
  const std::string first = program_name(std::string(30, 'a') + "1", 24, kKeywords);
  const std::string second = program_name(std::string(30, 'a') + "2", 24, kKeywords);
  EXPECT_EQ(first.size(), 24U);
  EXPECT_EQ(first.substr(0, 20), std::string(19, 'a') + "_");
  EXPECT_NE(first, second) << "names that differ only behind the cut";
}

}  // namespace
}  // namespace handway::planning
