#pragma once

#include "handway/device/core/byte_link.h"
#include "handway/device/core/device_error.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/write.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace handway::device {

/// A ByteLink over any Boost.Asio stream that can be cancelled.
template <typename Stream>
class AsioLink : public ByteLink {
 public:
  explicit AsioLink(std::string name) : ByteLink(std::move(name)), stream_(context_) {}

  [[nodiscard]] Stream& stream() { return stream_; }
  [[nodiscard]] boost::asio::io_context& context() { return context_; }

  /// Runs the operation started on the stream until it is done or `timeout` is over; then cancels
  /// it. @returns whether it was done in time.
  bool run(std::chrono::milliseconds timeout) {
    context_.restart();
    context_.run_for(timeout);
    if (context_.stopped()) {
      return true;
    }
    boost::system::error_code ignored;
    stream_.cancel(ignored);
    context_.run();
    return false;
  }

 private:
  [[noreturn]] void lost(const boost::system::error_code& error) const {
    throw DeviceError({name(), "", "the connection broke: " + error.message(),
                       "a device that stays connected",
                       "Look whether it is switched on and plugged in."});
  }

  std::size_t do_read(std::span<std::uint8_t> bytes, std::chrono::milliseconds timeout) override {
    boost::system::error_code error;
    std::size_t count = 0;
    stream_.async_read_some(boost::asio::buffer(bytes.data(), bytes.size()),
                            [&](const boost::system::error_code& result, std::size_t read) {
                              error = result;
                              count = read;
                            });
    run(timeout);
    if (error && error != boost::asio::error::operation_aborted) {
      lost(error);
    }
    return count;
  }

  void do_write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds timeout) override {
    boost::system::error_code error;
    boost::asio::async_write(
        stream_, boost::asio::buffer(bytes.data(), bytes.size()),
        [&](const boost::system::error_code& result, std::size_t) { error = result; });
    run(timeout);
    if (error == boost::asio::error::operation_aborted) {
      throw DeviceError({name(), "", "a device that takes no more bytes", "one that reads them",
                         "Switch it off and on again."});
    }
    if (error) {
      lost(error);
    }
  }

  boost::asio::io_context context_{1};
  Stream stream_;
};

}  // namespace handway::device
