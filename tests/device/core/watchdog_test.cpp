/// Tests how long a device counts as silent, for a program that is delayed itself now and then.
#include "handway/device/core/watchdog.h"

#include <gtest/gtest.h>

namespace handway::device {
namespace {

using std::chrono::milliseconds;

const Watchdog::Clock::time_point kBegin{};

TEST(Watchdog, LastsWhileTheProgramListens) {
  Watchdog silence;
  silence.heard(kBegin);
  for (int ms = 2; ms < 300; ms += 2) {
    silence.listened(kBegin + milliseconds(ms));
  }
  EXPECT_EQ(silence.listened(kBegin + milliseconds(300)), milliseconds(300));
}

TEST(Watchdog, EndsWithAWord) {
  Watchdog silence;
  silence.heard(kBegin);
  silence.listened(kBegin + milliseconds(10));
  silence.heard(kBegin + milliseconds(12));
  EXPECT_EQ(silence.listened(kBegin + milliseconds(14)), milliseconds(2));
}

TEST(Watchdog, IsNotTheDevicesWhileTheProgramIsHeldUp) {
  Watchdog silence;
  silence.heard(kBegin);
  EXPECT_LE(silence.listened(kBegin + milliseconds(3000)), milliseconds(20));
  EXPECT_LE(silence.listened(kBegin + milliseconds(3002)), milliseconds(22));
}

}  // namespace
}  // namespace handway::device
