#include "grasps/pregrasp_rejections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::planning {
namespace {

using ::testing::StartsWith;

// 1,000 places of the hand around a can of 80 mm; the hand opens to 100 mm.
std::string why(const PregraspRejections& rejections) {
  return why_no_grasp(rejections, "can", 0.08, 0.1, 0.7);
}

TEST(WhyNoGrasp, NamesWhatRuledOutNearlyAllPlaces) {
  PregraspRejections rejections;
  rejections.tried = 1000;
  rejections.too_wide = 995;
  EXPECT_THAT(why(rejections), StartsWith("can is too wide for the hand: it is 80 mm across"));
  rejections.too_wide = 0;
  rejections.too_thin = 995;
  EXPECT_THAT(why(rejections), StartsWith("can is too thin for the hand"));
  rejections.too_thin = 0;
  rejections.out_of_reach = 995;
  EXPECT_THAT(why(rejections), StartsWith("can is out of the arm's reach"));
  rejections.out_of_reach = 0;
  rejections.in_object = 995;
  EXPECT_THAT(why(rejections), StartsWith("The hand does not fit around can"));
}

TEST(WhyNoGrasp, NamesWhatIsInTheWay) {
  PregraspRejections rejections;
  rejections.tried = 100;
  for (int i = 0; i < 40; ++i) {
    rejections.block({"wall"});
  }
  EXPECT_THAT(why(rejections), StartsWith("wall is in the way: at 40 of 40 places"));
}

}  // namespace
}  // namespace handway::planning
