#include "handway/device/core/byte_link.h"
#include "handway/geometric/io/input_error.h"

#include <gtest/gtest.h>

namespace handway::device {
namespace {

TEST(DeviceAddress, TakesAPathForASerialPort) {
  EXPECT_EQ(std::get<SerialAddress>(parse_device_address("/dev/ttyUSB0")).path, "/dev/ttyUSB0");
  EXPECT_EQ(std::get<SerialAddress>(parse_device_address("/dev/by-id/a:1")).path, "/dev/by-id/a:1");
}

TEST(DeviceAddress, TakesHostAndPortForTcp) {
  const auto plain = std::get<TcpAddress>(parse_device_address("fcu.lab:12345"));
  EXPECT_EQ(plain.host, "fcu.lab");
  EXPECT_EQ(plain.port, 12345);
  EXPECT_EQ(std::get<TcpAddress>(parse_device_address("tcp://[::1]:7")).host, "::1");
}

TEST(DeviceAddress, RefusesWhatIsNeither) {
  for (const char* text : {"", "host:", "host:0", "host:70000", "host:9x", ":9", "tcp://host"}) {
    EXPECT_THROW((void)parse_device_address(text), geometric::InputError) << text;
  }
}

}  // namespace
}  // namespace handway::device
