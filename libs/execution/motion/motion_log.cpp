#include "handway/execution/motion/motion_log.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

namespace handway::execution {

MotionLog::MotionLog(const std::filesystem::path& file, const std::vector<MotionTarget>& targets) {
  for (const MotionTarget& target : targets) {
    kinds_.push_back(target.kind);
    joints_.push_back(target.link->joints().count());
  }
  if (file.empty()) {
    return;
  }
  out_.open(file, std::ios::binary | std::ios::trunc);
  std::string header = "time,device";
  for (const char* suffix : {"", ".measured"}) {
    for (const MotionTarget& target : targets) {
      for (const std::string& joint : target.link->joints().names) {
        header.append(",").append(geometric::csv_cell(joint + suffix));
      }
    }
  }
  out_ << header << '\n' << std::flush;
  if (!out_) {
    throw geometric::OutputError(
        {file.string(), "", std::strerror(errno), "a file to write to", ""});
  }
}

void MotionLog::add(double time, std::size_t device, const Eigen::VectorXd& planned,
                    const Eigen::VectorXd& measured) {
  if (!out_.is_open()) {
    return;
  }
  std::string row = fmt::format("{:.6f},{}", time, kinds_[device]);
  for (const Eigen::VectorXd* values : {&planned, &measured}) {
    for (std::size_t other = 0; other < joints_.size(); ++other) {
      for (Eigen::Index j = 0; j < joints_[other]; ++j) {
        row += other == device ? fmt::format(",{:.6f}", (*values)[j]) : ",";
      }
    }
  }
  out_ << row + "\n" << std::flush;
}

namespace {

using geometric::InputError;

constexpr std::size_t kLargestFile = std::size_t{256} << 20;
constexpr std::string_view kMeasured = ".measured";
constexpr std::size_t kFirstJoint = 2;  // column after time and device

/// Rows of one device while they are read.
struct Rows {
  RecordedDevice device;
  std::vector<std::size_t> columns;  ///< Columns of the planned positions.
  std::vector<Eigen::VectorXd> planned;
  std::vector<Eigen::VectorXd> measured;
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file) {}

  std::vector<RecordedDevice> read() {
    std::istringstream in(
        geometric::read_text_file(file_, "a log of handway send (CSV)", kLargestFile));
    std::string line;
    std::getline(in, line);
    read_header(line);
    while (std::getline(in, line)) {
      ++line_;
      read_row(line);
    }
    // Devices are in the order of the header, not of their first rows.
    std::ranges::sort(rows_, {}, [](const Rows& rows) { return rows.columns; });
    std::vector<RecordedDevice> devices;
    devices.reserve(rows_.size());
    for (Rows& rows : rows_) {
      devices.push_back(matrices_of(std::move(rows)));
    }
    if (devices.empty()) {
      refuse("no rows", "measurements of a device");
    }
    return devices;
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw InputError({fmt::format("{}:{}", file_.string(), line_), "", found, expected,
                      "Choose a file that handway send --log wrote."});
  }

  void read_header(const std::string& line) {
    header_ = geometric::cell_names(line, ',');
    joints_ = (header_.size() - std::min(header_.size(), kFirstJoint)) / 2;
    bool good = joints_ > 0 && header_.size() == kFirstJoint + 2 * joints_ &&
                header_[0] == "time" && header_[1] == "device";
    for (std::size_t j = 0; good && j < joints_; ++j) {
      good =
          header_[kFirstJoint + joints_ + j] == header_[kFirstJoint + j] + std::string(kMeasured);
    }
    if (!good) {
      refuse("another header", "time, device, joints, and joints with \".measured\"");
    }
  }

  [[nodiscard]] double number(std::string_view cell) const {
    const std::optional<double> value = geometric::parse_number(cell);
    if (!value) {
      refuse(fmt::format("\"{}\"", cell), "a number");
    }
    return *value;
  }

  // Returns the rows of the device in `cells`, creating them at its first row. The device's joints
  // are those with numbers in that row.
  Rows& rows_of(const std::vector<std::string_view>& cells) {
    const auto found =
        std::ranges::find_if(rows_, [&](const Rows& rows) { return rows.device.kind == cells[1]; });
    if (found != rows_.end()) {
      return *found;
    }
    Rows& rows = rows_.emplace_back();
    rows.device.kind = cells[1];
    for (std::size_t c = kFirstJoint; c < kFirstJoint + joints_; ++c) {
      if (!cells[c].empty()) {
        rows.columns.push_back(c);
        rows.device.joints.push_back(header_[c]);
      }
    }
    if (rows.columns.empty()) {
      refuse(fmt::format("no number for any joint of {}", cells[1]), "its planned value");
    }
    return rows;
  }

  void read_row(const std::string& line) {
    const std::vector<std::string_view> cells = geometric::cells(line, ',');
    if (cells.size() != header_.size()) {
      refuse(geometric::plural(cells.size(), "value"), fmt::format("{}", header_.size()));
    }
    Rows& rows = rows_of(cells);
    rows.device.times.push_back(number(cells[0]));
    const auto values = [&](std::size_t offset) {
      Eigen::VectorXd q(static_cast<Eigen::Index>(rows.columns.size()));
      for (std::size_t j = 0; j < rows.columns.size(); ++j) {
        q[static_cast<Eigen::Index>(j)] = number(cells[rows.columns[j] + offset]);
      }
      return q;
    };
    rows.planned.push_back(values(0));
    rows.measured.push_back(values(joints_));
  }

  static RecordedDevice matrices_of(Rows rows) {
    const auto count = static_cast<Eigen::Index>(rows.planned.size());
    const auto joints = static_cast<Eigen::Index>(rows.columns.size());
    rows.device.planned.resize(count, joints);
    rows.device.measured.resize(count, joints);
    for (Eigen::Index i = 0; i < count; ++i) {
      rows.device.planned.row(i) = rows.planned[static_cast<std::size_t>(i)];
      rows.device.measured.row(i) = rows.measured[static_cast<std::size_t>(i)];
    }
    return std::move(rows.device);
  }

  const std::filesystem::path& file_;
  int line_ = 1;
  std::vector<std::string> header_;
  std::size_t joints_ = 0;  ///< Number of joints in the file.
  std::vector<Rows> rows_;
};

}  // namespace

std::vector<RecordedDevice> read_motion_log(const std::filesystem::path& file) {
  return Reader(file).read();
}

std::vector<JointDifference> differences(const RecordedDevice& device) {
  const Eigen::MatrixXd away = (device.measured - device.planned).cwiseAbs();
  std::vector<JointDifference> result;
  for (Eigen::Index j = 0; j < away.cols() && away.rows() > 0; ++j) {
    Eigen::Index worst = 0;
    const double max = away.col(j).maxCoeff(&worst);
    result.push_back({device.joints[static_cast<std::size_t>(j)], max,
                      device.times[static_cast<std::size_t>(worst)],
                      std::sqrt(away.col(j).squaredNorm() / static_cast<double>(away.rows()))});
  }
  return result;
}

}  // namespace handway::execution
