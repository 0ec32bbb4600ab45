#include "handway/device/glove/glove_emulator.h"

namespace handway::device {

GloveEmulator::GloveEmulator(const GloveEmulatorSettings& settings, GloveSignal signal)
    : emulator_(settings, std::make_unique<CyberGloveUnit>(settings.unit, std::move(signal))) {}

}  // namespace handway::device
