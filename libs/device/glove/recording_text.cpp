#include "recording_text.h"

#include "handway/device/glove/glove_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>

namespace handway::device {
namespace {

void check_sensors(const RecordingHeader& header) {
  const auto known = static_cast<int>(cyberglove_sensors().size());
  std::set<int> seen;
  for (const int sensor : header.sensors) {
    if (sensor < 0 || sensor >= known || !seen.insert(sensor).second) {
      throw std::invalid_argument("a recording's sensors must be known and distinct");
    }
  }
  if (seen.empty()) {
    throw std::invalid_argument("a recording needs a sensor");
  }
}

std::string single_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

void add_field(std::string& text, const char* key, const std::string& value) {
  if (!value.empty()) {
    text += fmt::format("# {}: {}\n", key, single_line(value));
  }
}

}  // namespace

std::string header_text(const RecordingHeader& header) {
  check_sensors(header);
  std::string text = fmt::format("{}\n", kRecordingMark);
  add_field(text, "kind", to_string(header.kind));
  add_field(text, "device", header.device);
  add_field(text, "date", header.date);
  add_field(text, "origin", header.origin);
  text += "time";
  for (const int sensor : header.sensors) {
    text += fmt::format(",{}", cyberglove_sensors()[static_cast<std::size_t>(sensor)].name);
  }
  return text + '\n';
}

std::string row_text(const RecordingHeader& header, double time, std::span<const double> values) {
  if (values.size() != header.sensors.size()) {
    throw std::invalid_argument("a row of a recording needs a value for every sensor");
  }
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!finite(time) || !std::ranges::all_of(values, finite)) {
    throw std::invalid_argument("a recording holds no value that isn't finite");
  }
  std::string text;
  fmt::format_to(std::back_inserter(text), "{}", time);
  for (const double value : values) {
    fmt::format_to(std::back_inserter(text), ",{}", value);
  }
  return text + '\n';
}

}  // namespace handway::device
