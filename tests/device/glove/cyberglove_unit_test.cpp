#include "handway/device/emulators/glove_emulator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace handway::device {
namespace {

using UnitBytes = CyberGloveUnit::Bytes;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::array<std::uint16_t, kGloveSensors> kCountsAtRest{146, 121, 113, 128, 117, 95, 65,  97,
                                                             108, 75,  152, 110, 88,  69, 148, 114,
                                                             116, 83,  140, 131, 135, 115};

CyberGloveUnit make_unit(const CyberGloveUnitSettings& settings = {}) {
  return {settings, [](double) { return kCountsAtRest; }};
}

UnitBytes ask(CyberGloveUnit& unit, const UnitBytes& command, double now = 0.0) {
  return unit.receive(command, now);
}

std::string ask_text(CyberGloveUnit& unit, const std::string& command) {
  const UnitBytes answer = unit.receive(UnitBytes(command.begin(), command.end()), 0.0);
  return {answer.begin(), answer.end()};
}

TEST(CyberGloveUnit, GivesTheRecordOfARelaxedHand) {
  CyberGloveUnit unit = make_unit();
  EXPECT_THAT(ask(unit, {0x47}),
              ElementsAre(0x47, 0x92, 0x79, 0x71, 0x80, 0x75, 0x5F, 0x41, 0x61, 0x6C, 0x4B, 0x98,
                          0x6E, 0x58, 0x45, 0x94, 0x72, 0x74, 0x53, 0x8C, 0x83, 0x87, 0x73, 0x00));
}

TEST(CyberGloveUnit, LeavesOutTheDistalSensorsOf18) {
  CyberGloveUnitSettings settings;
  settings.sensors = 18;
  CyberGloveUnit unit = make_unit(settings);
  const UnitBytes record = ask(unit, {0x47});
  ASSERT_THAT(record, SizeIs(20));
  EXPECT_EQ(record[7], 0x61);  // Middle inner follows index middle.
  EXPECT_THAT(ask(unit, {'?', 'S'}), ElementsAre('?', 'S', 0x12, 0));
}

TEST(CyberGloveUnit, AnswersQueries) {
  CyberGloveUnit unit = make_unit();
  EXPECT_THAT(ask(unit, {0x3F, 0x47}), ElementsAre(0x3F, 0x47, 0x03, 0x00));
  EXPECT_THAT(ask(unit, {'?', 'S'}), ElementsAre('?', 'S', 0x16, 0));
  EXPECT_THAT(ask(unit, {'?', 'R'}), ElementsAre('?', 'R', 1, 0));
  EXPECT_THAT(ask(unit, {'?', 'V'}), SizeIs(7));
  EXPECT_THAT(ask(unit, {'?', 'T'}), ElementsAre('?', 'T', 0x04, 0x80, 0, 1, 0));
  EXPECT_THAT(ask(unit, {'?', 'Z'}), ElementsAre('?', 'Z', 'e', '?', 0));
}

TEST(CyberGloveUnit, TellsThatNoGloveIsPluggedIn) {
  CyberGloveUnit unit = make_unit();
  unit.set_plugged(false);
  EXPECT_THAT(ask(unit, {0x47}), ElementsAre(0x47, 0x65, 0x67, 0x00));
  EXPECT_THAT(ask(unit, {0x3F, 0x47}), ElementsAre(0x3F, 0x47, 0x01, 0x00));
}

TEST(CyberGloveUnit, TakesSettingsHoweverTheirBytesArrive) {
  CyberGloveUnit unit = make_unit();
  EXPECT_THAT(ask(unit, {0x54, 0x04}), IsEmpty());
  EXPECT_THAT(ask(unit, {0x80, 0x00, 0x01, 0x46, 0x01}), ElementsAre(0x54, 0x00, 0x46, 0x00));
  EXPECT_THAT(ask(unit, {'?', 'F'}), ElementsAre('?', 'F', 1, 0));
}

TEST(CyberGloveUnit, RefusesRatesThatTheLineCanNotCarry) {
  CyberGloveUnit unit = make_unit();
  EXPECT_THAT(ask(unit, {'T', 0, 100, 0, 1}), ElementsAre('T', 'e', 's', 0));  // 1152 Hz
}

TEST(CyberGloveUnit, StreamsAtTheRateThatWasSetUntilItIsStopped) {
  CyberGloveUnit unit = make_unit();
  ask(unit, {0x54, 0x0F, 0x00, 0x00, 0x01});  // 30 Hz
  ask(unit, {'S'}, 0.0);
  std::size_t records = 0;
  for (double now = 0.0; now <= 2.0; now += 0.01) {
    for (const UnitBytes& record : unit.advance(now)) {
      EXPECT_EQ(record.size(), 24U);
      EXPECT_EQ(record[0], 'S');
      ++records;
    }
  }
  EXPECT_NEAR(static_cast<double>(records), 60.0, 1.0);
  EXPECT_THAT(ask(unit, {'?', 'S'}, 2.0), IsEmpty()) << "only stop is heard while it streams";
  EXPECT_THAT(ask(unit, {0x03}, 2.0), ElementsAre(0x03, 0x00));
  EXPECT_THAT(unit.advance(3.0), IsEmpty());
}

TEST(CyberGloveUnit, SaysOnceThatTheGloveWasPulledOffTheStream) {
  CyberGloveUnit unit = make_unit();
  ask(unit, {'S'}, 0.0);
  unit.set_plugged(false);
  EXPECT_THAT(unit.advance(0.02), ElementsAre(ElementsAre('S', 'e', 'g', 0)));
  EXPECT_THAT(unit.advance(0.1), IsEmpty());
}

TEST(CyberGloveUnit, AddsTimeStampAndStatusWithoutEverSending0) {
  CyberGloveUnit unit = make_unit();
  ask(unit, {'D', 1, 'U', 1});
  const UnitBytes record = ask(unit, {'G'}, 1.5);
  ASSERT_THAT(record, SizeIs(30));
  EXPECT_EQ(std::count(record.begin(), record.end(), 0), 1);
  EXPECT_EQ(record[28], 1);
}

TEST(CyberGloveUnit, RefusesWhatItDoesNotKnow) {
  CyberGloveUnit unit = make_unit();
  EXPECT_THAT(ask(unit, {'Z'}), ElementsAre('Z', 'e', '?', 0));
  EXPECT_THAT(ask(unit, {0x99}), ElementsAre(0x99, 'e', '?', 0));
}

TEST(CyberGloveUnit, IsDeafWhileItRestarts) {
  CyberGloveUnit unit = make_unit();
  EXPECT_THAT(ask(unit, {0x12}, 1.0), ElementsAre(0x12));
  EXPECT_THAT(ask(unit, {'G'}, 2.0), IsEmpty());
  EXPECT_THAT(unit.advance(2.76), ElementsAre(ElementsAre(0)));
  EXPECT_THAT(ask(unit, {'G'}, 3.0), SizeIs(24));
}

TEST(CyberGloveUnit, ForgetsHalfACommandAfterASecond) {
  CyberGloveUnit unit = make_unit();
  ask(unit, {'T', 4}, 0.0);
  EXPECT_THAT(ask(unit, {'?', 'G'}, 2.0), ElementsAre('?', 'G', 3, 0));
}

TEST(CyberGloveUnit, SpeaksAsciiToo) {
  CyberGloveUnit unit = make_unit();
  EXPECT_EQ(
      ask_text(unit, "g\r"),
      "g 146 121 113 128 117 95 65 97 108 75 152 110 88 69 148 114 116 83 140 131 135 115\r\n");
  EXPECT_EQ(ask_text(unit, "t 1536 1\r"), "t 6 0 0 1\r\n");
  EXPECT_EQ(ask_text(unit, "?s\r"), "?s 22\r\n");
  EXPECT_THAT(ask_text(unit, "i\r"), HasSubstr("CyberGlove"));
  EXPECT_EQ(ask_text(unit, "zz\r"), "e?\r\n");
}

TEST(CyberGloveUnit, UnderstandsTheSpelledFormOfCtrlC) {
  CyberGloveUnit unit = make_unit();
  ask(unit, {'S'}, 0.0);
  EXPECT_EQ(ask_text(unit, "^C"), std::string("^C\r\n\0", 5));
  EXPECT_FALSE(unit.streaming());
}

TEST(CyberGloveUnit, SurvivesWhateverAHostSends) {
  CyberGloveUnit unit = make_unit();
  std::uint32_t state = 1;
  for (int k = 0; k < 200000; ++k) {
    state = state * 1664525U + 1013904223U;
    const auto byte = static_cast<std::uint8_t>(state >> 24U);
    (void)unit.receive({&byte, 1}, k * 0.0001);
    (void)unit.advance(k * 0.0001);
  }
}

}  // namespace
}  // namespace handway::device
