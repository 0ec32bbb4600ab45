#include "handway/device/tracker/pose_datagram.h"

#include "polhemus_items.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace handway::device {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kLastSensor = 255;

template <int Count>
std::optional<Eigen::Matrix<double, Count, 1>> numbers(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != Count) {
    return std::nullopt;
  }
  Eigen::Matrix<double, Count, 1> values;
  Eigen::Index k = 0;
  for (const Json& value : *found) {
    if (!value.is_number()) {
      return std::nullopt;
    }
    values[k++] = value.get<double>();
  }
  return values;
}

// Sensor, time and button. @returns whether they can be true.
bool read_rest(const Json& object, TrackerSample& sample) {
  const auto time = object.find("time");
  if (time == object.end() || !time->is_number() || !std::isfinite(time->get<double>())) {
    return false;
  }
  sample.time = time->get<double>();
  sample.sensor = 0;
  if (const auto sensor = object.find("sensor"); sensor != object.end()) {
    if (!sensor->is_number_unsigned() || sensor->get<std::uint64_t>() > kLastSensor) {
      return false;
    }
    sample.sensor = sensor->get<int>();
  }
  if (const auto button = object.find("button"); button != object.end()) {
    if (!button->is_boolean()) {
      return false;
    }
    sample.button = button->get<bool>();
  }
  return true;
}

}  // namespace

std::optional<TrackerSample> read_pose_datagram(std::span<const std::uint8_t> datagram) {
  if (datagram.size() > kLongestPoseDatagram) {
    return std::nullopt;
  }
  const Json object = Json::parse(datagram.begin(), datagram.end(), nullptr, false);
  if (!object.is_object()) {
    return std::nullopt;
  }
  const auto position = numbers<3>(object, "position");
  const auto xyzw = numbers<4>(object, "quaternion");
  TrackerSample sample;
  if (!position || !xyzw || !read_rest(object, sample)) {
    return std::nullopt;
  }
  const auto X_ST =
      pose_from_quaternion(*position, {(*xyzw)[3], (*xyzw)[0], (*xyzw)[1], (*xyzw)[2]});
  if (!X_ST) {
    return std::nullopt;
  }
  sample.X_ST = *X_ST;
  return sample;
}

std::string write_pose_datagram(const TrackerSample& sample) {
  const Eigen::Vector3d p = sample.X_ST.translation();
  const Eigen::Quaterniond q(sample.X_ST.linear());
  Json object{{"sensor", sample.sensor},
              {"time", sample.time},
              {"position", {p.x(), p.y(), p.z()}},
              {"quaternion", {q.x(), q.y(), q.z(), q.w()}}};
  if (sample.button) {
    object["button"] = *sample.button;
  }
  return object.dump();
}

}  // namespace handway::device
