#pragma once

#include "handway/geometric/io/input_error.h"

#include <string>

namespace handway::test {

/// The message with which `action` refuses its input; empty if it doesn't.
template <typename Action>
[[nodiscard]] std::string refusal_of(Action&& action) {
  try {
    action();
  } catch (const geometric::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace handway::test
