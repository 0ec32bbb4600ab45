#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace handway::planning {

/// Counts the hand poses that a search for pre-grasps rejected, stage by stage, to say why
/// none of them is one.
struct PregraspRejections {
  int tried = 0;
  int too_wide = 0;      ///< The object, there, for any opened preshape.
  int too_thin = 0;      ///< For the one that is opened least.
  int out_of_reach = 0;  ///< The palm, for the arm.
  int in_object = 0;     ///< Palm, fingers or what they close on are in each other.
  int blocked = 0;       ///< By what is in the way.
  int one_sided = 0;     ///< Free, but no two fingers come to different sides.
  std::map<std::string, int> in_the_way;  ///< Objects, constraints and the robot itself.

  void block(const std::set<std::string>& by);
  /// Number of hand poses whose reason is known.
  [[nodiscard]] int judged() const { return in_object + blocked + one_sided; }
};

/// The stage that (nearly) no hand pose gets beyond, as a sentence about `object`, and what to do.
/// @param width the least that fingers would have to open for it. @param opening what they open to
/// at most; m. @param distance from the arm's base to it, m.
[[nodiscard]] std::string why_no_grasp(const PregraspRejections& rejections,
                                       std::string_view object, double width, double opening,
                                       double distance);

}  // namespace handway::planning
