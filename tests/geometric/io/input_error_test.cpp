#include "handway/geometric/io/input_error.h"

#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

TEST(InputError, SaysWhereWhatAndWhatToDo) {
  const InputError error({"scene.yaml:3", "robots", "a number", "a list", "Put it in brackets"});
  EXPECT_STREQ(error.what(),
               "scene.yaml:3: robots: found a number, expected a list. Put it in brackets.");
}

TEST(InputError, LeavesQuestionsAsTheyAre) {
  const InputError error({"scene.yaml:3", "", "\"sise\"", "size", "Did you mean \"size\"?"});
  EXPECT_STREQ(error.what(), "scene.yaml:3: found \"sise\", expected size. Did you mean \"size\"?");
}

TEST(InputError, NeedsNeitherSourceNorAdvice) {
  EXPECT_STREQ(InputError({"", "", "nothing", "", ""}).what(), "found nothing.");
}

}  // namespace
}  // namespace handway::geometric
