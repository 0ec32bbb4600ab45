#include "haptic_log.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace handway::tools {

HapticLog::HapticLog(const std::filesystem::path& file, const geometric::RobotModel& model) {
  if (file.empty()) {
    return;
  }
  out_.open(file, std::ios::binary | std::ios::trunc);
  std::string header = "time,progress,place,button,deviation,force.x,force.y,force.z";
  for (int v = 0; v < model.variable_count(); ++v) {
    header += "," + model.variable(v).name;
  }
  out_ << header << '\n' << std::flush;
  if (!out_) {
    throw geometric::InputError(
        {file.string(), "", std::strerror(errno), "a file to write to", ""});
  }
}

void HapticLog::add(const execution::GuidanceSample& sample) {
  if (!out_.is_open()) {
    return;
  }
  const Eigen::Vector3d& force = sample.step.force;
  std::string row = fmt::format("{:.6f},{:.6f},{:.6f},{},{:.6f},{:.4f},{:.4f},{:.4f}", sample.time,
                                sample.step.progress, sample.place, sample.handle.button ? 1 : 0,
                                sample.step.deviation, force.x(), force.y(), force.z());
  for (const double q : sample.q) {
    row += fmt::format(",{:.6f}", q);
  }
  out_ << row + "\n";
}

}  // namespace handway::tools
