#include "core/asio_link.h"
#include "core/links.h"
#include "handway/device/core/device_error.h"

#include <boost/asio/serial_port.hpp>
#include <termios.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace handway::device {
namespace {

using boost::asio::serial_port;
using boost::asio::serial_port_base;
using boost::system::error_code;

std::string advice_for(const error_code& error) {
  if (error == boost::system::errc::no_such_file_or_directory) {
    return "Plug the device in; `ls /dev/ttyUSB* /dev/ttyACM* /dev/rfcomm*` shows the serial ports "
           "that there are.";
  }
  if (error == boost::system::errc::permission_denied) {
    return "Add yourself to the group dialout (sudo adduser $USER dialout) and log in again.";
  }
  if (error == boost::system::errc::device_or_resource_busy) {
    return "End the program that uses it.";
  }
  return "Name a serial port, such as /dev/ttyUSB0, or HOST:PORT.";
}

[[noreturn]] void refuse(const std::string& path, const error_code& error) {
  throw DeviceError({path, "", error.message(), "a serial port", advice_for(error)});
}

}  // namespace

std::unique_ptr<ByteLink> open_serial_link(const std::string& path, int baud) {
  auto link = std::make_unique<AsioLink<serial_port>>(path);
  error_code error;
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  if (std::filesystem::exists(status) && !std::filesystem::is_character_file(status)) {
    throw DeviceError(
        {path, "", "a file or folder that is no device", "a serial port", advice_for(error)});
  }
  serial_port& port = link->stream();
  if (port.open(path, error)) {
    refuse(path, error);
  }
  port.set_option(serial_port_base::baud_rate(static_cast<unsigned>(baud)), error) ||
      port.set_option(serial_port_base::character_size(8), error) ||
      port.set_option(serial_port_base::parity(serial_port_base::parity::none), error) ||
      port.set_option(serial_port_base::stop_bits(serial_port_base::stop_bits::one), error) ||
      port.set_option(serial_port_base::flow_control(serial_port_base::flow_control::none), error);
  if (error) {
    refuse(path, error);
  }
  // Bytes for the former user of the port are discarded.
  ::tcflush(port.native_handle(), TCIOFLUSH);
  return link;
}

}  // namespace handway::device
