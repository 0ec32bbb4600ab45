#include "emulators/tracker_unit.h"
#include "handway/device/tracker/polhemus_parser.h"
#include "tracker/polhemus_items.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

constexpr int kMostStations = 16;
constexpr char kStationMap = '\x15';  // Ctrl-U
constexpr char kWhoAmI = '\x16';      // Ctrl-V

class LibertyUnit final : public TrackerUnit {
 public:
  LibertyUnit(const TrackerUnitSettings& settings, TrackerSignal signal)
      : TrackerUnit(settings, std::move(signal), kMostStations) {}

 private:
  [[nodiscard]] bool is_whole(const std::string& command) const override {
    return command.back() == '\r' || command == "P";
  }

  Bytes obey(const std::string& command, double now) override {
    const char argument = command.size() > 1 ? command[1] : '\r';
    switch (command[0]) {
      case 'P':
        return poll(now);
      case 'C':
        command_ = 'C';
        begin_stream(now, settings().rate);
        break;
      case 'U':
        centimetres_ = argument == '1';
        break;
      case 'O':
        set_list(command);
        break;
      case 'Q':
        zero_ = now;
        frames_ = 0;
        break;
      case kStationMap:
        return station_map();
      case kWhoAmI:
        return reply(kWhoAmI, "Polhemus Liberty (emulated)");
      default:
        break;  // Filters, hemispheres and the like change nothing here.
    }
    return {};
  }

  void set_list(const std::string& command) {
    const std::size_t comma = command.find(',');
    if (comma == std::string::npos) {
      return;
    }
    const LibertyFormat format{comma_list(std::string_view(command).substr(comma + 1)), false};
    try {
      (void)format.body_length();
      items_ = format.items;
    } catch (const std::invalid_argument&) {
      return;  // Items that it doesn't have: the list stays.
    }
  }

  static Bytes header(int station, char command, std::size_t body) {
    Bytes bytes{'L', 'Y', static_cast<std::uint8_t>(station), static_cast<std::uint8_t>(command),
                ' ', 0};
    append_u16(bytes, static_cast<std::uint16_t>(body));
    return bytes;
  }

  static Bytes reply(char command, std::string_view body) {
    Bytes bytes = header(0, command, body.size());
    append_text(bytes, body);
    return bytes;
  }

  [[nodiscard]] Bytes station_map() const {
    const auto map = static_cast<std::uint16_t>(
        plugged() ? (1U << static_cast<unsigned>(settings().sensors)) - 1U : 0U);
    Bytes bytes = header(0, kStationMap, 4);
    append_u16(bytes, map);
    append_u16(bytes, map);
    return bytes;
  }

  // One frame; a lone P also ends the stream.
  Bytes poll(double now) {
    end_stream();
    command_ = 'P';
    return frame(now);
  }

  template <typename Numbers>
  static void append_floats(Bytes& bytes, const Numbers& numbers) {
    for (const double number : numbers) {
      append_float(bytes, number);
    }
  }

  Bytes record(double time, int sensor) override {
    frames_ += sensor == 1 ? 1 : 0;
    const geometric::Pose X_ST = pose(time, sensor);
    const double unit = centimetres_ ? kMetresPerCentimetre : kMetresPerInch;
    Bytes bytes = header(sensor, command_, LibertyFormat{items_, false}.body_length());
    for (const int item : items_) {
      switch (item) {
        case 0:
          append_text(bytes, " ");
          break;
        case 1:
          append_text(bytes, "\r\n");
          break;
        case 2:
        case 3:
          append_floats(bytes, Eigen::Vector3d(X_ST.translation() / unit));
          break;
        case 4:
          append_floats(bytes, azimuth_elevation_roll(X_ST.linear()));
          break;
        case 7:
          append_floats(bytes, scalar_first(X_ST.linear()));
          break;
        case 8:
          append_u32(bytes, static_cast<std::uint32_t>(std::lround((time - zero_) * 1000.0)));
          break;
        case 9:
          append_u32(bytes, frames_);
          break;
        case 10:
          append_u32(bytes, pressed(time, sensor) ? 1 : 0);
          break;
        default:
          append_u32(bytes, 0);  // No distortion.
      }
    }
    return bytes;
  }

  OutputList items_{2, 4, 1};
  char command_ = 'P';
  bool centimetres_ = false;
  double zero_ = 0.0;
  std::uint32_t frames_ = 0;
};

}  // namespace

std::unique_ptr<DeviceUnit> make_liberty_unit(const TrackerUnitSettings& settings,
                                              TrackerSignal signal) {
  return std::make_unique<LibertyUnit>(settings, std::move(signal));
}

}  // namespace handway::device
