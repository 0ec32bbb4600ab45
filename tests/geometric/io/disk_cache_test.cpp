#include "handway/geometric/io/disk_cache.h"

#include "handway_test/paths.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

class DiskCacheTest : public testing::Test {
 protected:
  [[nodiscard]] static CacheKey key_of(const std::string& content) {
    return cache_key("a test", content);
  }
  [[nodiscard]] fs::path only_file() const { return fs::directory_iterator(cache_folder_)->path(); }
  [[nodiscard]] std::uintmax_t size() const {
    std::uintmax_t sum = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(cache_folder_)) {
      sum += entry.file_size();
    }
    return sum;
  }

  handway::test::ScratchFolder folder_;
  fs::path cache_folder_ = folder_.path() / "cache";
  DiskCache cache_{cache_folder_};
  CacheKey key_ = key_of("content");
};

TEST_F(DiskCacheTest, KeepsBytes) {
  EXPECT_FALSE(cache_.read(key_));
  cache_.write(key_, std::string("a\0b", 3));
  EXPECT_EQ(cache_.read(key_), std::string("a\0b", 3));
  cache_.write(key_, "");
  EXPECT_EQ(cache_.read(key_), "");
}

TEST_F(DiskCacheTest, TellsContentsAndLayoutsApart) {
  EXPECT_NE(cache_key("a", "content"), cache_key("b", "content"));
  EXPECT_NE(cache_key("a", "content"), cache_key("a", "other content"));
  EXPECT_NE(cache_key("a:", "content"), cache_key("a", ":content"));
  EXPECT_EQ(cache_key("a", "content"), cache_key("a", "content"));
}

TEST_F(DiskCacheTest, TakesAnyChangedByteForNoEntry) {
  cache_.write(key_, "what was kept");
  const std::string whole = [&] {
    std::ifstream file(only_file(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    std::ofstream(only_file(), std::ios::binary) << flipped;
    EXPECT_FALSE(cache_.read(key_)) << "byte " << i;
    std::ofstream(only_file(), std::ios::binary) << whole.substr(0, i);
    EXPECT_FALSE(cache_.read(key_)) << "the first " << i << " bytes";
  }
  std::ofstream(only_file(), std::ios::binary) << whole << '\0';
  EXPECT_FALSE(cache_.read(key_)) << "a byte too many";
  cache_.write(key_, "again");
  EXPECT_EQ(cache_.read(key_), "again");
}

TEST_F(DiskCacheTest, DoesNotTakeOneEntryForAnother) {
  cache_.write(key_, "of the one");
  const fs::path one = only_file();
  fs::rename(one, folder_.path() / "aside");
  const CacheKey other = key_of("other content");
  cache_.write(other, "of the other");
  fs::copy_file(only_file(), one);
  EXPECT_FALSE(cache_.read(key_));
  EXPECT_EQ(cache_.read(other), "of the other");
}

TEST_F(DiskCacheTest, DoesWithoutEntriesThatAreNoFiles) {
  cache_.write(key_, "bytes");
  const fs::path entry = only_file();
  fs::remove(entry);
  fs::create_directories(entry / "with" / "something");
  EXPECT_FALSE(cache_.read(key_));
  cache_.write(key_, "bytes");
  EXPECT_FALSE(cache_.read(key_));
  fs::remove_all(entry);
  ASSERT_EQ(mkfifo(entry.c_str(), 0600), 0);
  EXPECT_FALSE(cache_.read(key_)) << "a pipe that nobody writes to";
  cache_.write(key_, "bytes");
  cache_.write(key_of("other content"), "bytes");
  EXPECT_TRUE(cache_.read(key_of("other content")));
}

TEST_F(DiskCacheTest, DoesWithoutAFolder) {
  std::ofstream(cache_folder_) << "a file where the folder should be";
  cache_.write(key_, "bytes");
  EXPECT_FALSE(cache_.read(key_));
  const DiskCache none({});
  none.write(key_, "bytes");
  EXPECT_FALSE(none.read(key_));
}

TEST_F(DiskCacheTest, ReadsWhereNothingCanBeWritten) {
  cache_.write(key_, "bytes");
  const fs::path file = only_file();
  fs::permissions(file, fs::perms::owner_read);
  fs::permissions(cache_folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(cache_.read(key_), "bytes");
  cache_.write(key_of("other content"), "bytes");
  cache_.write(key_, "other bytes");
  fs::permissions(cache_folder_, fs::perms::owner_all);
  fs::permissions(file, fs::perms::none);
  if (geteuid() != 0) {  // who may read anything
    EXPECT_FALSE(cache_.read(key_));
  }
  fs::permissions(file, fs::perms::owner_all);
}

TEST_F(DiskCacheTest, DerivesAgainWhatCannotBeDecoded) {
  cache_.write(key_, "12");
  const auto number = [](const std::string& bytes) { return std::stoi(bytes); };
  EXPECT_EQ(cache_.read_as(key_, number), 12);
  cache_.write(key_, "no number");
  EXPECT_FALSE(cache_.read_as(key_, number));
}

TEST_F(DiskCacheTest, StaysWithinItsBudgetAndDropsWhatWasNotUsedForLongest) {
  const DiskCache cache(cache_folder_, 10000);
  const std::string kilobyte(1000, 'x');
  cache.write(key_, kilobyte);
  for (int i = 0; i < 30; ++i) {
    cache.write(key_of(std::to_string(i)), kilobyte);
    for (const fs::directory_entry& entry : fs::directory_iterator(cache_folder_)) {
      fs::last_write_time(entry, entry.last_write_time() - std::chrono::seconds(10));
    }
    EXPECT_TRUE(cache.read(key_)) << "used all the time";
    EXPECT_LE(size(), 10000U);
  }
  EXPECT_TRUE(cache.read(key_of("29")));
  EXPECT_FALSE(cache.read(key_of("0")));
  cache.write(key_of("large"), std::string(20000, 'x'));
  EXPECT_FALSE(cache.read(key_of("large")));
  EXPECT_TRUE(cache.read(key_of("29")));
}

class UsersCache : public testing::Test {
 protected:
  UsersCache() { setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }
  ~UsersCache() override {
    if (before_.empty()) {
      unsetenv("XDG_CACHE_HOME");
    } else {
      setenv("XDG_CACHE_HOME", before_.c_str(), 1);
    }
  }

  handway::test::ScratchFolder folder_;
  std::string before_ = std::getenv("XDG_CACHE_HOME") ? std::getenv("XDG_CACHE_HOME") : "";
};

TEST_F(UsersCache, IsWhereTheEnvironmentSays) {
  DiskCache::of_user().write(cache_key("a test", "content"), "bytes");
  EXPECT_FALSE(fs::is_empty(folder_.path() / "handway" / "meshes"));
}

TEST_F(UsersCache, ReplacesThatOfEarlyVersions) {
  const fs::path early = folder_.path() / "handway" / "collision";
  fs::create_directories(early / "folder");
  std::ofstream(early / "entry.bin") << "of an early version";
  static_cast<void>(DiskCache::of_user());
  EXPECT_FALSE(fs::exists(early));
}

}  // namespace
}  // namespace handway::geometric
