#include "handway/geometric/io/text_file.h"

#include "handway/geometric/io/file_contents.h"
#include "handway/geometric/io/input_error.h"

#include <boost/locale/encoding_utf.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace handway::geometric {
namespace {

thread_local FilesRead* innermost = nullptr;

}  // namespace

FilesRead::FilesRead() : outer_(innermost) { innermost = this; }

FilesRead::~FilesRead() { innermost = outer_; }

void note_file_read(const std::filesystem::path& file) {
  if (innermost == nullptr) {
    return;
  }
  const std::filesystem::path path = std::filesystem::absolute(file).lexically_normal();
  for (FilesRead* notes = innermost; notes != nullptr; notes = notes->outer_) {
    if (std::ranges::count(notes->files_, path) == 0) {
      notes->files_.push_back(path);
    }
  }
}

namespace {

namespace fs = std::filesystem;

// Converts text of Windows' shells and spreadsheets, UTF-16 behind a byte-order mark, to UTF-8.
std::string from_utf16(const std::string& bytes) {
  const bool little = bytes.starts_with("\xFF\xFE");
  std::u16string units;
  for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
    const auto low = static_cast<unsigned char>(bytes[little ? i : i + 1]);
    const auto high = static_cast<unsigned char>(bytes[little ? i + 1 : i]);
    units += static_cast<char16_t>(high << 8 | low);
  }
  return boost::locale::conv::utf_to_utf<char>(units);
}

bool is_text(unsigned char byte) {
  return byte >= 0x20 ? byte != 0x7F : byte == '\t' || byte == '\n' || byte == '\r' || byte == '\f';
}

// Length of the UTF-8 sequence that starts at `at`; 0 if there is no sequence.
std::size_t sequence_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(at);
  if (lead < 0x80) {
    return is_text(lead) ? 1 : 0;
  }
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || at + length > text.size()) {
    return 0;
  }
  for (std::size_t i = at + 1; i < at + length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) {
      return 0;
    }
  }
  return length;
}

// The text with each byte beyond ASCII that is not UTF-8 interpreted as the Latin-1 of older
// editors.
// @throws InputError for bytes that are not in any text.
std::string checked_text(const fs::path& file, std::string text, const std::string& what) {
  std::string result;
  std::size_t copied = 0;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t length = sequence_length(text, at);
    const auto byte = static_cast<unsigned char>(text[at]);
    if (length == 0 && byte < 0x80) {
      const auto end = text.begin() + static_cast<std::ptrdiff_t>(at);
      const auto line = 1 + std::count(text.begin(), end, '\n');
      throw InputError({file.string() + ":" + std::to_string(line), "", "bytes that are no text",
                        what, "Is this another kind of file?"});
    }
    if (length == 0) {
      result.append(text, copied, at - copied);
      result += static_cast<char>(0xC0 | byte >> 6);
      result += static_cast<char>(0x80 | (byte & 0x3F));
      copied = at + 1;
    }
    at += std::max<std::size_t>(length, 1);
  }
  return copied == 0 ? std::move(text) : result.append(text, copied);
}

}  // namespace

std::string read_text_file(const fs::path& file, const std::string& what, std::size_t limit) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) {
    throw InputError({file.string(), "", "no such file", what, "Check the path"});
  }
  if (fs::is_directory(status)) {
    throw InputError({file.string(), "", "a folder", what, "Name a file in it"});
  }
  if (!fs::is_regular_file(status)) {  // devices and pipes may have no end, or never begin
    throw InputError({file.string(), "", "no regular file", what, "Save it to a file"});
  }
  note_file_read(file);
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  if (stream) {
    text.resize(limit + 1 < 65536 ? limit + 1 : 65536);
    std::size_t size = 0;
    while (stream.read(text.data() + size, static_cast<std::streamsize>(text.size() - size)),
           stream.gcount() > 0) {
      size += static_cast<std::size_t>(stream.gcount());
      if (size > limit) {
        throw InputError({file.string(), "", "more than " + std::to_string(limit) + " bytes", what,
                          "Is this the right file?"});
      }
      if (size == text.size()) {
        text.resize(std::min(2 * size, limit + 1));
      }
    }
    text.resize(size);
  }
  if (!stream.eof()) {
    throw InputError({file.string(), "", std::strerror(errno), "a readable file",
                      "Check the file's permissions"});
  }
  if (text.starts_with("\xEF\xBB\xBF")) {
    text.erase(0, 3);
  } else if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    text = from_utf16(text);
  }
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError({file.string(), "", "an empty file", what, ""});
  }
  if (const std::optional<StandIn> other = stand_in(text)) {
    throw InputError({file.string(), "", other->found, what, other->advice});
  }
  return checked_text(file, std::move(text), what);
}

std::string head_of(const std::filesystem::path& file, std::size_t size) {
  std::string text(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

}  // namespace handway::geometric
