#include "handway/device/core/device_stream.h"

#include <gtest/gtest.h>

namespace handway::device {
namespace {

TEST(StreamStatistics, MeasuresRateAndJitterOfTheLastSecond) {
  StreamStatisticsCounter counter;
  counter.connected(100.0, 0.004);
  for (int k = 0; k <= 300; ++k) {
    const double time = 0.01 * k + (k % 2 == 0 ? 0.001 : 0.0);
    counter.frame(time, time + 0.0005);
  }
  const StreamStatistics statistics = counter.at(3.0);
  EXPECT_EQ(statistics.frames, 301U);
  EXPECT_NEAR(statistics.rate, 100.0, 1.0);
  EXPECT_NEAR(statistics.jitter, 0.001, 0.0001);
  EXPECT_NEAR(statistics.handling, 0.0005, 1e-9);
  EXPECT_EQ(statistics.latency, 0.004);
  EXPECT_EQ(statistics.dropouts, 0U);
}

TEST(StreamStatistics, CountsDropouts) {
  StreamStatisticsCounter counter;
  counter.connected(100.0, 0.0);
  for (const double time : {0.0, 0.01, 0.02, 0.10, 0.11, 0.12}) {
    counter.frame(time, time);
  }
  EXPECT_EQ(counter.at(0.12).dropouts, 1U);
  EXPECT_NEAR(counter.at(0.12).longest_gap, 0.08, 1e-12);
}

TEST(StreamStatistics, SaysThatAStreamThatStoppedHasNoRate) {
  StreamStatisticsCounter counter;
  counter.connected(100.0, 0.0);
  for (int k = 0; k < 100; ++k) {
    counter.frame(0.01 * k, 0.01 * k);
  }
  EXPECT_LT(counter.at(1.5).rate, 60.0);
  EXPECT_EQ(counter.at(3.0).rate, 0.0);
}

TEST(StreamStatistics, CountsConnectionsAfterTheFirst) {
  StreamStatisticsCounter counter;
  counter.connected(100.0, 0.0);
  EXPECT_EQ(counter.at(0.0).reconnects, 0U);
  counter.connected(100.0, 0.0);
  EXPECT_EQ(counter.at(0.0).reconnects, 1U);
}

}  // namespace
}  // namespace handway::device
