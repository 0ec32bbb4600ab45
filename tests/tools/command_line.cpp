#include "command_line.h"

#include "handway/geometric/formats/scene_file.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway_test/planar_problems.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace handway::test {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_problem(const planning::PlanningProblem& problem, const fs::path& file) {
  geometric::Scene scene = *problem.scene;
  scene.hand_basis = "basis.yaml";
  geometric::write_scene(scene, file);
}

}  // namespace

CommandLine::CommandLine() {
  sampling::write_pmd_basis(planar_hand_basis(), folder() / "basis.yaml");
  write_problem(open_problem(), folder() / "open.yaml");
  write_problem(post_problem(), folder() / "post.yaml");
  write_problem(walled_in_problem(), folder() / "walled.yaml");
}

fs::path CommandLine::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder() / name, std::ios::binary) << text;
  return folder() / name;
}

std::string CommandLine::read(const std::string& name) const { return content(folder() / name); }

void CommandLine::replace(const std::string& name, const std::string& found,
                          const std::string& by) const {
  std::string text = read(name);
  const std::size_t at = text.find(found);
  if (at == std::string::npos) {
    throw std::logic_error(name + " has no \"" + found + "\":\n" + text);
  }
  write(name, text.replace(at, found.size(), by));
}

Outcome CommandLine::run(const std::string& arguments, const std::string& within) const {
  const std::string folder_name = folder().string();
  const std::string command = "cd '" + folder_name + "/" + within + "' && '" HANDWAY_PROGRAM "' " +
                              arguments + " >'" + folder_name + "/stdout.txt' 2>'" + folder_name +
                              "/stderr.txt'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("stdout.txt"), read("stderr.txt")};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

}  // namespace handway::test
