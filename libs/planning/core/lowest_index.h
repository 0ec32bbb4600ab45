#pragma once

#include <atomic>

namespace handway::planning {

/// The lowest of the indices that several threads offer.
class LowestIndex {
 public:
  /// @param none what it is until one is offered: more than any.
  explicit LowestIndex(int none) : lowest_(none) {}

  void offer(int index) {
    int known = lowest_.load();
    while (index < known && !lowest_.compare_exchange_weak(known, index)) {
    }
  }

  [[nodiscard]] int get() const { return lowest_.load(); }

 private:
  std::atomic<int> lowest_;
};

}  // namespace handway::planning
