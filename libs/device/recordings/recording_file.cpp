#include "recordings/recording_file.h"

#include "handway/geometric/io/text_file.h"

#include <algorithm>
#include <cstddef>
#include <system_error>

namespace handway::device {
namespace {

constexpr std::size_t kLargestText = std::size_t{1} << 30;  // some 30 hours at 100 Hz

bool is_there(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::exists(file, error);
}

}  // namespace

RecordingFile::RecordingFile(const std::filesystem::path& given) : path_(given) {
  const std::string text = given.string();
  for (std::size_t mark = text.find('#'); mark != std::string::npos && !is_there(path_);
       mark = text.find('#', mark + 1)) {
    if (is_there(text.substr(0, mark))) {
      path_ = text.substr(0, mark);
      variable_ = text.substr(mark + 1);
    }
  }
  head_ = geometric::head_of(path_);
}

const RecordingFile::Text& RecordingFile::loaded() const {
  if (!text_) {
    auto read = std::make_unique<Text>();
    read->text = geometric::read_text_file(path_, "a recording of a glove", kLargestText);
    if (read->text.find('\n') == std::string::npos) {  // as old Macintoshs end lines
      std::ranges::replace(read->text, '\r', '\n');
    }
    read->lines = text_lines(read->text);
    text_ = std::move(read);
  }
  return *text_;
}

const std::vector<TextLine>& RecordingFile::lines() const { return loaded().lines; }

const std::string& RecordingFile::text() const { return loaded().text; }

const TextLine* RecordingFile::first_line() const {
  const std::vector<TextLine>& all = lines();
  const auto first =
      std::ranges::find_if(all, [](const TextLine& line) { return !trimmed(line.text).empty(); });
  return first == all.end() ? nullptr : &*first;
}

}  // namespace handway::device
