#pragma once

#include "handway/geometric/collision/collision_checker.h"

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace handway::python {

/// Lends a collision checker to whoever asks, one to a thread at a time, and keeps
/// those that come back.
class CheckerPool {
 public:
  explicit CheckerPool(std::shared_ptr<const geometric::CollisionChecker> prototype);

  /// Runs `work` with a checker that nobody else has. May be called from several threads.
  void lend(const std::function<void(geometric::CollisionChecker&)>& work);

 private:
  [[nodiscard]] std::unique_ptr<geometric::CollisionChecker> take();

  std::shared_ptr<const geometric::CollisionChecker> prototype_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<geometric::CollisionChecker>> idle_;
};

}  // namespace handway::python
