#include "handway/device/haptic/haptic_emulator.h"

#include "core/line_emulator.h"

namespace handway::device {
namespace {

constexpr double kStatePeriod = 0.002;  // s

}  // namespace

struct HapticEmulator::Running : LineEmulator<EmulatedHaptic> {
  using LineEmulator::LineEmulator;
};

HapticEmulator::HapticEmulator(const EmulatedHapticSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>("haptic", port, kStatePeriod, settings)) {}

HapticEmulator::~HapticEmulator() = default;

const std::string& HapticEmulator::address() const { return running_->address(); }

Eigen::Vector3d HapticEmulator::force() const {
  return running_->ask([](const EmulatedHaptic& device) { return device.force(); });
}

}  // namespace handway::device
