#include "handway/geometric/io/alike_lines.h"

#include "handway/geometric/io/number_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <string_view>

namespace handway::geometric {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::size_t kFewestWords = 15;  // shorter lines are alike by chance
constexpr std::size_t kMostWords = 80;
constexpr std::size_t kMostLines = 2000;  // more are not compared
constexpr std::size_t kMostKinds = 40;    // kinds that a line is compared with
constexpr std::size_t kMostNamed = 5;

// Lengths of the longest common subsequences of the ends of both.
std::vector<std::vector<std::size_t>> common_ends(const Words& a, const Words& b) {
  std::vector<std::vector<std::size_t>> length(a.size() + 1,
                                               std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = a.size(); i-- > 0;) {
    for (std::size_t j = b.size(); j-- > 0;) {
      length[i][j] =
          a[i] == b[j] ? length[i + 1][j + 1] + 1 : std::max(length[i + 1][j], length[i][j + 1]);
    }
  }
  return length;
}

bool are_alike(const Words& a, const Words& b) {
  const std::size_t longer = std::max(a.size(), b.size());
  if (std::min(a.size(), b.size()) < kFewestWords || longer > kMostWords) {
    return false;
  }
  return 10 * common_ends(a, b)[0][0] >= 6 * longer;
}

// Returns the subject of the second line: its first word that differs from the first line.
std::string difference(const Words& a, const Words& b) {
  const auto length = common_ends(a, b);
  std::size_t i = 0;
  for (std::size_t j = 0; j < b.size();) {
    if (i < a.size() && a[i] == b[j]) {
      ++i;
      ++j;
    } else if (i < a.size() && length[i + 1][j] >= length[i][j + 1]) {
      ++i;
    } else {
      const std::string_view word = b[j];
      return std::string(word.substr(0, word.find_last_not_of(":,;.") + 1));
    }
  }
  return "";
}

struct Kind {
  std::string line;
  Words words;
  std::size_t more = 0;
  std::vector<std::string> named = {};  ///< Subjects of further lines, each once.
};

std::string text_of(const Kind& kind) {
  if (kind.more == 0) {
    return kind.line;
  }
  const std::size_t named = std::min(kMostNamed, kind.named.size());
  return fmt::format(
      "{} ({} more alike{}{}{})", kind.line, kind.more, named > 0 ? ": " : "",
      fmt::join(kind.named.begin(), kind.named.begin() + static_cast<std::ptrdiff_t>(named), ", "),
      kind.named.size() > named ? ", …" : "");
}

}  // namespace

std::vector<std::string> merged_alike(const std::vector<std::string>& lines) {
  if (lines.size() > kMostLines) {
    return lines;
  }
  std::vector<Kind> kinds;
  for (const std::string& line : lines) {
    const Words words = cells(line, ' ');
    const std::span compared(kinds.data(), std::min(kMostKinds, kinds.size()));
    const auto alike = std::ranges::find_if(
        compared, [&](const Kind& kind) { return are_alike(kind.words, words); });
    if (alike == compared.end()) {
      kinds.push_back({line, words});
      continue;
    }
    ++alike->more;
    if (const std::string name = difference(alike->words, words);
        !name.empty() && std::ranges::count(alike->named, name) == 0) {
      alike->named.push_back(name);
    }
  }
  std::vector<std::string> merged;
  std::ranges::transform(kinds, std::back_inserter(merged), text_of);
  return merged;
}

}  // namespace handway::geometric
