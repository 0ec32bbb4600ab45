#include "handway/report/document/escaping.h"

#include <gtest/gtest.h>

namespace handway::test {
namespace {

TEST(ReportEscaping, ShowsHtmlAsText) {
  EXPECT_EQ(report::html_escaped("<b>\"a\" & b</b>\x1b"),
            "&lt;b&gt;&quot;a&quot; &amp; b&lt;/b&gt;\\u001b");
}

TEST(ReportEscaping, ShowsMarksOfMarkdownAsText) {
  EXPECT_EQ(report::markdown_escaped("a|b *c* `d`\n<i> [e](f)"),
            "a\\|b \\*c\\* \\`d\\` &lt;i> [e\\](f)");
}

TEST(ReportEscaping, QuotesFieldsAndDefusesFormulas) {
  EXPECT_EQ(report::csv_field("a, \"b\""), "\"a, \"\"b\"\"\"");
  EXPECT_EQ(report::csv_field("=1+1"), "'=1+1");
  EXPECT_EQ(report::csv_field("-sum"), "'-sum");
  EXPECT_EQ(report::csv_field("-1.5"), "-1.5");
}

TEST(ReportEscaping, EncodesFilesOfLinks) {
  EXPECT_EQ(report::link_target("a b/c).svg"), "a%20b/c%29.svg");
}

}  // namespace
}  // namespace handway::test
