#include "handway/geometric/io/file_contents.h"

#include <algorithm>
#include <cctype>

namespace handway::geometric {

std::optional<StandIn> stand_in(std::string_view head) {
  constexpr std::string_view kBlanks = " \t\r\n";
  if (head.starts_with("\xEF\xBB\xBF")) {
    head.remove_prefix(3);
  }
  const std::size_t first = head.find_first_not_of(kBlanks);
  const std::string_view text =
      first == std::string_view::npos ? std::string_view() : head.substr(first);
  if (text.starts_with("version https://git-lfs") || text.starts_with("version http://git-media")) {
    return StandIn{"a Git LFS pointer (fetch the file itself with git lfs pull)",
                   "A ZIP of a repository holds pointers alone: clone it with Git LFS installed"};
  }
  constexpr std::size_t kPointer = 400;
  if (text.size() < kPointer && text.find("annex/objects/") != std::string_view::npos) {
    return StandIn{"a git-annex pointer (fetch the file itself with git annex get)", ""};
  }
  constexpr std::size_t kTag = 15;
  std::string tag(text.substr(0, kTag));
  std::ranges::transform(tag, tag.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (tag.starts_with("<!doctype html") || tag.starts_with("<html") || tag.starts_with("<head")) {
    return StandIn{"a web page (HTML)",
                   "Download the file itself: on GitHub by \"Download raw file\""};
  }
  if (head.starts_with("PK\x03\x04") || head.starts_with("\x1F\x8B") ||
      head.starts_with("7z\xBC\xAF") || head.starts_with("Rar!")) {
    return StandIn{"an archive or a compressed file", "Unpack it"};
  }
  return std::nullopt;
}

}  // namespace handway::geometric
