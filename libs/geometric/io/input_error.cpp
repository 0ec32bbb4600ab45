#include "handway/geometric/io/input_error.h"

#include "handway/geometric/io/lower_case.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace handway::geometric {
namespace {

std::string sentence(const InputProblem& problem) {
  std::string text = problem.source;
  if (!problem.element.empty()) {
    text += (text.empty() ? "" : ": ") + problem.element;
  }
  text += (text.empty() ? "found " : ": found ") + problem.found;
  if (!problem.expected.empty()) {
    text += ", expected " + problem.expected;
  }
  text += '.';
  if (!problem.advice.empty()) {
    text += ' ' + problem.advice;
    if (text.back() != '.' && text.back() != '?') {
      text += '.';
    }
  }
  return text;
}

}  // namespace

InputError::InputError(InputProblem problem)
    : std::runtime_error(sentence(problem)), problem_(std::move(problem)) {}

namespace {

constexpr std::size_t kFew = 16;

// Insertions, deletions and replacements that turn one word into the other
// (Wagner and Fischer 1974, one row at a time).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::optional<std::string> slip_of(std::string_view word, std::span<const std::string> names) {
  constexpr std::size_t kMostLetters = 2;
  constexpr std::size_t kLongest = 200;
  std::size_t least = kMostLetters + 1;
  std::optional<std::string> meant;
  for (const std::string& name : names) {
    const std::size_t longer = std::max(word.size(), name.size());
    if (longer > kLongest) {
      continue;
    }
    const std::size_t distance =
        edit_distance(lower_case(std::string(word)), lower_case(std::string(name)));
    if (distance < least && distance < longer) {
      least = distance;
      meant = name;
    }
  }
  return meant;
}

std::string nearest_name(std::string_view word, std::span<const std::string> names) {
  std::string nearest;
  constexpr std::size_t kLongest = 200;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& name : names) {
    if (word.size() > kLongest || name.size() > kLongest) {
      continue;
    }
    const std::size_t distance = edit_distance(word, name);
    if (distance < least && distance < std::max(word.size(), name.size())) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::vector<std::string> nearest_names(std::string_view word, std::span<const std::string> names,
                                       std::size_t count) {
  constexpr std::size_t kLongest = 200;
  const std::string_view start = word.substr(0, kLongest);
  std::vector<std::pair<std::size_t, std::string>> all;
  for (const std::string& name : names) {
    all.emplace_back(edit_distance(start, name), name);
  }
  std::ranges::stable_sort(all, {}, [](const auto& one) { return one.first; });
  std::vector<std::string> nearest;
  for (const auto& [distance, name] : std::span(all).first(std::min(count, all.size()))) {
    nearest.push_back(name);
  }
  return nearest;
}

std::string advise_name(std::string_view word, std::span<const std::string> names) {
  if (const std::string nearest = nearest_name(word, names); !nearest.empty()) {
    return "Did you mean \"" + nearest + "\"?";
  }
  if (names.empty() || names.size() > kFew) {
    return "";
  }
  std::string list = "There are: ";
  for (const std::string& name : names) {
    list += (list.ends_with(' ') ? "" : ", ") + name;
  }
  return list;
}

}  // namespace handway::geometric
