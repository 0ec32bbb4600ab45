#include "handway_test/paths.h"
#include "markdown.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <sstream>

namespace handway::test {
namespace {

using testing::ContainerEq;
using testing::Contains;

std::string help_of(const std::string& arguments) {
  const std::string command = std::string(HANDWAY_PROGRAM) + " " + arguments + " --help";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> block{};
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), pipe.get())) {
    text.append(block.data(), size);
  }
  return text;
}

// The subcommands that the program's help lists after "Subcommands:".
std::vector<std::string> commands() {
  std::istringstream lines(help_of(""));
  std::vector<std::string> names;
  bool listed = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Subcommands")) {
      listed = true;
    } else if (listed && line.starts_with("  ") && line[2] != ' ') {
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return names;
}

TEST(CommandLineManual, NamesTheOptionsOfEveryCommand) {
  const std::string manual = read_text(source_dir() / "docs" / "command-line.md");
  const std::vector<std::string> names = commands();
  ASSERT_THAT(names, Contains("plan"));
  for (const std::string& name : names) {
    const std::string text = section(manual, "handway " + name);
    ASSERT_FALSE(text.empty()) << "no section \"handway " << name << "\"";
    std::set<std::string> options = long_options(help_of(name));
    options.erase("--help");
    EXPECT_THAT(long_options(text), ContainerEq(options)) << "handway " << name;
  }
}

}  // namespace
}  // namespace handway::test
