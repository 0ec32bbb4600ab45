#include "handway/device/tracker/polhemus_parser.h"

#include "handway/geometric/math/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

namespace handway::device {
namespace {

using Bytes = std::vector<std::uint8_t>;
using geometric::kDegree;

const std::string kText = "01   12.00  -3.50   7.25  30.00 -45.00  90.00\r\n";
const Bytes kBinary{0x30, 0x31, 0x20, 0x00, 0x00, 0x40, 0x41, 0x00, 0x00, 0x60, 0xC0,
                    0x00, 0x00, 0xE8, 0x40, 0xEA, 0x46, 0x77, 0x3F, 0x00, 0x00, 0x00,
                    0x00, 0x00, 0x00, 0x00, 0x00, 0xEE, 0x83, 0x84, 0x3E, 0x20};
const Bytes kLiberty{0x4C, 0x59, 0x01, 0x43, 0x20, 0x00, 0x28, 0x00, 0xE8, 0x03, 0x00, 0x00,
                     0xF0, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x40, 0x41,
                     0x00, 0x00, 0x60, 0xC0, 0x00, 0x00, 0xE8, 0x40, 0xEA, 0x46, 0x77, 0x3F,
                     0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xEE, 0x83, 0x84, 0x3E};

const Eigen::Vector3d kPosition = Eigen::Vector3d(12.0, -3.5, 7.25) * 0.0254;
const Eigen::Matrix3d kTurn =
    Eigen::AngleAxisd(30.0 * kDegree, Eigen::Vector3d::UnitZ()).toRotationMatrix();

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

FastrakFormat text_format() { return {{2, 4, 1}, false, false}; }

template <typename Parser>
std::vector<PolhemusRecord> one_by_one(Parser& parser, const Bytes& bytes) {
  std::vector<PolhemusRecord> records;
  for (const std::uint8_t byte : bytes) {
    for (PolhemusRecord& record : parser.push({&byte, 1})) {
      records.push_back(std::move(record));
    }
  }
  return records;
}

void expect_turn_about_z(const PolhemusRecord& record) {
  EXPECT_EQ(record.kind, PolhemusRecordKind::kPose);
  EXPECT_EQ(record.station, 1);
  EXPECT_TRUE(record.X_ST.translation().isApprox(kPosition, 1e-7));
  EXPECT_TRUE(record.X_ST.linear().isApprox(kTurn, 1e-6));
}

TEST(FastrakParser, KnowsTheLengthOfRecords) {
  EXPECT_EQ(FastrakFormat{}.record_length(), 32U);
  EXPECT_EQ(text_format().record_length(), 47U);
  EXPECT_EQ(LibertyFormat{}.body_length(), 40U);
}

TEST(FastrakParser, ReadsTheDefaultTextRecord) {
  FastrakParser parser(text_format());
  const auto records = one_by_one(parser, bytes_of(kText));
  ASSERT_EQ(records.size(), 1U);
  EXPECT_TRUE(records[0].X_ST.translation().isApprox(kPosition, 1e-12));
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(30.0 * kDegree, Eigen::Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(-45.0 * kDegree, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(90.0 * kDegree, Eigen::Vector3d::UnitX()))
                                .toRotationMatrix();
  EXPECT_TRUE(records[0].X_ST.linear().isApprox(R, 1e-12));
  EXPECT_FALSE(records[0].button);
  EXPECT_EQ(parser.dropped_bytes(), 0U);
}

TEST(FastrakParser, ReadsTheBinaryRecord) {
  FastrakParser parser({});
  const auto records = one_by_one(parser, kBinary);
  ASSERT_EQ(records.size(), 1U);
  expect_turn_about_z(records[0]);
}

TEST(FastrakParser, ReadsCentimetresAndTheStylusSwitch) {
  FastrakParser parser({{2, 4, 16, 1}, false, true});
  const auto records =
      one_by_one(parser, bytes_of("02   10.00   0.00   0.00   0.00   0.00   0.00 1\r\n"));
  ASSERT_EQ(records.size(), 1U);
  EXPECT_EQ(records[0].station, 2);
  EXPECT_NEAR(records[0].X_ST.translation().x(), 0.1, 1e-12);
  EXPECT_EQ(records[0].button, true);
}

TEST(FastrakParser, TellsStatusAndDoubtfulRecords) {
  FastrakParser parser({});
  Bytes distorted = kBinary;
  distorted[2] = 'D';
  const Bytes status = bytes_of("21S005" + std::string(47, ' ') + "\r\n");
  const auto records = one_by_one(parser, joined({status, distorted, kBinary}));
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[0].kind, PolhemusRecordKind::kReply);
  EXPECT_EQ(records[0].command, 'S');
  EXPECT_EQ(records[1].kind, PolhemusRecordKind::kDoubtful);
  EXPECT_EQ(records[1].error, 'D');
  expect_turn_about_z(records[2]);
}

TEST(FastrakParser, FindsARecordBehindAnyGarbage) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 1000; ++k) {
    Bytes garbage(random() % 60);
    std::ranges::generate(garbage, [&] { return static_cast<std::uint8_t>(random()); });
    // Half of a record comes first, as after a lost byte.
    const Bytes half(kBinary.begin(), kBinary.begin() + static_cast<int>(random() % 32));
    FastrakParser binary({});
    const auto records = binary.push(joined({garbage, half, kBinary, kBinary}));
    ASSERT_GE(records.size(), 1U);
    expect_turn_about_z(records.back());
    FastrakParser text(text_format());
    ASSERT_GE(text.push(joined({garbage, half, bytes_of(kText), bytes_of(kText)})).size(), 1U);
  }
}

TEST(FastrakParser, RefusesListsThatMakeNoPose) {
  EXPECT_THROW(FastrakParser({{2, 0}, true, false}), std::invalid_argument);
  EXPECT_THROW(FastrakParser({{4, 0}, true, false}), std::invalid_argument);
  EXPECT_THROW(FastrakParser({{2, 4, 99}, true, false}), std::invalid_argument);
  EXPECT_THROW(LibertyParser({{3, 8}, false}), std::invalid_argument);
  EXPECT_THROW(LibertyParser({{3, 7, 99}, false}), std::invalid_argument);
}

TEST(LibertyParser, ReadsTheBinaryRecord) {
  LibertyParser parser({});
  const auto records = one_by_one(parser, kLiberty);
  ASSERT_EQ(records.size(), 1U);
  expect_turn_about_z(records[0]);
  EXPECT_EQ(records[0].unit_time, 1.0);
}

TEST(LibertyParser, TellsRepliesAndDoubtfulRecords) {
  LibertyParser parser({});
  Bytes distorted = kLiberty;
  distorted[4] = 'a';
  const Bytes stations{'L', 'Y', 0, 0x15, ' ', 0, 4, 0, 1, 0, 1, 0};
  const auto records = one_by_one(parser, joined({stations, distorted, kLiberty}));
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[0].command, 0x15);
  EXPECT_EQ(records[0].body, (Bytes{1, 0, 1, 0}));
  EXPECT_EQ(records[1].kind, PolhemusRecordKind::kDoubtful);
  expect_turn_about_z(records[2]);
}

TEST(LibertyParser, FindsTheNextRecordAfterADamagedOne) {
  for (std::size_t at = 0; at < kLiberty.size(); ++at) {
    Bytes lost = kLiberty;
    lost.erase(lost.begin() + static_cast<std::ptrdiff_t>(at));
    LibertyParser parser({});
    const auto records = parser.push(joined({lost, kLiberty, kLiberty}));
    ASSERT_GE(records.size(), 1U) << at;
    EXPECT_EQ(records.back().kind, PolhemusRecordKind::kPose) << at;
  }
}

void expect_sound(const PolhemusRecord& record) {
  ASSERT_TRUE(record.X_ST.translation().allFinite());
  ASSERT_LE(record.X_ST.translation().norm(), 10.0);
  const Eigen::Matrix3d R = record.X_ST.linear();
  ASSERT_TRUE((R * R.transpose()).isIdentity(1e-9));
}

template <typename Parser>
void survive_a_million_bytes(Parser parser, const Bytes& record) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 1000000; k += 100) {
    Bytes bytes(100);
    std::ranges::generate(bytes, [&] { return static_cast<std::uint8_t>(random()); });
    // True heads with random numbers behind them get further into the parser.
    std::copy_n(record.begin(), 8, bytes.begin() + static_cast<std::ptrdiff_t>(random() % 90));
    for (const PolhemusRecord& found : parser.push(bytes)) {
      ASSERT_NO_FATAL_FAILURE(expect_sound(found));
    }
  }
  EXPECT_GT(parser.resynchronisations(), 0U);
}

TEST(PolhemusParsers, NeverGiveAnUnsoundPoseWhateverAMillionBytesSay) {
  survive_a_million_bytes(FastrakParser({}), kBinary);
  survive_a_million_bytes(FastrakParser(text_format()), bytes_of(kText));
  survive_a_million_bytes(FastrakParser({{2, 4, 0}, true, false}), kBinary);
  survive_a_million_bytes(LibertyParser({}), kLiberty);
  survive_a_million_bytes(LibertyParser({{3, 4}, false}), kLiberty);
}

TEST(PolhemusParsers, NeverGiveAnUnsoundPoseOfDamagedRecords) {
  std::mt19937_64 random(2);
  FastrakParser fastrak({});
  LibertyParser liberty({});
  for (int k = 0; k < 20000; ++k) {
    Bytes damaged = k % 2 == 0 ? kBinary : kLiberty;
    damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    for (const auto& records : {fastrak.push(damaged), liberty.push(damaged)}) {
      for (const PolhemusRecord& found : records) {
        ASSERT_NO_FATAL_FAILURE(expect_sound(found));
      }
    }
  }
}

}  // namespace
}  // namespace handway::device
