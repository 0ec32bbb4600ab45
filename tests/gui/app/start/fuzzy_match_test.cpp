#include "app/start/command_palette.h"

#include <gtest/gtest.h>

namespace handway::test {
namespace {

using gui::fuzzy_score;

TEST(FuzzyMatch, WantsAllLettersInOrder) {
  EXPECT_TRUE(fuzzy_score("svas", "File: Save as"));
  EXPECT_FALSE(fuzzy_score("savz", "File: Save as"));
  EXPECT_FALSE(fuzzy_score("evas s", "Save"));
  EXPECT_TRUE(fuzzy_score("", "anything"));
}

TEST(FuzzyMatch, LikesBeginningsOfWords) {
  EXPECT_GT(fuzzy_score("ds", "Edit: Drop to surface"), fuzzy_score("ds", "Edit: Undos"));
  EXPECT_GT(fuzzy_score("top", "View: Top"), fuzzy_score("top", "File: Stop"));
  EXPECT_GT(fuzzy_score("box", "Add: Box"), fuzzy_score("box", "Add: Big oxen"));
}

}  // namespace
}  // namespace handway::test
