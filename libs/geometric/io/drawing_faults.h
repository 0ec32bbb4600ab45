#pragma once

#include "handway/geometric/io/input_error.h"

#include <string>
#include <vector>

namespace handway::geometric {

/// What of a file can't be drawn. Planning does without it: reported in one warning.
class DrawingFaults {
 public:
  void add(const InputError& fault);

  /// "3 visual elements can't be read, the collision geometry is drawn instead: …"; empty
  /// if there is nothing to tell.
  [[nodiscard]] std::string summary() const;

 private:
  std::vector<std::string> faults_;
};

}  // namespace handway::geometric
