#pragma once

#include <filesystem>
#include <optional>

/// Paths of the files of tests.
namespace handway::test {

/// The project's root folder.
[[nodiscard]] std::filesystem::path source_dir();

/// The published problems, recordings and robots that the project is measured
/// against: $HANDWAY_REFERENCE_DIR, or shared/reference beside the project.
/// Nothing if there are none; tests that need them then skip.
[[nodiscard]] std::optional<std::filesystem::path> reference_dir();

/// A new empty folder that is removed with the object.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Copies a folder with all that is in it, to be changed: the original may be for reading only.
void copy_folder(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace handway::test

// NOLINTBEGIN(bugprone-macro-parentheses): `variable` is a name to declare.
/// Skips the test where the reference data is absent.
#define HANDWAY_NEED_REFERENCE(variable)                                          \
  const auto variable##_found = handway::test::reference_dir();                   \
  if (!variable##_found) {                                                        \
    GTEST_SKIP() << "no reference data: set HANDWAY_REFERENCE_DIR to its folder"; \
  }                                                                               \
  const std::filesystem::path& variable = *variable##_found
// NOLINTEND(bugprone-macro-parentheses)
