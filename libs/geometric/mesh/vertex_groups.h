#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace handway::geometric {

/// Items grouped by vertex: in time proportional to their number.
template <typename Item>
class VertexGroups {
 public:
  /// @param visit calls its argument with each item and its vertex, the same way at every call.
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
  /// Vertices in the order of their first occurrence.
  [[nodiscard]] std::span<Item> operator[](std::size_t vertex) {
    return {items_.data() + ends_[vertex], items_.data() + ends_[vertex + 1]};
  }

 private:
  std::vector<std::size_t> ends_;
  std::vector<Item> items_;
};

/// Numbers places in the order of their first occurrence; equal places share a number: -0 equals 0.
/// An open-addressing table, since meshes have millions of vertices.
class VertexTable {
 public:
  /// Returns the place's number; a new one is appended to vertices().
  std::uint32_t number_of(const Eigen::Vector3d& p) {
    if (2 * vertices_.size() >= slots_.size()) {
      grow();
    }
    std::uint32_t& slot = slots_[slot_of(p)];
    if (slot == kEmpty) {
      slot = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(p);
    }
    return slot;
  }

  [[nodiscard]] std::vector<Eigen::Vector3d>& vertices() { return vertices_; }

 private:
  static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t kFirst = 64;

  static std::size_t hash(const Eigen::Vector3d& p) {
    std::uint64_t hash = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double value = p[i] == 0.0 ? 0.0 : p[i];
      hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 32;
    }
    return hash;
  }

  // Returns the slot of the place, or the free slot for it.
  [[nodiscard]] std::size_t slot_of(const Eigen::Vector3d& p) const {
    std::size_t slot = hash(p) & (slots_.size() - 1);
    while (slots_[slot] != kEmpty && vertices_[slots_[slot]] != p) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
  }

  void grow() {
    slots_.assign(std::max(kFirst, 4 * slots_.size()), kEmpty);
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
      slots_[slot_of(vertices_[i])] = i;
    }
  }

  std::vector<std::uint32_t> slots_;  ///< A power of 2, at most half of them taken.
  std::vector<Eigen::Vector3d> vertices_;
};

}  // namespace handway::geometric
