#include "handway/device/hand/hand_emulator.h"

#include "core/line_emulator.h"
#include "handway/device/hand/hand_protocol.h"

namespace handway::device {

struct HandEmulator::Running : LineEmulator<HandController> {
  using LineEmulator::LineEmulator;
};

HandEmulator::HandEmulator(const HandControllerSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>("hand", port, kHandStatePeriod, settings)) {}

HandEmulator::~HandEmulator() = default;

const std::string& HandEmulator::address() const { return running_->address(); }

Eigen::VectorXd HandEmulator::position() const {
  return running_->ask([](const HandController& hand) { return Eigen::VectorXd(hand.position()); });
}

bool HandEmulator::moving() const {
  return running_->ask([](const HandController& hand) { return hand.moving(); });
}

int HandEmulator::stops() const {
  return running_->ask([](const HandController& hand) { return hand.stops(); });
}

}  // namespace handway::device
