#include "handway/device/core/line_protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace handway::device {
namespace {

using testing::HasSubstr;

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(LineBuffer, CutsBytesIntoLinesHoweverTheyCome) {
  LineBuffer lines;
  lines.add(bytes_of("one\r\ntw"));
  EXPECT_EQ(lines.next(), "one");
  EXPECT_EQ(lines.next(), std::nullopt);
  lines.add(bytes_of("o\n\nthree\n"));
  EXPECT_EQ(lines.next(), "two");
  lines.add(bytes_of("four"));
  EXPECT_EQ(lines.next(), "");
  EXPECT_EQ(lines.next(), "three");
  EXPECT_EQ(lines.next(), std::nullopt);
}

TEST(LineBuffer, RefusesALineThatIsTooLongWithAndWithoutItsEnd) {
  for (const char* end : {"", "\n"}) {
    LineBuffer lines;
    lines.add(bytes_of("good\n" + std::string(4097, 'x') + end));
    EXPECT_EQ(lines.next(), "good");
    EXPECT_THROW(static_cast<void>(lines.next()), LineProtocolError);
  }
}

// An erasure from the front for each line would take minutes.
TEST(LineBuffer, TakesAsLongForALineOfManyAsOfFew) {
  std::string text;
  for (int k = 0; k < 2'000'000; ++k) {
    text += "line\n";
  }
  const auto begin = std::chrono::steady_clock::now();
  LineBuffer lines;
  lines.add(bytes_of(text));
  int count = 0;
  while (lines.next()) {
    ++count;
  }
  EXPECT_EQ(count, 2'000'000);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
}

TEST(Quote, IsShortAndPlain) {
  EXPECT_EQ(quote("state 1"), "\"state 1\"");
  EXPECT_EQ(quote("\x1b[2J\xff\n"), "\"?[2J??\"");
  EXPECT_LT(quote(std::string(5000, 'x')).size(), 200U);
  EXPECT_THAT(quote(std::string(5000, 'x')), HasSubstr("x...\""));
}

}  // namespace
}  // namespace handway::device
