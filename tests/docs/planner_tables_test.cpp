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
void expect_tables(const char* name, const std::string& tables) {
  const std::filesystem::path file = source_dir() / "docs" / name;
  const std::string page = read_text(file);
  const std::string expected = with_tables(page, tables);
  if (std::getenv("HANDWAY_UPDATE_DOCS") != nullptr) {
    std::ofstream(file, std::ios::binary) << expected;
    return;
  }
  EXPECT_EQ(page, expected) << file << " is out of date: run build/release/tests/test_docs with "
                            << "HANDWAY_UPDATE_DOCS=1";
}

TEST(PlannerManual, HasTheParametersOfEveryPlanner) {
  expect_tables("planners.md", planner_tables(planning::PlannerRegistry()));
}

TEST(SettingsManual, HasTheSettingsOfEachKindOfWork) {
  expect_tables("settings.md", settings_tables());
}

TEST(PlannerTables, ReplaceOnlyWhatIsBetweenTheMarks) {
  EXPECT_EQ(with_tables("a\n<!-- tables -->\nold\n<!-- end of tables -->\nb\n", "new\n"),
            "a\n<!-- tables -->\nnew\n<!-- end of tables -->\nb\n");
  EXPECT_THROW(static_cast<void>(with_tables("a\n", "new\n")), std::runtime_error);
}

}  // namespace
}  // namespace handway::test
