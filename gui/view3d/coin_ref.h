#pragma once

#include <utility>

namespace handway::gui {

/// Shared ownership of a Coin node through its own reference count.
template <typename Node>
class CoinRef {
 public:
  CoinRef() = default;
  explicit CoinRef(Node* node) : node_(node) {
    if (node_) {
      node_->ref();
    }
  }
  CoinRef(const CoinRef& other) : CoinRef(other.node_) {}
  CoinRef(CoinRef&& other) noexcept : node_(std::exchange(other.node_, nullptr)) {}
  CoinRef& operator=(CoinRef other) noexcept {
    std::swap(node_, other.node_);
    return *this;
  }
  ~CoinRef() {
    if (node_) {
      node_->unref();
    }
  }

  [[nodiscard]] Node* get() const { return node_; }
  Node* operator->() const { return node_; }
  explicit operator bool() const { return node_ != nullptr; }

 private:
  Node* node_ = nullptr;
};

template <typename Node, typename... Arguments>
[[nodiscard]] CoinRef<Node> make_coin(Arguments&&... arguments) {
  return CoinRef<Node>(new Node(std::forward<Arguments>(arguments)...));
}

}  // namespace handway::gui
