#pragma once

#include "handway/geometric/export.h"

#include <exception>
#include <stop_token>

namespace handway::geometric {

/// How a collision checker is prepared.
struct Preparation {
  /// Nobody wants the checker any more: making it ends with PreparationStopped.
  std::stop_token stop = {};
  /// Whether what takes long to derive of meshes is kept in the user's cache. Not worth it for
  /// what is edited right now, such as an object at every size that it is dragged through.
  bool keeps_volumes = true;
};

/// A preparation ended because it was asked to.
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
