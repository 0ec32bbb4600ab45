/// Text from files on its way to terminals and reports.
#include "handway/geometric/io/printable.h"

#include "handway/geometric/io/alike_lines.h"
#include "handway/geometric/io/file_contents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace handway::geometric {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Printable, StaysTheSameIfItIsPlain) {
  for (const char* text : {"", "box 1\n\tat 30°", "Zeit µs", "手", "\U0001F916"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, ShowsWhatSteersATerminal) {
  EXPECT_EQ(printable("\x1B[31mred\x1B[0m"), "\\u001b[31mred\\u001b[0m");
  EXPECT_EQ(printable("a\rb\x07\x08\x7F"), "a\\u000db\\u0007\\u0008\\u007f");
  EXPECT_EQ(printable("\xC2\x9B"
                      "2J"),
            "\\u009b2J");
  EXPECT_EQ(printable("\u202Eevil"), "\\u202eevil");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\u0000b");
  EXPECT_EQ(printable("\xFF\xC3("), "\\ufffd\\ufffd(");
}

TEST(AlikeLines, AreOneWithACount) {
  EXPECT_THAT(
      merged_alike({"joint a_2 is limited to 0.00 to 90.00 degrees: beyond, a_3, which follows it, "
                    "would leave its own limits",
                    "something else that is said once",
                    "joint b_2 is limited to 0.00 to 80.00 degrees: beyond, b_3, which follows it, "
                    "would leave its own limits",
                    "joint c_2 is limited to 0.00 to 80.00 degrees: beyond, c_3, which follows it, "
                    "would leave its own limits"}),
      ElementsAre(testing::AllOf(HasSubstr("joint a_2"), HasSubstr("(2 more alike: b_2, c_2)")),
                  "something else that is said once"));
  EXPECT_THAT(merged_alike({"the robot has no name", "the query has no goal here"}),
              testing::SizeIs(2));
  EXPECT_THAT(merged_alike({}), testing::IsEmpty());
}

TEST(StandIns, AreTold) {
  const auto found = [](const std::string& head) {
    const auto other = stand_in(head);
    return other ? other->found : "";
  };
  EXPECT_THAT(found("version https://git-lfs.github.com/spec/v1\noid sha256:1\nsize 5\n"),
              HasSubstr("git lfs pull"));
  EXPECT_THAT(found("\n<!DOCTYPE html>\n<html>"), HasSubstr("web page"));
  EXPECT_THAT(found("<HTML><body>404"), HasSubstr("web page"));
  EXPECT_THAT(found("/annex/objects/SHA256E-s5--1.stl\n"), HasSubstr("git-annex"));
  EXPECT_THAT(found("PK\x03\x04rest"), HasSubstr("archive"));
  EXPECT_EQ(found("solid cube"), "");
  EXPECT_EQ(found("<robot name=\"a\"/>"), "");
  EXPECT_EQ(found(""), "");
}

}  // namespace
}  // namespace handway::geometric
