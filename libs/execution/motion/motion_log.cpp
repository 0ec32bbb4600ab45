#include "handway/execution/motion/motion_log.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <string>

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
        header += "," + joint + suffix;
      }
    }
  }
  out_ << header << '\n' << std::flush;
  if (!out_) {
    throw geometric::InputError(
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

}  // namespace handway::execution
