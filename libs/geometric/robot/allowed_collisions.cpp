#include "handway/geometric/robot/robot_description.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace handway::geometric {
namespace {

AllowedCollisions::Pair ordered(const std::string& a, const std::string& b) {
  return std::minmax(a, b);
}

}  // namespace

const char* to_string(AllowedReason reason) {
  static constexpr std::array<const char*, 5> kWords = {"Adjacent", "Always", "Never", "Default",
                                                        "User"};
  return kWords[static_cast<std::size_t>(reason)];
}

void AllowedCollisions::allow(const std::string& link_a, const std::string& link_b,
                              AllowedReason reason) {
  entries_[ordered(link_a, link_b)] = reason;
}

void AllowedCollisions::forbid(const std::string& link_a, const std::string& link_b) {
  entries_.erase(ordered(link_a, link_b));
}

std::optional<AllowedReason> AllowedCollisions::reason(const std::string& link_a,
                                                       const std::string& link_b) const {
  const auto entry = entries_.find(ordered(link_a, link_b));
  return entry == entries_.end() ? std::nullopt : std::optional(entry->second);
}

}  // namespace handway::geometric
