#pragma once

#include "glove/text_files.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::device {

/// A file that may be a recording, with the parts by which formats recognise it.
class RecordingFile {
 public:
  /// @param given a file, or a file with the name of a variable behind a `#`.
  explicit RecordingFile(const std::filesystem::path& given);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The chosen variable; empty: none was named.
  [[nodiscard]] const std::string& variable() const { return variable_; }
  /// The first bytes; empty if the file can't be read.
  [[nodiscard]] const std::string& head() const { return head_; }
  /// Lines of the text, which is read at the first call.
  /// @throws InputError if it can't be read or is not text.
  [[nodiscard]] const std::vector<TextLine>& lines() const;
  [[nodiscard]] const std::string& text() const;
  /// The first line that isn't blank; nullptr if there is none. @throws InputError as lines().
  [[nodiscard]] const TextLine* first_line() const;

 private:
  struct Text {
    std::string text;
    std::vector<TextLine> lines;
  };
  const Text& loaded() const;

  std::filesystem::path path_;
  std::string variable_;
  std::string head_;
  mutable std::unique_ptr<Text> text_;
};

}  // namespace handway::device
