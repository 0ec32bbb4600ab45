#include "handway/device/glove/cyberglove_parser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace handway::device {
namespace {

using Bytes = std::vector<std::uint8_t>;

// A relaxed hand, as the G reply of a CyberGlove II with 22 sensors.
const Bytes kRelaxed{0x47, 0x92, 0x79, 0x71, 0x80, 0x75, 0x5F, 0x41, 0x61, 0x6C, 0x4B, 0x98,
                     0x6E, 0x58, 0x45, 0x94, 0x72, 0x74, 0x53, 0x8C, 0x83, 0x87, 0x73, 0x00};
const std::array<std::uint16_t, kGloveSensors> kRelaxedCounts{146, 121, 113, 128, 117, 95, 65,  97,
                                                              108, 75,  152, 110, 88,  69, 148, 114,
                                                              116, 83,  140, 131, 135, 115};

std::vector<CyberGloveRecord> parse(CyberGloveParser& parser, const Bytes& bytes) {
  std::vector<CyberGloveRecord> records;
  for (const std::uint8_t byte : bytes) {
    if (const auto record = parser.push(byte)) {
      records.push_back(*record);
    }
  }
  return records;
}

std::vector<CyberGloveRecord> parse(const Bytes& bytes) {
  CyberGloveParser parser({});
  return parse(parser, bytes);
}

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

TEST(CyberGloveParser, ReadsTheRecordOfARelaxedHand) {
  const auto records = parse(kRelaxed);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].kind, CyberGloveRecordKind::kSample);
  EXPECT_EQ(records[0].counts, kRelaxedCounts);
}

TEST(CyberGloveParser, PutsTheValuesOf18SensorsWhere22HaveThem) {
  Bytes bytes{'S'};
  for (std::uint8_t k = 1; k <= 18; ++k) {
    bytes.push_back(k);
  }
  bytes.push_back(0);
  CyberGloveFormat format;
  format.sensors = 18;
  CyberGloveParser parser(format);
  const auto records = parse(parser, bytes);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_THAT(records[0].counts, testing::ElementsAre(1, 2, 3, 4, 5, 6, 0, 7, 8, 0, 9, 10, 11, 0,
                                                      12, 13, 14, 0, 15, 16, 17, 18));
}

TEST(CyberGloveParser, ReadsTimeStampAndStatus) {
  CyberGloveFormat format;
  format.time_stamp = true;
  format.status = true;
  CyberGloveParser parser(format);
  Bytes bytes(kRelaxed.begin(), kRelaxed.end() - 1);
  // The bits of the first byte say which of the four are really 0: here the first and third.
  for (const int byte : {0x85, 0x01, 0x02, 0x01, 0x04, 0x03, 0x00}) {
    bytes.push_back(static_cast<std::uint8_t>(byte));
  }
  const auto records = parse(parser, bytes);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].time_stamp, 0x00020004U);
  EXPECT_EQ(records[0].status, 3);
  EXPECT_EQ(records[0].counts, kRelaxedCounts);
}

TEST(CyberGloveParser, TellsErrorsAndTheEndOfTheStream) {
  const auto records = parse(
      {0x47, 0x65, 0x67, 0x00, 'S', 'e', 's', 0, 'S', 'e', 'y', 0, 'G', 'e', '?', 0, 0x03, 0x00});
  std::vector<CyberGloveRecordKind> kinds;
  for (const CyberGloveRecord& record : records) {
    kinds.push_back(record.kind);
  }
  using enum CyberGloveRecordKind;
  EXPECT_THAT(kinds,
              testing::ElementsAre(kUnplugged, kTooFast, kSyncRate, kUnknownCommand, kStopped));
}

TEST(CyberGloveParser, FindsItsPlaceAgainAfterEveryWayOfBreakingARecord) {
  Bytes lost = kRelaxed;
  lost.erase(lost.begin() + 5);
  Bytes doubled = kRelaxed;
  doubled.insert(doubled.begin() + 5, doubled[5]);
  Bytes zeroed = kRelaxed;
  zeroed[7] = 0;
  const Bytes cut(kRelaxed.begin(), kRelaxed.begin() + 9);
  const Bytes noise{0xFF, 0x13, 'S', 'S', 0x80, 0x00, 0x00, 0x47};
  for (const Bytes& broken : {lost, doubled, zeroed, cut, noise}) {
    CyberGloveParser parser({});
    const auto records = parse(parser, joined({kRelaxed, broken, kRelaxed, kRelaxed}));
    // A record without an end takes the next one with it; nothing else is lost, nothing made up.
    ASSERT_THAT(records.size(), testing::AnyOf(2U, 3U));
    for (const CyberGloveRecord& record : records) {
      EXPECT_EQ(record.counts, kRelaxedCounts);
    }
    EXPECT_EQ(parser.resynchronisations(), 1U);
    EXPECT_GT(parser.dropped_bytes(), 0U);
  }
}

TEST(CyberGloveParser, BeginsInTheMiddleOfAStream) {
  const Bytes rest(kRelaxed.begin() + 11, kRelaxed.end());
  EXPECT_EQ(parse(joined({rest, kRelaxed})).size(), 1U);
}

TEST(CyberGloveParser, ForgetsAHalfRecordWhenReset) {
  CyberGloveParser parser({});
  parse(parser, {0x47, 0x92, 0x79});
  parser.reset();
  EXPECT_EQ(parse(parser, kRelaxed).size(), 1U);
  EXPECT_EQ(parser.resynchronisations(), 0U);
}

TEST(CyberGloveParser, RefusesOtherNumbersOfSensors) {
  CyberGloveFormat format;
  format.sensors = 20;
  EXPECT_THROW(CyberGloveParser{format}, std::invalid_argument);
}

void expect_sound(const CyberGloveRecord& record, std::uint64_t& samples) {
  if (record.kind != CyberGloveRecordKind::kSample) {
    return;
  }
  ++samples;
  for (const std::uint16_t count : record.counts) {
    ASSERT_GE(count, 1);
    ASSERT_LE(count, 255);
  }
}

TEST(CyberGloveParser, NeverGivesACountOutOfRangeWhateverAMillionBytesSay) {
  std::mt19937_64 random(1);
  CyberGloveParser parser({});
  std::uint64_t samples = 0;
  for (int k = 0; k < 1000000; ++k) {
    if (const auto record = parser.push(static_cast<std::uint8_t>(random()))) {
      ASSERT_NO_FATAL_FAILURE(expect_sound(*record, samples));
    }
  }
  EXPECT_GT(parser.resynchronisations(), 0U);
}

TEST(CyberGloveParser, ReadsTheGoodOnesOfAMillionRandomFrames) {
  std::mt19937_64 random(2);
  CyberGloveParser parser({});
  std::uint64_t sent = 0;
  std::uint64_t samples = 0;
  for (int k = 0; k < 1000000; ++k) {
    Bytes frame(kRelaxed.size());
    frame[0] = k % 2 == 0 ? 'S' : 'G';
    std::uint64_t bits = 0;
    for (std::size_t at = 1; at + 1 < frame.size(); ++at) {
      bits = (at - 1) % 8 == 0 ? random() : bits >> 8U;
      frame[at] = static_cast<std::uint8_t>(bits);  // Now and then 00: a broken frame.
    }
    bool good = std::find(frame.begin(), frame.end() - 1, 0) == frame.end() - 1;
    if (random() % 16 == 0) {
      frame.resize(random() % (frame.size() - 1));
      frame.push_back(0);
      good = false;
    }
    sent += good ? 1 : 0;
    for (const std::uint8_t byte : frame) {
      if (const auto record = parser.push(byte)) {
        ASSERT_NO_FATAL_FAILURE(expect_sound(*record, samples));
      }
    }
  }
  EXPECT_EQ(samples, sent);
}

}  // namespace
}  // namespace handway::device
