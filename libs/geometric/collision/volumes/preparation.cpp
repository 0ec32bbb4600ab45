#include "handway/geometric/collision/volumes/preparation.h"

namespace handway::geometric {

const char* PreparationStopped::what() const noexcept {
  return "the collision checker is not needed any more";
}

void end_if_stopped(const std::stop_token& stop) {
  if (stop.stop_requested()) {
    throw PreparationStopped();
  }
}

}  // namespace handway::geometric
