#pragma once

#include "handway/geometric/export.h"

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace handway::geometric {

/// Why a pair of links need not be checked against each other.
enum class AllowedReason {
  kAdjacent,  ///< Joined by a joint: they touch by construction.
  kAlways,    ///< In collision in every sampled configuration.
  kNever,     ///< In collision in no sampled configuration.
  kUser,      ///< Somebody said so.
};

/// The word in SRDF files: "Adjacent", "Always", "Never", "User".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT const char* to_string(AllowedReason reason);

/// The allowed-collision matrix: pairs of link names with the reason. The order
/// of a pair's names does not matter.
class HANDWAY_GEOMETRIC_EXPORT AllowedCollisions {
 public:
  using Pair = std::pair<std::string, std::string>;  ///< Names in ascending order.

  void allow(const std::string& link_a, const std::string& link_b, AllowedReason reason);
  void forbid(const std::string& link_a, const std::string& link_b);

  [[nodiscard]] std::optional<AllowedReason> reason(const std::string& link_a,
                                                    const std::string& link_b) const;
  [[nodiscard]] const std::map<Pair, AllowedReason>& entries() const { return entries_; }

 private:
  std::map<Pair, AllowedReason> entries_;
};

}  // namespace handway::geometric
