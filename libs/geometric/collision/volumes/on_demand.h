#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace handway::geometric {

/// Value that is made on first access, by any thread. Copies share it.
template <typename Value>
class OnDemand {
 public:
  explicit OnDemand(Value value) : state_(std::make_shared<State>()) {
    state_->set(std::move(value));
  }
  explicit OnDemand(std::function<Value()> make) : state_(std::make_shared<State>()) {
    state_->make = std::move(make);
  }

  [[nodiscard]] const Value& operator*() const {
    const Value* made = state_->made.load(std::memory_order_acquire);
    return made != nullptr ? *made : state_->get();
  }
  [[nodiscard]] const Value* operator->() const { return &**this; }

  /// Makes it now.
  void make() const { static_cast<void>(**this); }

 private:
  struct State {
    void set(Value&& given) {
      value.emplace(std::move(given));
      make = nullptr;  // and what it holds
      made.store(&*value, std::memory_order_release);
    }

    const Value& get() {
      const std::scoped_lock lock(mutex);
      if (!value) {
        set(make());
      }
      return *value;
    }

    std::atomic<const Value*> made = nullptr;
    std::optional<Value> value;
    std::function<Value()> make;
    std::mutex mutex;
  };

  std::shared_ptr<State> state_;
};

}  // namespace handway::geometric
