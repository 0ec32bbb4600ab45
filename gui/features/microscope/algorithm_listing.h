#pragma once

#include <span>
#include <string_view>

namespace handway::gui {

/// Algorithms 1 to 4 of the paper (sections 5.1 to 5.3), its lines in other words.
struct AlgorithmListing {
  int algorithm;
  const char* title;                        ///< "SampleArm(step, ρₐ)"
  std::span<const std::string_view> lines;  ///< Line 1 first, indented by two spaces a level.
};

/// Returns the listing of an algorithm. @pre algorithm is 1 to 4.
[[nodiscard]] const AlgorithmListing& algorithm_listing(int algorithm);

}  // namespace handway::gui
