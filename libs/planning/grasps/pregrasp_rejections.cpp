#include "grasps/pregrasp_rejections.h"

#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>

namespace handway::planning {
namespace {

constexpr int kFewRatio = 50;  // one in so many, or less

bool is_few(int some, int of) { return kFewRatio * some < of; }

}  // namespace

void PregraspRejections::block(const std::set<std::string>& by) {
  ++blocked;
  for (const std::string& name : by) {
    ++in_the_way[name];
  }
}

std::string why_no_grasp(const PregraspRejections& rejections, std::string_view object,
                         double width, double opening, double distance) {
  const int fitting = rejections.tried - rejections.too_wide - rejections.too_thin;
  if (is_few(fitting, rejections.tried)) {
    return rejections.too_wide > rejections.too_thin
               ? fmt::format(
                     "{} is too wide for the hand: it is {:.0f} mm across where it is narrowest, "
                     "and the fingers open to {:.0f} mm. Choose a smaller object, or mount a hand "
                     "that opens wider.",
                     object, geometric::millimetres(width), geometric::millimetres(opening))
               : fmt::format(
                     "{} is too thin for the hand, whose opened fingers are farther apart than "
                     "they close. Choose a larger object, or mount a smaller hand.",
                     object);
  }
  const int reached = fitting - rejections.out_of_reach;
  if (is_few(reached, fitting)) {
    return fmt::format(
        "{} is out of the arm's reach: of {} places of the hand around it the arm gets to {}. Move "
        "it nearer to the robot, whose base is {:.2f} m away, or turn it.",
        object, fitting, reached, distance);
  }
  const int judged = rejections.judged();
  if (is_few(rejections.blocked + rejections.one_sided, judged)) {
    return fmt::format(
        "The hand does not fit around {}: at {} of {} places that the arm gets to, its palm or "
        "fingers would be in it. Choose a smaller object, or mount a hand that opens wider.",
        object, rejections.in_object, judged);
  }
  const auto most = std::ranges::max_element(rejections.in_the_way, {},
                                             [](const auto& entry) { return entry.second; });
  if (rejections.one_sided >= rejections.blocked || most == rejections.in_the_way.end()) {
    return fmt::format(
        "The fingers do not get around {}: at {} places that the arm gets to, no two of them come "
        "to different sides of it. Choose an object of another size, or mount another hand.",
        object, rejections.one_sided);
  }
  return fmt::format(
      "{} is in the way: at {} of {} places of the hand around {} that the arm gets to, robot or "
      "hand would touch it. Move {} or what is in the way.",
      most->first, most->second, rejections.blocked, object, object);
}

}  // namespace handway::planning
