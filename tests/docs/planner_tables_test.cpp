#include "planner_tables.h"

#include "handway_test/paths.h"
#include "markdown.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace handway::test {
namespace {

// With HANDWAY_UPDATE_DOCS set the page is brought up to date.
TEST(PlannerManual, HasTheParametersOfEveryPlanner) {
  const std::filesystem::path file = source_dir() / "docs" / "planners.md";
  const std::string page = read_text(file);
  const std::string expected = with_tables(page, planner_tables(planning::PlannerRegistry()));
  if (std::getenv("HANDWAY_UPDATE_DOCS") != nullptr) {
    std::ofstream(file, std::ios::binary) << expected;
    return;
  }
  EXPECT_EQ(page, expected)
      << "docs/planners.md is out of date: run build/release/tests/test_docs with "
         "HANDWAY_UPDATE_DOCS=1";
}

TEST(PlannerTables, ReplaceOnlyWhatIsBetweenTheMarks) {
  EXPECT_EQ(with_tables("a\n<!-- tables -->\nold\n<!-- end of tables -->\nb\n", "new\n"),
            "a\n<!-- tables -->\nnew\n<!-- end of tables -->\nb\n");
  EXPECT_THROW(static_cast<void>(with_tables("a\n", "new\n")), std::runtime_error);
}

}  // namespace
}  // namespace handway::test
