#include "sent_path.h"

#include "command_line.h"
#include "handway_test/paths.h"

#include <gtest/gtest.h>

#include <regex>

namespace handway::test {

std::string scene() { return (source_dir() / "scenes" / "can_on_table.yaml").string(); }

double number_after(const std::string& text, const std::string& words) {
  std::smatch found;
  return std::regex_search(text, found, std::regex(words + " ([0-9.]+)")) ? std::stod(found[1])
                                                                          : 1e9;
}

const std::string& planned_path() {
  static const std::string path = [] {
    const CommandLine line;
    const Outcome plan = line.run("plan " + scene() + " --out path.csv");
    EXPECT_EQ(plan.exit_code, 0) << plan.err;
    return line.read("path.csv");
  }();
  return path;
}

}  // namespace handway::test
