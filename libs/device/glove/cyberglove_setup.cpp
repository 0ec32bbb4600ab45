#include "cyberglove_setup.h"

#include "handway/device/core/device_error.h"

#include <fmt/format.h>

namespace handway::device {

namespace {

// "?G": bit 0 the unit is initialised, bit 1 a glove is plugged in.
constexpr std::uint8_t kReady = 0x03;

int ask_sensors(CyberGloveCommands& commands, const std::string& device,
                const std::stop_token& stop) {
  const auto reply = commands.query('S', 1, stop);
  if (!reply || reply->data.empty()) {
    throw DeviceError({device, "number of sensors", "no answer", "18 or 22",
                       "Switch the interface unit off and on again."});
  }
  const int sensors = reply->data[0];
  if (sensors != 18 && sensors != 22) {
    throw DeviceError({device, "number of sensors", std::to_string(sensors), "18 or 22",
                       "Only CyberGloves with 18 or 22 sensors can be used."});
  }
  return sensors;
}

void require_ready(CyberGloveCommands& commands, const std::string& device,
                   const std::stop_token& stop) {
  const std::optional<bool> ready = glove_is_ready(commands, stop);
  if (!ready) {
    throw DeviceError({device, "", "no answer", "a CyberGlove interface unit",
                       "Look whether it is switched on, whether the port is the right one, and "
                       "whether both sides use the same baud rate (115200 as delivered)."});
  }
  if (!*ready) {
    throw DeviceError({device, "", "an interface unit without a glove", "one with a glove",
                       "Plug the glove into the interface unit."});
  }
}

void set_rate(CyberGloveCommands& commands, const std::string& device, double rate,
              const std::stop_token& stop) {
  const auto reply = commands.set('T', sampling_words(rate), stop);
  if (!reply || reply->error != 0) {
    throw DeviceError({device, "sampling rate",
                       reply ? "a unit that refuses it as too high" : "no answer",
                       fmt::format("one that samples at {:g} Hz", rate), "Ask for a lower rate."});
  }
}

}  // namespace

std::optional<bool> glove_is_ready(CyberGloveCommands& commands, const std::stop_token& stop) {
  const auto reply = commands.query('G', 1, stop);
  if (!reply) {
    return std::nullopt;
  }
  return !reply->data.empty() && (reply->data[0] & kReady) == kReady;
}

GloveInfo set_up_cyberglove(CyberGloveCommands& commands, const std::string& device,
                            const CyberGloveSettings& settings, const std::stop_token& stop) {
  commands.stop_stream(stop);
  require_ready(commands, device, stop);
  GloveInfo info;
  info.device = device;
  info.sensors = ask_sensors(commands, device, stop);
  if (const auto hand = commands.query('R', 1, stop); hand && !hand->data.empty()) {
    info.right_hand = hand->data[0] != 0;
  }
  info.model = "CyberGlove";
  if (const auto version = commands.query('V', 4, stop); version && version->data.size() == 4) {
    const auto& v = version->data;
    info.model += fmt::format(", firmware {}.{}", v[0] << 8 | v[1], v[2] << 8 | v[3]);
  }
  // What another program may have left: records would be longer than those to be parsed.
  const std::uint8_t off = 0;
  (void)commands.set('D', {&off, 1}, stop);
  (void)commands.set('U', {&off, 1}, stop);
  const auto all = static_cast<std::uint8_t>(info.sensors);
  (void)commands.set('N', {&all, 1}, stop);
  const std::uint8_t filter = settings.filter ? 1 : 0;
  (void)commands.set('F', {&filter, 1}, stop);
  set_rate(commands, device, settings.rate, stop);
  info.rate = settings.rate;
  info.round_trip = commands.round_trip();
  return info;
}

}  // namespace handway::device
