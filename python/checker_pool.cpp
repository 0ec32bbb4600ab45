#include "checker_pool.h"

#include <utility>

namespace handway::python {

using geometric::CollisionChecker;

CheckerPool::CheckerPool(std::shared_ptr<const CollisionChecker> prototype)
    : prototype_(std::move(prototype)) {}

std::unique_ptr<CollisionChecker> CheckerPool::take() {
  const std::lock_guard lock(mutex_);
  if (idle_.empty()) {
    return prototype_->clone();
  }
  std::unique_ptr<CollisionChecker> checker = std::move(idle_.back());
  idle_.pop_back();
  return checker;
}

void CheckerPool::lend(const std::function<void(CollisionChecker&)>& work) {
  std::unique_ptr<CollisionChecker> checker = take();
  work(*checker);
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(checker));
}

}  // namespace handway::python
