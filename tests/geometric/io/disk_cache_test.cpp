#include "handway/geometric/io/disk_cache.h"

#include "handway_test/paths.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

class DiskCache : public testing::Test {
 protected:
  DiskCache() { setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }
  ~DiskCache() override {
    if (before_.empty()) {
      unsetenv("XDG_CACHE_HOME");
    } else {
      setenv("XDG_CACHE_HOME", before_.c_str(), 1);
    }
  }

  [[nodiscard]] fs::path only_file() const {
    return fs::directory_iterator(folder_.path() / "handway" / "meshes")->path();
  }

  handway::test::ScratchFolder folder_;
  std::string before_ = std::getenv("XDG_CACHE_HOME") ? std::getenv("XDG_CACHE_HOME") : "";
  CacheKey key_ = cache_key("a test", "content");
};

TEST_F(DiskCache, KeepsBytes) {
  EXPECT_FALSE(read_cached(key_));
  write_cached(key_, std::string("a\0b", 3));
  EXPECT_EQ(read_cached(key_), std::string("a\0b", 3));
}

TEST_F(DiskCache, TellsContentsAndWaysOfMakingApart) {
  EXPECT_NE(cache_key("a", "content"), cache_key("b", "content"));
  EXPECT_NE(cache_key("a", "content"), cache_key("a", "other content"));
  EXPECT_EQ(cache_key("a", "content"), cache_key("a", "content"));
}

TEST_F(DiskCache, TakesABrokenFileForNone) {
  write_cached(key_, "what was kept");
  std::fstream(only_file(), std::ios::in | std::ios::out | std::ios::binary).seekp(10) << 'X';
  EXPECT_FALSE(read_cached(key_));
  fs::resize_file(only_file(), 2);
  EXPECT_FALSE(read_cached(key_));
  write_cached(key_, "again");
  EXPECT_EQ(read_cached(key_), "again");
}

TEST_F(DiskCache, DoesWithoutAFolderThatCanBeWritten) {
  std::ofstream(folder_.path() / "handway") << "a file where the folder should be";
  write_cached(key_, "bytes");
  EXPECT_FALSE(read_cached(key_));
}

TEST_F(DiskCache, DropsTheOldestOfTooManyFiles) {
  for (int i = 0; i < 1010; ++i) {
    write_cached(cache_key("many", std::to_string(i)), "bytes");
  }
  const fs::path folder = only_file().parent_path();
  EXPECT_LE(std::distance(fs::directory_iterator(folder), {}), 1000);
  EXPECT_TRUE(read_cached(cache_key("many", "1009")));
}

}  // namespace
}  // namespace handway::geometric
