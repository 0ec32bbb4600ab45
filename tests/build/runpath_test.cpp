/// Tests where built programs look for libraries: never in the current folder, where anybody's
/// library of the same name would be loaded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <string>
#include <vector>

namespace handway::test {
namespace {

namespace fs = std::filesystem;

bool is_elf(const fs::path& file) {
  std::array<char, 4> head{};
  std::ifstream(file, std::ios::binary).read(head.data(), head.size());
  return std::string(head.begin(), head.end()) ==
         "\x7F"
         "ELF";
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string output;
  std::array<char, 4096> part{};
  while (pipe && std::fgets(part.data(), part.size(), pipe.get()) != nullptr) {
    output += part.data();
  }
  return output;
}

// The elements of RPATH and RUNPATH as `readelf -d` prints them: "… runpath: [a:b]".
std::vector<std::string> elements(const std::string& dynamic_section) {
  static const std::regex kList(R"(\(R(?:UN)?PATH\)[^\[]*\[([^\n]*)\])");
  std::vector<std::string> result;
  for (std::sregex_iterator list(dynamic_section.begin(), dynamic_section.end(), kList), end;
       list != end; ++list) {
    std::string rest = (*list)[1];
    for (std::size_t colon = rest.find(':'); colon != std::string::npos; colon = rest.find(':')) {
      result.push_back(rest.substr(0, colon));
      rest.erase(0, colon + 1);
    }
    result.push_back(rest);
  }
  return result;
}

bool is_safe(const std::string& element) {
  return element.starts_with('/') || element == "$ORIGIN" || element.starts_with("$ORIGIN/");
}

// All that the build made to be run or loaded.
std::vector<fs::path> binaries() {
  std::vector<fs::path> result;
  for (const char* folder : {"bin", "lib", "tests"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(HANDWAY_BUILD_FOLDER) / folder)) {
      if (entry.is_regular_file() && entry.path().extension() != ".o" && is_elf(entry.path())) {
        result.push_back(entry.path());
      }
    }
  }
  return result;
}

TEST(RunPaths, AreTakenApartAsTheLoaderDoes) {
  using testing::ElementsAre;
  EXPECT_THAT(elements(" 0x1d (RUNPATH)   Library runpath: [:::]\n"), ElementsAre("", "", "", ""));
  EXPECT_THAT(elements(" 0x0f (RPATH)  Library rpath: [/a/lib:$ORIGIN/..:lib]\n"),
              ElementsAre("/a/lib", "$ORIGIN/..", "lib"));
  EXPECT_THAT(elements(" 0x01 (NEEDED)  Shared library: [libfmt.so.9]\n"), testing::IsEmpty());
  EXPECT_FALSE(is_safe(""));
  EXPECT_FALSE(is_safe("lib"));
}

TEST(RunPaths, NameNoCurrentFolder) {
  const std::vector<fs::path> files = binaries();
  EXPECT_GT(files.size(), 1U);
  for (const fs::path& file : files) {
    for (const std::string& element :
         elements(output_of(std::string(HANDWAY_READELF) + " -d '" + file.string() + "'"))) {
      EXPECT_TRUE(is_safe(element)) << file << " looks in \"" << element << "\"";
    }
  }
}

}  // namespace
}  // namespace handway::test
