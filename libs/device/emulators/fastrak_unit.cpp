#include "emulators/tracker_unit.h"
#include "handway/device/tracker/polhemus_parser.h"
#include "tracker/polhemus_items.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

constexpr int kUnitStations = 4;
constexpr std::string_view kLetters = "PCcFfUuSWT\x0B\x19\r\n";

class FastrakUnit final : public TrackerUnit {
 public:
  FastrakUnit(const TrackerUnitSettings& settings, TrackerSignal signal)
      : TrackerUnit(settings, std::move(signal), kUnitStations) {
    reset();
  }

 private:
  void reset() {
    lists_.fill({2, 4, 1});
    binary_ = false;
    centimetres_ = false;
    end_stream();
  }

  [[nodiscard]] bool is_whole(const std::string& command) const override {
    return command.back() == '\r' ||
           (command.size() == 1 && kLetters.find(command[0]) != std::string_view::npos);
  }

  Bytes obey(const std::string& command, double now) override {
    switch (command[0]) {
      case 'P':
        return frame(now);
      case 'C':
        begin_stream(now, settings().rate / settings().sensors);
        break;
      case 'c':
        end_stream();
        break;
      case 'F':
      case 'f':
        binary_ = command[0] == 'f';
        break;
      case 'U':
      case 'u':
        centimetres_ = command[0] == 'u';
        break;
      case 'S':
        return status();
      case 'O':
        set_list(command);
        break;
      case 'W':
      case '\x19':
        reset();
        break;
      default:
        break;  // Filters, hemispheres and the like change nothing here.
    }
    return {};
  }

  void set_list(const std::string& command) {
    const OutputList numbers = comma_list(std::string_view(command).substr(1));
    if (numbers.size() < 2 || numbers[0] < 1 || numbers[0] > kUnitStations) {
      return;
    }
    const FastrakFormat format{{numbers.begin() + 1, numbers.end()}, true, false};
    try {
      (void)format.record_length();
    } catch (const std::invalid_argument&) {
      return;  // Items that it doesn't have: the list stays.
    }
    lists_[static_cast<std::size_t>(numbers[0] - 1)] = format.items;
  }

  [[nodiscard]] Bytes status() const {
    const int flags = (binary_ ? 1 : 0) | (centimetres_ ? 2 : 0) | (streaming() ? 8 : 0);
    Bytes bytes;
    append_text(bytes,
                fmt::format("{:<53}\r\n", fmt::format("21S{:03X}  0 3SPACE FASTRAK", flags)));
    return bytes;
  }

  template <typename Numbers>
  void append_numbers(Bytes& bytes, const Numbers& numbers, int decimals) const {
    for (const double number : numbers) {
      if (binary_) {
        append_float(bytes, number);
      } else {
        append_text(bytes, fmt::format("{:7.{}f}", number, decimals));
      }
    }
  }

  Bytes record(double time, int sensor) override {
    const geometric::Pose X_ST = pose(time, sensor);
    const double unit = centimetres_ ? kMetresPerCentimetre : kMetresPerInch;
    Bytes bytes;
    append_text(bytes, fmt::format("0{} ", sensor));
    for (const int item : lists_[static_cast<std::size_t>(sensor - 1)]) {
      switch (item) {
        case 0:
          append_text(bytes, " ");
          break;
        case 1:
          append_text(bytes, "\r\n");
          break;
        case 2:
          append_numbers(bytes, Eigen::Vector3d(X_ST.translation() / unit), 2);
          break;
        case 4:
          append_numbers(bytes, azimuth_elevation_roll(X_ST.linear()), 2);
          break;
        case 11:
          append_numbers(bytes, scalar_first(X_ST.linear()), 4);
          break;
        default:
          append_text(bytes, pressed(time, sensor) ? " 1" : " 0");
      }
    }
    return bytes;
  }

  std::array<OutputList, kUnitStations> lists_;
  bool binary_ = false;
  bool centimetres_ = false;
};

}  // namespace

std::unique_ptr<DeviceUnit> make_fastrak_unit(const TrackerUnitSettings& settings,
                                              TrackerSignal signal) {
  return std::make_unique<FastrakUnit>(settings, std::move(signal));
}

}  // namespace handway::device
