#include "features/glove/record_bar.h"
#include "handway/geometric/io/input_error.h"
#include "handway_test/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace handway::gui {
namespace {

TEST(NewRecordingFile, IsNobodyElsesWhoBeginsInTheSameSecond) {
  const handway::test::ScratchFolder folder;
  std::mutex mutex;
  std::set<std::filesystem::path> files;
  {
    std::vector<std::jthread> windows;
    for (int i = 0; i < 4; ++i) {
      windows.emplace_back([&] {
        for (int k = 0; k < 20; ++k) {
          const std::filesystem::path file = new_recording_file(folder.path());
          const std::scoped_lock lock(mutex);
          files.insert(file);
        }
      });
    }
  }
  EXPECT_EQ(files.size(), 80U);
  EXPECT_TRUE(std::ranges::all_of(
      files, [](const std::filesystem::path& file) { return std::filesystem::exists(file); }));
}

TEST(NewRecordingFile, SaysWhyThereIsNone) {
  EXPECT_THROW(static_cast<void>(new_recording_file("/nowhere/at/all")), geometric::InputError);
}

}  // namespace
}  // namespace handway::gui
