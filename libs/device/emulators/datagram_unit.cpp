#include "emulators/tracker_unit.h"
#include "handway/device/tracker/udp_tracker.h"

#include <memory>
#include <string>
#include <utility>

namespace handway::device {
namespace {

constexpr int kMostSensors = 256;

class DatagramUnit final : public TrackerUnit {
 public:
  DatagramUnit(const TrackerUnitSettings& settings, TrackerSignal signal)
      : TrackerUnit(settings, std::move(signal), kMostSensors) {
    begin_stream(0.0, settings.rate);
  }

 private:
  [[nodiscard]] bool is_whole(const std::string& /*command*/) const override { return true; }
  Bytes obey(const std::string& /*command*/, double /*now*/) override { return {}; }

  Bytes record(double time, int sensor) override {
    TrackerSample sample{time, sensor - 1, pose(time, sensor), {}};
    if (settings().button && sensor == 1) {
      sample.button = pressed(time, sensor);
    }
    Bytes bytes;
    append_text(bytes, write_pose_datagram(sample));
    return bytes;
  }
};

}  // namespace

std::unique_ptr<DeviceUnit> make_datagram_unit(const TrackerUnitSettings& settings,
                                               TrackerSignal signal) {
  return std::make_unique<DatagramUnit>(settings, std::move(signal));
}

}  // namespace handway::device
