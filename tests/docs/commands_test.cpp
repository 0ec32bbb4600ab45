#include "handway_test/paths.h"
#include "markdown.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::test {
namespace {

using testing::ContainerEq;
using testing::Contains;

struct ShellRun {
  int status;
  std::string printed;
};

ShellRun run_in_shell(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string printed;
  std::array<char, 4096> block{};
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), pipe)) {
    printed.append(block.data(), size);
  }
  return {pclose(pipe), printed};
}

std::string help_of(const std::string& program) {
  return run_in_shell(program + " --help").printed;
}

// The subcommands that a help lists after "Subcommands:".
std::vector<std::string> subcommands(const std::string& help) {
  std::istringstream lines(help);
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

// All commands, those of commands included: "plan", "glove", "glove live".
std::vector<std::string> commands() {
  std::vector<std::string> all;
  for (const std::string& name : subcommands(help_of(HANDWAY_PROGRAM))) {
    all.push_back(name);
    for (const std::string& part : subcommands(help_of(HANDWAY_PROGRAM " " + name))) {
      all.push_back(name + " " + part);
    }
  }
  return all;
}

// The options of the settings tables that a text links to: "settings.md#timing".
std::set<std::string> linked_options(const std::string& text) {
  const std::string page = read_text(source_dir() / "docs" / "settings.md");
  std::set<std::string> options;
  for (const std::string& target : link_targets(text)) {
    if (target.starts_with("settings.md#")) {
      const std::set<std::string> keys =
          setting_options(section_at(page, target.substr(target.find('#') + 1)));
      options.insert(keys.begin(), keys.end());
    }
  }
  return options;
}

TEST(CommandLineManual, NamesTheOptionsOfEveryCommand) {
  const std::string manual = read_text(source_dir() / "docs" / "command-line.md");
  const std::vector<std::string> names = commands();
  ASSERT_THAT(names, Contains("plan"));
  for (const std::string& name : names) {
    const std::string text = section(manual, "handway " + name);
    ASSERT_FALSE(text.empty()) << "no section \"handway " << name << "\"";
    std::set<std::string> options =
        long_options(help_of(std::string(HANDWAY_PROGRAM) + " " + name));
    options.erase("--help");
    std::set<std::string> named = long_options(text);
    named.merge(linked_options(text));
    EXPECT_THAT(named, ContainerEq(options)) << "handway " << name;
  }
}

// Items P1 to P69 of the paper, each once and in order, with a command that shows it.
TEST(PaperManual, NamesACommandForEachItem) {
  const std::vector<std::string> known = commands();
  const std::regex item(R"(\| P(\d+) \| .*)");
  const std::regex command(
      "`(handway ([a-z]+)|\\./run|\\./check|mpirun -n 8 handway|build/release/tests/|ls |cat )");
  std::istringstream lines(read_text(source_dir() / "docs" / "paper.md"));
  int last = 0;
  for (std::string line; std::getline(lines, line);) {
    std::smatch number;
    if (!std::regex_match(line, number, item)) {
      continue;
    }
    EXPECT_EQ(std::stoi(number[1]), ++last);
    std::smatch found;
    const bool names_one = std::regex_search(line, found, command);
    EXPECT_TRUE(names_one) << line;
    if (names_one && found[2].matched) {
      EXPECT_THAT(known, Contains(found[2].str())) << line;
    }
  }
  EXPECT_EQ(last, 69);
}

TEST(WorkbenchManual, NamesTheOptionsOfTheWorkbench) {
  if (std::string(HANDWAY_WORKBENCH).empty()) {
    GTEST_SKIP() << "built without the workbench";
  }
  std::set<std::string> options = long_options(help_of(HANDWAY_WORKBENCH));
  options.erase("--help");
  const std::string manual = read_text(source_dir() / "docs" / "workbench.md");
  EXPECT_THAT(long_options(section(manual, "The workbench")), ContainerEq(options));
}

// The commands of the tour, from any folder.
TEST(Readme, ShowsCommandsThatWork) {
  constexpr std::string_view kProgram = "build/release/bin/handway ";
  const ScratchFolder scratch;
  std::istringstream lines(section(read_text(source_dir() / "README.md"), "Five minutes"));
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(kProgram)) {
      continue;
    }
    std::string arguments = line.substr(kProgram.size());
    const std::regex shipped("\\b(scenes|resources)/");
    ASSERT_TRUE(std::regex_search(arguments, shipped)) << line;
    arguments = std::regex_replace(arguments, shipped, source_dir().string() + "/$1/");
    const ShellRun done =
        run_in_shell("cd " + scratch.path().string() + " && " HANDWAY_PROGRAM " " + arguments);
    EXPECT_EQ(done.status, 0) << line << '\n' << done.printed;
    ++commands;
  }
  EXPECT_GE(commands, 3);
}

// Pictures that no command makes would grow stale, and pictures that no page shows are not needed.
TEST(Manual, HasThePicturesThatItsTargetMakes) {
  namespace fs = std::filesystem;
  const ShellRun list = run_in_shell((source_dir() / "scripts/docs-pictures").string() + " --list");
  ASSERT_EQ(list.status, 0) << list.printed;
  std::set<std::string> made;
  std::istringstream lines(list.printed);
  for (std::string line; std::getline(lines, line);) {
    ASSERT_TRUE(fs::exists(source_dir() / line)) << line;
    if (line.starts_with("docs/")) {
      made.insert(line);
    }
  }
  std::set<std::string> shown;
  for (const fs::path& page : manual_pages()) {
    for (const std::string& target : link_targets(read_text(page))) {
      if (target.ends_with(".png")) {
        shown.insert(fs::proximate(page.parent_path() / target, source_dir()).string());
      }
    }
  }
  EXPECT_THAT(shown, ContainerEq(made));
  std::set<std::string> kept;
  for (const auto& entry : fs::directory_iterator(source_dir() / "docs/images")) {
    kept.insert(fs::proximate(entry.path(), source_dir()).string());
  }
  EXPECT_THAT(kept, ContainerEq(made));
}

// The table has a row for each hand and method that its script measures, and the manual no
// others.
TEST(RetargetingTable, HasTheRowsThatItsScriptMeasures) {
  const ShellRun list =
      run_in_shell((source_dir() / "scripts/retargeting-table").string() + " --list");
  ASSERT_EQ(list.status, 0) << list.printed;
  std::vector<std::string> measured;
  std::istringstream lines(list.printed);
  for (std::string line; std::getline(lines, line);) {
    measured.push_back(line);
  }
  const std::regex figures(R"(^(\|.*?\|.*?\|)( \d+\.\d \|){6}$)");
  std::vector<std::string> shown;
  std::istringstream manual(read_text(source_dir() / "docs" / "glove-to-pmd.md"));
  std::smatch found;
  for (std::string line; std::getline(manual, line);) {
    if (std::regex_match(line, found, figures)) {
      shown.push_back(found[1]);
    }
  }
  EXPECT_THAT(shown, ContainerEq(measured));
  EXPECT_GE(shown.size(), 12U);
}

// The commands of the page in their order, in a folder with two robots that have no SRDF.
TEST(BringYourOwnRobot, GoesFromTwoRobotFilesToAGrasp) {
  namespace fs = std::filesystem;
  const ScratchFolder scratch;
  const fs::path robots = source_dir() / "resources/robots";
  for (const auto& [name, shipped] :
       {std::pair("arm", "iiwa14_class"), std::pair("hand", "allegro_class_right")}) {
    const fs::path folder = scratch.path() / name;
    fs::create_directory(folder);
    fs::create_directory_symlink(robots / shipped / "meshes", folder / "meshes");
    fs::copy_file(robots / shipped / (std::string(shipped) + ".urdf"),
                  folder / (std::string(name) + ".urdf"));
  }
  const std::string text =
      section(read_text(source_dir() / "docs" / "bring-your-own-robot.md"), "On the command line");
  const std::size_t yaml = text.find("```yaml\n") + 8;
  std::ofstream(scratch.path() / "grasp.yaml") << text.substr(yaml, text.find("```", yaml) - yaml);
  std::istringstream lines(text);
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("handway ")) {
      const ShellRun done = run_in_shell("cd " + scratch.path().string() + " && " HANDWAY_PROGRAM +
                                         line.substr(std::string("handway").size()));
      EXPECT_EQ(done.status, 0) << line << '\n' << done.printed;
      ++commands;
    }
  }
  EXPECT_EQ(commands, 9);
  EXPECT_TRUE(fs::exists(scratch.path() / "robot.srdf"));
}

}  // namespace
}  // namespace handway::test
