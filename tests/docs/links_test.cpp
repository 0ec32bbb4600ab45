#include "handway_test/paths.h"
#include "markdown.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

TEST(Manual, LinksToWhatIsThere) {
  for (const fs::path& page : manual_pages()) {
    for (const std::string& target : link_targets(read_text(page))) {
      if (target.find("://") != std::string::npos) {
        continue;
      }
      const std::size_t hash = target.find('#');
      const std::string file = target.substr(0, hash);
      const fs::path linked = file.empty() ? page : page.parent_path() / file;
      ASSERT_TRUE(fs::exists(linked)) << page << " links to " << target;
      if (hash != std::string::npos) {
        EXPECT_TRUE(heading_anchors(read_text(linked)).contains(target.substr(hash + 1)))
            << page << " links to " << target;
      }
    }
  }
}

TEST(Manual, ListsEveryPageInItsIndex) {
  const fs::path docs = source_dir() / "docs";
  const std::vector<std::string> listed = link_targets(read_text(docs / "README.md"));
  for (const fs::path& page : manual_pages()) {
    if (page.parent_path() == docs && page.filename() != "README.md") {
      EXPECT_THAT(listed, testing::Contains(page.filename().string()));
    }
  }
}

TEST(Markdown, FindsLinksAndAnchors) {
  EXPECT_THAT(link_targets("[a](b.md#c) and ![d](e.png), [f] (g)"), ElementsAre("b.md#c", "e.png"));
  EXPECT_THAT(heading_anchors("# Exit codes\ntext\n## `pmd-prm`: the paper's\n"),
              UnorderedElementsAre("exit-codes", "pmd-prm-the-papers"));
}

TEST(Markdown, CutsOutASection) {
  EXPECT_EQ(section("# a\n## `b`\none\n### deeper\ntwo\n## c\nthree\n", "b"),
            "one\n### deeper\ntwo\n");
  EXPECT_EQ(section("## a\none\n", "b"), "");
}

TEST(Markdown, FindsTheOptionsOfSettings) {
  EXPECT_EQ(setting_options("| Parameter | Default |\n|---|---|\n| `period_ms` | 4 ms | x |\n"
                            "| `blend` | true | x |\n"),
            (std::set<std::string>{"--period-ms", "--no-blend"}));
  EXPECT_EQ(section_at("## A b\nx\n## C\ny\n", "a-b"), "x\n");
}

TEST(Markdown, FindsOptions) {
  EXPECT_THAT(long_options("[--seed N] `--out`, a---b c--d --time-limit=3"),
              UnorderedElementsAre("--seed", "--out", "--time-limit"));
}

}  // namespace
}  // namespace handway::test
