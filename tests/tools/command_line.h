#pragma once

#include "handway_test/paths.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::test {

/// Results of a run of `handway`.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// A folder with small problems, and the program to run on them.
class CommandLine {
 public:
  /// Writes "open.yaml" and "post.yaml" (solvable), "walled.yaml" (without a
  /// path), each with its robot and "basis.yaml".
  CommandLine();

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  /// Writes a file of the folder. @returns its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::string read(const std::string& name) const;
  /// Replaces the first `found` in a file of the folder.
  void replace(const std::string& name, const std::string& found, const std::string& by) const;

  /// Runs `handway ARGUMENTS` in the folder, or one within it, through the shell.
  [[nodiscard]] Outcome run(const std::string& arguments, const std::string& within = ".") const;

 private:
  ScratchFolder folder_;
};

[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

}  // namespace handway::test
