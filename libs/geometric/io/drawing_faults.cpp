#include "io/drawing_faults.h"

#include <fmt/format.h>

#include <algorithm>

namespace handway::geometric {

void DrawingFaults::add(const InputError& fault) {
  const InputProblem& problem = fault.problem();
  faults_.push_back(fmt::format("{}: {}: {}", problem.source, problem.element, problem.found));
}

std::string DrawingFaults::summary() const {
  constexpr std::size_t kMostNamed = 3;
  if (faults_.empty()) {
    return "";
  }
  std::string text = fmt::format(
      "{} visual element{} can't be read, the collision geometry is drawn where nothing else is: ",
      faults_.size(), faults_.size() == 1 ? "" : "s");
  const std::size_t named = std::min(kMostNamed, faults_.size());
  for (std::size_t i = 0; i < named; ++i) {
    text += (i == 0 ? "" : "; ") + faults_[i];
  }
  if (faults_.size() > named) {
    text += fmt::format("; and {} more", faults_.size() - named);
  }
  return text;
}

}  // namespace handway::geometric
