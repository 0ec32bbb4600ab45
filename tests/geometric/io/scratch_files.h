#pragma once

#include <handway/geometric/io/input_error.h>

#include <handway_test/paths.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace handway::test {

/// A scratch folder that tests fill with files.
class ScratchFiles {
 public:
  /// Writes a file (and the folders above it) and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    const std::filesystem::path file = folder_.path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

  [[nodiscard]] static std::string read(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  ScratchFolder folder_;
};

/// The message of the InputError that `action` throws; "no error" without one.
template <typename Action>
std::string input_error_of(Action action) {
  try {
    action();
  } catch (const geometric::InputError& error) {
    return error.what();
  }
  return "no error";
}

/// `text` so many times.
inline std::string repeated(const std::string& text, int times) {
  std::string whole;
  for (int i = 0; i < times; ++i) {
    whole += text;
  }
  return whole;
}

/// A unit square of two triangles in the plane z = 0, from (0, 0) to (1, 1), as OBJ.
inline const std::string kSquareObj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

}  // namespace handway::test
