#include "handway/device/glove/landmark_glove.h"

#include "handway/device/core/device_error.h"
#include "handway/device/emulators/landmark_unit.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/io/input_error.h"
#include "handway_test/free_port.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

namespace handway::device {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;

HandSignal still_hand() {
  return [](double time) {
    GloveAngles angles{time, {}};
    angles.angles.at(static_cast<std::size_t>(*find_sensor("IndexPIJ"))) = 0.7;
    angles.angles.at(static_cast<std::size_t>(*find_sensor("ThumbRotate"))) = 0.5;
    angles.angles.at(static_cast<std::size_t>(*find_sensor("ThumbAbduct"))) = 0.4;
    return angles;
  };
}

DeviceEmulatorSettings to_udp(const std::string& port) {
  DeviceEmulatorSettings settings;
  settings.udp_receiver = port;
  return settings;
}

DeviceEmulatorSettings fetched_by_tcp() {
  DeviceEmulatorSettings settings;
  settings.tcp_port = 0;
  return settings;
}

/// The next frame, for as long as it takes.
GloveFrame frame_of(LandmarkGlove& glove) {
  for (int k = 0; k < 100; ++k) {
    const GloveReading reading = glove.next(milliseconds(1000));
    if (reading.event == SampleEvent::kSample) {
      return reading.sample;
    }
  }
  ADD_FAILURE() << "no frame";
  return {};
}

double angle(const GloveFrame& frame, const char* sensor) {
  return frame.angles->at(static_cast<std::size_t>(*find_sensor(sensor)));
}

void expect_still_hand(LandmarkGlove& glove) {
  const GloveFrame frame = frame_of(glove);
  ASSERT_TRUE(frame.angles);
  EXPECT_NEAR(angle(frame, "IndexPIJ"), 0.7, 1e-6);
  EXPECT_NEAR(angle(frame, "ThumbRotate"), 0.5, 1e-6);
  EXPECT_NEAR(angle(frame, "MiddlePIJ"), 0.0, 1e-6);
  EXPECT_TRUE(std::isnan(angle(frame, "WristYaw")));
  EXPECT_EQ(to_angles(frame, GloveCalibration{}).angles.at(4), frame.angles->at(4))
      << "what measures angles needs no calibration";
}

TEST(LandmarkGlove, MeasuresTheHandThatIsSentByUdpOrFetchedByTcp) {
  const std::string port = test::free_udp_port();
  LandmarkUnitSettings unit;
  unit.rate = 200.0;
  const DeviceEmulator sender(to_udp(port), make_landmark_unit(unit, still_hand()));
  LandmarkGlove heard("udp://" + port);
  const GloveInfo info = heard.connect();
  EXPECT_EQ(info.angle_sensors, landmark_sensors());
  EXPECT_TRUE(info.right_hand);
  expect_still_hand(heard);

  const DeviceEmulator server(fetched_by_tcp(), make_landmark_unit(unit, still_hand()));
  LandmarkGlove fetched("landmarks://" + server.address());
  fetched.connect();
  expect_still_hand(fetched);
}

// Frames of Rokoko Studio have bones of both hands, and are longer than a line of most protocols.
TEST(LandmarkGlove, MeasuresTheHandOfEveryKindOfMessage) {
  for (const HandWire wire :
       {HandWire::kOpenXr, HandWire::kRokoko, HandWire::kRokokoLz4, HandWire::kManus}) {
    const std::string port = test::free_udp_port();
    LandmarkUnitSettings unit;
    unit.wire = wire;
    unit.rate = 200.0;
    unit.left = true;
    const DeviceEmulator sender(to_udp(port), make_landmark_unit(unit, still_hand()));
    LandmarkGlove glove("udp://" + port);
    const GloveInfo info = glove.connect();
    EXPECT_EQ(info.model, name_of(wire));
    EXPECT_FALSE(info.right_hand);
    expect_still_hand(glove);
    const GloveFrame frame = frame_of(glove);
    EXPECT_EQ(frame.X_SH.has_value(), wire != HandWire::kManus);
    EXPECT_EQ(frame.bones.has_value(), wire != HandWire::kManus);
    EXPECT_EQ(glove.faults().resynchronisations, 0U);
  }
}

/// Writes the next three messages of a sender as lines into a file.
void write_lines(DeviceUnit& sender, const std::string& path) {
  std::ofstream file(path);
  for (int k = 0; k < 3; ++k) {
    for (const auto& line : sender.advance(*sender.next_due())) {
      file << std::string(line.begin(), line.end());
    }
  }
}

TEST(LandmarkGlove, ReadsANamedPipeFromOneWriterAfterAnother) {
  const test::ScratchFolder scratch;
  const std::string path = (scratch.path() / "hand").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  LandmarkGlove glove("pipe://" + path);
  std::jthread writer([&path] {
    LandmarkUnitSettings unit;
    unit.wire = HandWire::kOpenXr;
    const auto sender = make_landmark_unit(unit, still_hand());
    write_lines(*sender, path);
    write_lines(*sender, path);
  });
  EXPECT_EQ(glove.connect().model, "OpenXR hand joints");
  for (int k = 0; k < 6; ++k) {
    expect_still_hand(glove);
  }
}

TEST(LandmarkGlove, RefusesAPipeThatIsNone) {
  const test::ScratchFolder scratch;
  for (const auto& path : {scratch.path(), scratch.path() / "missing"}) {
    try {
      LandmarkGlove("pipe://" + path.string()).connect();
      ADD_FAILURE() << "no pipe was opened";
    } catch (const DeviceError& error) {
      EXPECT_THAT(error.what(), HasSubstr("expected a named pipe"));
    }
  }
}

TEST(LandmarkGlove, MirrorsALeftHand) {
  LandmarkUnitSettings unit;
  unit.left = true;
  const DeviceEmulator server(fetched_by_tcp(), make_landmark_unit(unit, still_hand()));
  LandmarkGlove glove("landmarks://" + server.address());
  EXPECT_FALSE(glove.connect().right_hand);
  expect_still_hand(glove);
}

// Senders that look at a mirrored picture name the wrong hand.
TEST(LandmarkGlove, RecognisesAHandThatIsNamedWrongly) {
  for (const bool left : {false, true}) {
    LandmarkUnitSettings unit;
    unit.rate = 200.0;
    unit.left = left;
    unit.wrong_label = true;
    const DeviceEmulator server(fetched_by_tcp(), make_landmark_unit(unit, still_hand()));
    LandmarkGlove glove("landmarks://" + server.address());
    glove.connect();
    for (int k = 0; k < 40; ++k) {  // one bent joint is little evidence in each frame
      static_cast<void>(frame_of(glove));
    }
    expect_still_hand(glove);
  }
}

TEST(LandmarkGlove, FollowsOneHandOfTwo) {
  const std::string port = test::free_udp_port();
  LandmarkUnitSettings right;
  LandmarkUnitSettings left;
  left.left = true;
  const DeviceEmulator first(to_udp(port), make_landmark_unit(right, [](double time) {
                               return GloveAngles{time, {}};
                             }));
  const DeviceEmulator second(to_udp(port), make_landmark_unit(left, still_hand()));
  LandmarkGlove glove("udp://" + port, {true, milliseconds(1000)});
  glove.connect();
  for (int k = 0; k < 10; ++k) {
    expect_still_hand(glove);
  }
}

TEST(LandmarkGlove, SaysThatNoHandIsSeenUntilOneIs) {
  DeviceEmulator server(fetched_by_tcp(), make_landmark_unit({}, still_hand()));
  server.set_plugged(false);
  LandmarkGlove glove("landmarks://" + server.address());
  glove.connect();
  SampleEvent event = SampleEvent::kNothing;
  for (int k = 0; k < 100 && event != SampleEvent::kUnplugged; ++k) {
    event = glove.next(milliseconds(100)).event;
  }
  EXPECT_EQ(event, SampleEvent::kUnplugged);
  server.set_plugged(true);
  expect_still_hand(glove);
}

TEST(LandmarkGlove, CountsDamagedLinesAndNoticesThatTheSenderIsGone) {
  const std::string port = test::free_udp_port();
  DeviceEmulatorSettings line = to_udp(port);
  line.faults.garbage = 0.7;
  LandmarkUnitSettings unit;
  unit.rate = 300.0;
  auto sender = std::make_unique<DeviceEmulator>(line, make_landmark_unit(unit, still_hand()));
  LandmarkGlove glove("udp://" + port, {{}, milliseconds(300)});
  glove.connect();
  for (int k = 0; k < 50; ++k) {
    static_cast<void>(frame_of(glove));
  }
  EXPECT_GT(glove.faults().resynchronisations, 0U);
  sender.reset();
  try {
    for (int k = 0; k < 100; ++k) {
      static_cast<void>(glove.next(milliseconds(100)));
    }
    ADD_FAILURE() << "a dead sender was not noticed";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(port), HasSubstr("no hand landmarks for 300 ms"),
                                    HasSubstr("sender runs")));
  }
}

TEST(LandmarkGlove, SaysWhatIsWrongWithLinesThatAreNoHand) {
  const std::string port = test::free_udp_port();
  LandmarkUnitSettings unit;
  unit.noise = 1e4;  // m: as of a sender that knows no metres
  const DeviceEmulator sender(to_udp(port), make_landmark_unit(unit, still_hand()));
  LandmarkGlove glove("udp://" + port, {{}, milliseconds(300)});
  try {
    glove.connect();
    ADD_FAILURE() << "no hand was taken for one";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("the last line: a hand of"), HasSubstr("expected metres")));
  }
}

TEST(LandmarkGlove, RefusesOtherAddresses) {
  for (const char* address : {"udp://", "udp://70000", "landmarks://5006", "localhost:5006"}) {
    EXPECT_THROW(LandmarkGlove{address}, geometric::InputError) << address;
  }
}

TEST(RecordedHand, PlaysAgainAndAgain) {
  Recording recording;
  recording.header.kind = RecordingKind::kAngles;
  recording.header.sensors = {*find_sensor("IndexPIJ")};
  recording.times = Eigen::Vector2d(0.0, 0.5);
  recording.values = Eigen::Vector2d(0.1, 0.2);
  const HandSignal hand = recorded_hand(recording);
  const auto index = static_cast<std::size_t>(*find_sensor("IndexPIJ"));
  EXPECT_EQ(hand(0.2).angles.at(index), 0.1);
  EXPECT_EQ(hand(0.7).angles.at(index), 0.2);
  EXPECT_EQ(hand(1.2).angles.at(index), 0.1);
}

}  // namespace
}  // namespace handway::device
