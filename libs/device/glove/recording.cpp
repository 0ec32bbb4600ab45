#include "handway/device/glove/recording.h"

#include "glove/recording_mark.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

// A label without separators and quotes.
std::string one_cell(std::string label) {
  std::ranges::replace_if(
      label,
      [](char c) { return std::string_view(",;\t\n\r\"").find(c) != std::string_view::npos; }, ' ');
  return label;
}

// The lines before the first row. @throws std::invalid_argument for an unknown sensor, one twice,
// or none.
std::string header_text(const RecordingHeader& header, const RawColumns& raw) {
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
  for (const std::string& label : labels_of(raw)) {
    text += fmt::format(",{}{}", kRawMark, one_cell(label));
  }
  return text + '\n';
}

// One row with its end of line. @throws std::invalid_argument if a value isn't finite or
// their number is not that of the sensors. Raw values may be missing.
std::string row_text(const RecordingHeader& header, double time, std::span<const double> values,
                     std::span<const double> raw) {
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
  for (const double value : raw) {
    if (std::isfinite(value)) {
      fmt::format_to(std::back_inserter(text), ",{}", value);
    } else {
      text += ',';
    }
  }
  return text + '\n';
}

}  // namespace

std::string to_string(RecordingKind kind) {
  return kind == RecordingKind::kCounts ? "counts" : "angles";
}

GloveAngles angles_of_row(const Recording& recording, Eigen::Index row) {
  if (recording.header.kind != RecordingKind::kAngles) {
    throw geometric::InputError(
        {"recording", "", "raw counts", "angles", "Give a calibration of the glove"});
  }
  GloveAngles angles;
  angles.time = recording.times[row];
  angles.angles.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t c = 0; c < recording.header.sensors.size(); ++c) {
    const auto sensor = static_cast<std::size_t>(recording.header.sensors[c]);
    angles.angles.at(sensor) = recording.values(row, static_cast<Eigen::Index>(c));
  }
  return angles;
}

RecordingHeader recording_header(const GloveInfo& info) {
  RecordingHeader header;
  header.device = fmt::format("{}, {} sensors, {} hand, on {}", info.model,
                              info.angle_sensors.empty() ? static_cast<std::size_t>(info.sensors)
                                                         : info.angle_sensors.size(),
                              info.right_hand ? "right" : "left", info.device);
  if (info.angle_sensors.empty()) {
    const auto wired = cyberglove_wired(info.sensors);
    header.sensors.assign(wired.begin(), wired.end());
  } else {
    header.kind = RecordingKind::kAngles;
    header.sensors = info.angle_sensors;
  }
  return header;
}

int column_of(const RecordingHeader& header, int sensor) {
  const auto found = std::ranges::find(header.sensors, sensor);
  return found == header.sensors.end() ? -1 : static_cast<int>(found - header.sensors.begin());
}

void write_recording(const Recording& recording, const std::filesystem::path& file) {
  const Eigen::Index rows = recording.times.size();
  if (recording.values.rows() != rows) {
    throw std::invalid_argument("a recording needs a time for every row");
  }
  const RawColumns raw = recording.raw.value_or(RawColumns{});
  if (recording.raw && (raw.values.rows() != rows || raw.values.cols() != std::ssize(raw.names))) {
    throw std::invalid_argument("a recording needs raw values for every row and column");
  }
  std::string text = header_text(recording.header, raw);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Eigen::VectorXd values = recording.values.row(row);
    const Eigen::VectorXd sent =
        recording.raw ? Eigen::VectorXd(raw.values.row(row)) : Eigen::VectorXd();
    text += row_text(recording.header, recording.times[row],
                     {values.data(), static_cast<std::size_t>(values.size())},
                     {sent.data(), static_cast<std::size_t>(sent.size())});
  }
  geometric::replace_file(file, text);
}

namespace {

constexpr int kReadableByAll = 0666;  // less the umask

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
  throw geometric::OutputError({file.string(), "", std::strerror(error), "a file to write to",
                                "Check the folder, its permissions and the room on the disk"});
}

int open_anew(const std::filesystem::path& file) {
  const int number =
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, kReadableByAll);
  if (number < 0) {
    fail(file, errno);
  }
  return number;
}

template <typename Values>
std::vector<double> selected(const Values& all, const SensorIndices& sensors) {
  std::vector<double> values;
  values.reserve(sensors.size());
  for (const int sensor : sensors) {
    values.push_back(static_cast<double>(all.at(static_cast<std::size_t>(sensor))));
  }
  return values;
}

}  // namespace

RecordingWriter::Descriptor::~Descriptor() {
  if (number_ >= 0) {
    ::close(number_);
  }
}

RecordingWriter::Descriptor::Descriptor(Descriptor&& other) noexcept
    : number_(std::exchange(other.number_, -1)) {}

RecordingWriter::RecordingWriter(const std::filesystem::path& file, RecordingHeader header,
                                 RawColumns raw)
    : file_(file), header_(std::move(header)), raw_(std::move(raw)), descriptor_(open_anew(file)) {
  write(header_text(header_, raw_));
}

void RecordingWriter::append(double time, std::span<const double> values,
                             std::span<const double> raw) {
  if (rows_ > 0 && time < last_time_) {
    throw std::invalid_argument("time runs backwards in a recording");
  }
  const std::vector<double> missing(raw_.names.size(), std::numeric_limits<double>::quiet_NaN());
  write(row_text(header_, time, values, raw.size() == missing.size() ? raw : missing));
  last_time_ = time;
  ++rows_;
}

void RecordingWriter::append(const GloveFrame& frame) {
  if (header_.kind == RecordingKind::kCounts) {
    append(frame.time, selected(frame.counts, header_.sensors), frame.raw);
  } else if (frame.angles) {
    append(frame.time, selected(*frame.angles, header_.sensors), frame.raw);
  } else {
    throw std::invalid_argument("a frame of counts has no angles to record");
  }
}

void RecordingWriter::append(const GloveAngles& angles) {
  append(angles.time, selected(angles.angles, header_.sensors));
}

void RecordingWriter::write(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_.number(), text.data(), text.size());
    if (written < 0 && errno != EINTR) {
      fail(file_, errno);
    }
    text.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
  }
}

}  // namespace handway::device
