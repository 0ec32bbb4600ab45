#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace handway::test {

/// Stands between a host and an emulated device, both on this computer, and passes on their bytes
/// until it is requested to flood: then the host gets the same bytes over and over, as fast as it
/// takes them, and nothing of the device. The bytes of the host still arrive.
class FloodingProxy {
 public:
  /// @param device port of the emulator. @param port to listen on; 0: any that is free.
  /// @throws std::runtime_error if the port is taken.
  explicit FloodingProxy(std::uint16_t device, std::uint16_t port = 0);
  ~FloodingProxy();
  FloodingProxy(const FloodingProxy&) = delete;
  FloodingProxy& operator=(const FloodingProxy&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }

  /// @param message what is repeated; a whole one of the device's protocol, or anything else.
  void flood(const std::string& message);
  /// Floods with what the device sent last. @pre it has sent something.
  void flood();
  /// Stops reading what the host sends.
  void stop_reading() { reads_ = false; }

  /// Bytes that the host has been flooded with so far.
  [[nodiscard]] std::uint64_t flooded() const { return flooded_; }

 private:
  void run(const std::stop_token& stop);

  std::uint16_t device_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::mutex mutex_;   ///< Guards the next two members.
  std::string flood_;  ///< Empty: none.
  std::string last_;   ///< Last message of the device.
  std::atomic<bool> reads_ = true;
  std::atomic<std::uint64_t> flooded_ = 0;
  std::jthread thread_;  ///< Last: it uses all the others.
};

/// The port at the end of "KIND://HOST:PORT" or "HOST:PORT".
[[nodiscard]] std::uint16_t port_of(const std::string& address);

/// A proxy for both ports of an arm's emulator, that of motions and the next but one.
struct FloodingArmProxy {
  explicit FloodingArmProxy(std::uint16_t device);

  std::unique_ptr<FloodingProxy> motion;
  std::unique_ptr<FloodingProxy> state;
};

}  // namespace handway::test
