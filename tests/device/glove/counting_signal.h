#pragma once

#include "handway/device/emulators/glove_emulator.h"

#include <atomic>
#include <memory>

namespace handway::test {

/// A signal with distinct frames: every count is the frame's number modulo 255, plus 1.
inline device::GloveSignal counting_signal() {
  return [number = std::uint64_t{0}](double) mutable {
    std::array<std::uint16_t, device::kGloveSensors> counts{};
    counts.fill(static_cast<std::uint16_t>(1 + number++ % 255));
    return counts;
  };
}

/// Settings of an emulator on any free TCP port of this computer.
inline device::GloveEmulatorSettings on_tcp(std::uint16_t port = 0) {
  device::GloveEmulatorSettings settings;
  settings.tcp_port = port;
  return settings;
}

}  // namespace handway::test
