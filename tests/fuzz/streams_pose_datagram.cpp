/// Poses as UDP datagrams.
#include "handway/device/tracker/udp_tracker.h"
#include "pieces.h"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  const auto sample = device::read_pose_datagram({data, size});
  if (sample) {
    fuzz::require(std::isfinite(sample->time) && sample->X_ST.matrix().allFinite());
    fuzz::require(sample->sensor >= 0 && sample->sensor <= 255);
    const std::string again = write_pose_datagram(*sample);
    fuzz::require(device::read_pose_datagram(
                      {reinterpret_cast<const std::uint8_t*>(again.data()), again.size()})
                      .has_value());
  }
  return 0;
}
