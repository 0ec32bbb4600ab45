#include "counting_signal.h"
#include "handway/device/core/device_error.h"
#include "handway/device/emulators/device_emulator.h"
#include "handway/device/emulators/glove_emulator.h"
#include "handway/device/glove/cyberglove.h"
#include "handway/device/glove/cyberglove3_parser.h"
#include "handway_test/free_port.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

namespace handway::device {
namespace {

using Bytes = std::vector<std::uint8_t>;
using std::chrono::milliseconds;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// 22 sensors of 12 bits: 0x101, 0x202, … of which the parser takes the upper 8: 0x10, 0x20, …
Bytes record_of_rising_values(const std::string& time = "10:35:52:28:1S") {
  Bytes bytes(time.begin(), time.end());
  for (int k = 0; k < kGloveSensors; ++k) {
    const int value = 0x0B0 * k + 0x101;
    bytes.push_back(static_cast<std::uint8_t>(value >> 8));
    bytes.push_back(static_cast<std::uint8_t>(value));
  }
  bytes.insert(bytes.end(), {0x0D, 0x0A, 0x00});
  return bytes;
}

std::array<std::uint16_t, kGloveSensors> rising_counts() {
  std::array<std::uint16_t, kGloveSensors> counts{};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    counts[k] = static_cast<std::uint16_t>(0x10 + 0x0B * k);
  }
  return counts;
}

std::vector<CyberGloveRecord> parse(CyberGlove3Parser& parser, const Bytes& bytes) {
  std::vector<CyberGloveRecord> records;
  for (const std::uint8_t byte : bytes) {
    if (const auto record = parser.push(byte)) {
      records.push_back(*record);
    }
  }
  return records;
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

TEST(CyberGlove3Parser, ReadsARecordOfSixtyOneBytes) {
  ASSERT_THAT(record_of_rising_values(), SizeIs(CyberGlove3Parser::kRecordLength));
  CyberGlove3Parser parser;
  const auto records = parse(parser, record_of_rising_values());
  ASSERT_THAT(records, SizeIs(1));
  EXPECT_EQ(records[0].counts, rising_counts());
  EXPECT_EQ(parser.resynchronisations(), 0U);
}

TEST(CyberGlove3Parser, TakesTheLeastValuesForOneCount) {
  Bytes bytes = record_of_rising_values();
  bytes[14] = 0;
  bytes[15] = 3;
  CyberGlove3Parser parser;
  EXPECT_EQ(parse(parser, bytes).at(0).counts[0], 1);
}

TEST(CyberGlove3Parser, FindsItsPlaceAgainAfterEveryBreak) {
  const Bytes whole = record_of_rising_values();
  Bytes lost = whole;
  lost.erase(lost.begin() + 20);
  Bytes lost_in_time = whole;
  lost_in_time.erase(lost_in_time.begin() + 4);
  Bytes doubled = whole;
  doubled.insert(doubled.begin() + 21, doubled[21]);
  Bytes zeroed = whole;
  zeroed[14] = zeroed[15] = 0;
  const Bytes cut(whole.begin(), whole.begin() + 30);
  const Bytes noise{0xFF, '1', ':', 'S', 0x0D, 0x0A, 0x00, '1', '0'};
  // The ROS driver has seen the time begin with its last characters.
  const Bytes stray{'1', 'S'};
  for (const Bytes& broken : {lost, lost_in_time, doubled, zeroed, cut, noise, stray}) {
    CyberGlove3Parser parser;
    const auto records = parse(parser, whole + broken + whole + whole);
    ASSERT_THAT(records, SizeIs(3));
    for (const CyberGloveRecord& record : records) {
      EXPECT_EQ(record.counts, rising_counts());
    }
    EXPECT_EQ(parser.resynchronisations(), 1U);
    EXPECT_EQ(parser.dropped_bytes(), broken.size());
  }
}

TEST(CyberGlove3Parser, BeginsInTheMiddleOfAStream) {
  const Bytes whole = record_of_rising_values();
  CyberGlove3Parser parser;
  EXPECT_THAT(parse(parser, Bytes(whole.begin() + 17, whole.end()) + whole), SizeIs(1));
}

TEST(CyberGlove3Parser, NeverGivesACountOutOfRangeWhateverAMillionBytesSay) {
  std::mt19937_64 random(1);
  CyberGlove3Parser parser;
  for (int k = 0; k < 20000; ++k) {
    Bytes bytes = record_of_rising_values();
    bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    for (const CyberGloveRecord& record : parse(parser, bytes)) {
      ASSERT_THAT(record.counts, Each(testing::AllOf(testing::Ge(1), testing::Le(255))));
    }
  }
  EXPECT_GT(parser.resynchronisations(), 0U);
}

TEST(CyberGlove3Unit, StreamsNinetyRecordsASecondFromStartToStop) {
  CyberGlove3Unit unit(test::counting_signal());
  const auto send = [&](const std::string& text, double now) {
    EXPECT_THAT(unit.receive(Bytes(text.begin(), text.end()), now), IsEmpty());
  };
  send("1S", 0.0);
  EXPECT_THAT(unit.advance(0.1), IsEmpty()) << "USB was not enabled";
  send("1ts10:35:52", 0.1);
  send("1e", 0.1);
  send("u", 0.1);
  std::size_t count = 0;
  CyberGlove3Parser parser;
  for (int tick = 1; tick <= 10; ++tick) {
    for (const Bytes& record : unit.advance(0.1 + 0.1 * tick)) {
      EXPECT_THAT(record, SizeIs(CyberGlove3Parser::kRecordLength));
      count += parse(parser, record).size();
    }
  }
  EXPECT_NEAR(static_cast<double>(count), 90.0, 1.0);
  send("!!!", 1.2);
  EXPECT_EQ(unit.next_due(), std::nullopt);
  send("1S", 1.3);
  EXPECT_NE(unit.next_due(), std::nullopt);
  send("\x03", 1.4);
  EXPECT_EQ(unit.next_due(), std::nullopt);
}

std::vector<GloveFrame> read_frames(Glove& glove, std::size_t count) {
  std::vector<GloveFrame> frames;
  while (frames.size() < count) {
    const GloveReading reading = glove.next(milliseconds(1000));
    EXPECT_NE(reading.event, SampleEvent::kUnplugged);
    if (reading.event == SampleEvent::kSample) {
      frames.push_back(reading.sample);
    }
  }
  return frames;
}

TEST(CyberGlove3, IsReadInItsNativeStreamWhereItAnswersNoCommand) {
  DeviceEmulatorSettings settings;
  settings.faults.garbage = 0.05;
  const DeviceEmulator emulator(settings,
                                std::make_unique<CyberGlove3Unit>(test::counting_signal()));
  CyberGlove glove(emulator.address());
  const GloveInfo info = glove.connect();
  EXPECT_EQ(info.model, "CyberGlove III");
  EXPECT_EQ(info.sensors, 22);
  EXPECT_EQ(info.rate, 90.0);
  for (const GloveFrame& frame : read_frames(glove, 100)) {
    // A doubled or lost byte may leave the form as it was in the record's last sensors only.
    EXPECT_GE(std::count(frame.counts.begin(), frame.counts.end(), frame.counts[0]), 20);
  }
}

TEST(CyberGlove3, ConnectsOverWiFiToThePortThatIsListenedOn) {
  const std::string port = test::free_udp_port();
  DeviceEmulatorSettings settings;
  settings.tcp_server = "localhost:" + port;
  settings.greeting = {'o'};
  const DeviceEmulator emulator(settings, std::make_unique<CyberGloveUnit>(
                                              CyberGloveUnitSettings{}, test::counting_signal()));
  EXPECT_EQ(emulator.address(), "listen://" + port);
  CyberGlove glove(emulator.address());
  const GloveInfo info = glove.connect();
  EXPECT_THAT(info.model, HasSubstr("CyberGlove"));
  EXPECT_THAT(read_frames(glove, 20), SizeIs(20));
}

TEST(CyberGlove3, StopsListeningWhenAsked) {
  CyberGlove glove("listen://" + test::free_udp_port());
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(glove.connect(stop.get_token()), DeviceError);
}

}  // namespace
}  // namespace handway::device
