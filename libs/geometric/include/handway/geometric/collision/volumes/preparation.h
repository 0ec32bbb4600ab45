#pragma once

#include "handway/geometric/export.h"

#include <exception>
#include <stop_token>

namespace handway::geometric {

/// Options of preparing a collision checker.
struct Preparation {
  /// Cancels the preparation, which then throws PreparationStopped.
  std::stop_token stop = {};
  /// True if volumes that take long to derive from meshes are stored in the user's cache. False for
  /// objects being edited, such as every size of an object that is dragged.
  bool keeps_volumes = true;
};

/// Thrown by a preparation that was stopped.
class HANDWAY_GEOMETRIC_EXPORT PreparationStopped : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override {
    return "the collision checker is not needed any more";
  }
};

/// @throws PreparationStopped if `stop` was requested.
inline void end_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) {
    throw PreparationStopped();
  }
}

}  // namespace handway::geometric
