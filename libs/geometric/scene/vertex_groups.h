#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace handway::geometric {

/// Items in groups, one a vertex: in time that grows with their number alone.
template <typename Item>
class VertexGroups {
 public:
  /// @param visit calls its argument with the vertex and the item of each, the same at every call.
  template <typename Visit>
  VertexGroups(std::size_t vertex_count, const Visit& visit) : ends_(vertex_count + 1) {
    visit([this](std::uint32_t vertex, const Item&) { ++ends_[vertex + 1]; });
    for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
      ends_[vertex + 1] += ends_[vertex];
    }
    items_.resize(ends_.back());
    std::vector<std::size_t> next(ends_.begin(), ends_.end() - 1);
    visit([&](std::uint32_t vertex, const Item& item) { items_[next[vertex]++] = item; });
  }

  [[nodiscard]] std::size_t size() const { return ends_.size() - 1; }
  /// In the order in which they came.
  [[nodiscard]] std::span<Item> operator[](std::size_t vertex) {
    return {items_.data() + ends_[vertex], items_.data() + ends_[vertex + 1]};
  }

 private:
  std::vector<std::size_t> ends_;
  std::vector<Item> items_;
};

}  // namespace handway::geometric
