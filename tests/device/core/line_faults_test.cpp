#include "handway/device/emulators/device_emulator.h"

#include <gtest/gtest.h>

namespace handway::device {
namespace {

const std::vector<std::uint8_t> kRecord{'S', 1, 2, 3, 4, 5, 0};

TEST(LineFaults, LeaveRecordsAloneUnlessTold) {
  LineFaults faults({});
  for (int k = 0; k < 100; ++k) {
    EXPECT_EQ(faults.apply(kRecord), kRecord);
  }
  EXPECT_EQ(faults.count(), 0U);
}

TEST(LineFaults, LoseAndDamageAsManyRecordsAsTold) {
  LineFaultSettings settings;
  settings.dropout = 0.1;
  settings.garbage = 0.2;
  LineFaults faults(settings);
  int lost = 0;
  for (int k = 0; k < 10000; ++k) {
    lost += faults.apply(kRecord).empty() ? 1 : 0;
  }
  EXPECT_NEAR(lost, 1000 + 9000 * 0.2 / 5 / 7, 150);  // Some are cut before their first byte.
  EXPECT_NEAR(static_cast<double>(faults.count()), 1000 + 9000 * 0.2, 200);
}

TEST(LineFaults, AreTheSameForTheSameSeed) {
  LineFaultSettings settings;
  settings.garbage = 0.5;
  LineFaults a(settings);
  LineFaults b(settings);
  for (int k = 0; k < 200; ++k) {
    EXPECT_EQ(a.apply(kRecord), b.apply(kRecord));
  }
}

TEST(LineFaults, RefuseImpossibleProbabilities) {
  LineFaultSettings settings;
  settings.dropout = 1.5;
  EXPECT_THROW(LineFaults{settings}, std::invalid_argument);
}

}  // namespace
}  // namespace handway::device
