#include "left_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <utility>

namespace handway::tools {
namespace {

// A reason without what differs between files of the same fault: names and numbers of the problem.
std::string kind_of(const planning::LeftOutProblem& problem) {
  const std::size_t begin = problem.reason.find(": ");
  std::string kind = begin == std::string::npos ? problem.reason : problem.reason.substr(begin);
  std::erase_if(kind, [](unsigned char c) { return std::isdigit(c) != 0; });
  return problem.problem.file.parent_path().string() + kind;
}

}  // namespace

std::vector<LeftOut> grouped(std::span<const planning::LeftOutProblem> problems) {
  std::vector<LeftOut> groups;
  std::vector<std::size_t> counts;
  std::map<std::string, std::size_t> known;
  for (const planning::LeftOutProblem& problem : problems) {
    const auto [kind, is_new] = known.emplace(kind_of(problem), groups.size());
    if (is_new) {
      groups.push_back({problem.problem.name, problem.reason});
      counts.push_back(0);
    }
    ++counts[kind->second];
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (counts[i] > 1) {
      groups[i].problems += fmt::format(" and {} more", counts[i] - 1);
    }
  }
  return groups;
}

}  // namespace handway::tools
