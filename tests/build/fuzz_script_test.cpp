/// Tests the inputs of the fuzzing in ./check (scripts/fuzz.sh): they are generated, and the same
/// each time.
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace handway::test {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

/// A folder as the project's, in which two programs stand for fuzz targets: they write down how
/// they are called and what is kept for them already.
class FuzzScript : public testing::Test {
 protected:
  FuzzScript() {
    add_target("good", 0);
    add_target("bad", 77);
  }

  void add_target(const std::string& name, int status) const {
    const fs::path program = folder_.path() / "build/fuzz/fuzz" / ("fuzz_" + name);
    fs::create_directories(program.parent_path());
    std::ofstream(program) << "#!/bin/sh\necho \"$@\" >>" << name << ".calls\n"
                           << "ls build/fuzz/same/" << name << " >>" << name << ".calls\n"
                           << "echo new >build/fuzz/same/" << name << "/new\n"
                           << "exit " << status << "\n";
    fs::permissions(program, fs::perms::owner_all);
  }

  // Returns whether the command, with the script's functions, succeeds. Nothing is built.
  [[nodiscard]] bool run(const std::string& command) const {
    const std::string line = "cd '" + folder_.path().string() + "' && bash -c 'source \"" +
                             (source_dir() / "scripts/fuzz.sh").string() + "\"; build() { :; }; " +
                             command + "' >log.txt 2>&1";
    return std::system(line.c_str()) == 0;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream file(folder_.path() / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  ScratchFolder folder_;
};

TEST_F(FuzzScript, MakesUpTheSameInputsWhateverWasFoundBefore) {
  ASSERT_TRUE(run("fuzz_the_same good"));
  const std::string first = read("good.calls");
  EXPECT_THAT(first, AllOf(HasSubstr("-seed=1 "), ContainsRegex("-runs=[1-9][0-9]+ "),
                           HasSubstr(" build/fuzz/same/good tests/fuzz/corpora/good\n")));
  ASSERT_TRUE(run("fuzz_the_same good"));
  EXPECT_EQ(read("good.calls"), first + first) << "nothing is kept from the run before";
}

TEST_F(FuzzScript, FailsIfOneTargetFindsSomething) {
  EXPECT_FALSE(run("fuzz_for_a_minute"));
  EXPECT_THAT(read("good.calls"), HasSubstr("-runs="));
  EXPECT_THAT(read("bad.calls"), HasSubstr("-runs="));
  fs::remove(folder_.path() / "build/fuzz/fuzz/fuzz_bad");
  EXPECT_TRUE(run("fuzz_for_a_minute"));
}

TEST_F(FuzzScript, IsPartOfTheCheck) {
  std::ifstream file(source_dir() / "check");
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(file), {}),
              HasSubstr("step \"fuzzing\" fuzz_for_a_minute"));
}

}  // namespace
}  // namespace handway::test
