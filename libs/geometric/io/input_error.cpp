#include "handway/geometric/io/input_error.h"

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

}  // namespace handway::geometric
