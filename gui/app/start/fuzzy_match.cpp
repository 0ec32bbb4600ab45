#include "app/start/fuzzy_match.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace handway::gui {
namespace {

constexpr int kBeginsText = 12;
constexpr int kBeginsWord = 8;
constexpr int kFollows = 9;
constexpr int kAnywhere = 1;
constexpr int kNever = std::numeric_limits<int>::min() / 2;

}  // namespace

// best[j]: the most that the letters so far earn if the last of them is letter j of the text.
std::optional<int> fuzzy_score(const QString& typed, const QString& text) {
  QString wanted = typed.toCaseFolded();
  wanted.remove(' ');
  if (wanted.isEmpty()) {
    return 0;
  }
  const QString letters = text.toCaseFolded();
  std::vector<int> best(static_cast<std::size_t>(letters.size()), kNever);
  for (int i = 0; i < wanted.size(); ++i) {
    std::vector<int> next(best.size(), kNever);
    int best_before = i == 0 ? 0 : kNever;
    for (int j = 0; j < letters.size(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      if (letters[j] == wanted[i]) {
        const bool begins_word = j > 0 && !letters[j - 1].isLetterOrNumber();
        const int worth = j == 0 ? kBeginsText : begins_word ? kBeginsWord : kAnywhere;
        const int apart = best_before + worth;
        const int follows = i > 0 && j > 0 ? best[at - 1] + kFollows : kNever;
        next[at] = std::max(apart, follows);
      }
      best_before = std::max(best_before, i == 0 ? 0 : best[at]);
    }
    best = std::move(next);
  }
  const int score = best.empty() ? kNever : *std::ranges::max_element(best);
  return score > 0 ? std::optional(score * 64 - static_cast<int>(letters.size())) : std::nullopt;
}

}  // namespace handway::gui
