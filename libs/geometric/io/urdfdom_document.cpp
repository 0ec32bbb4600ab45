#include "io/urdfdom_document.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>
#include <mutex>

namespace handway::geometric {
namespace {

class Collector final : public console_bridge::OutputHandler {
 public:
  explicit Collector(std::vector<std::string>& messages) : messages_(messages) {
    console_bridge::useOutputHandler(this);
  }
  ~Collector() override { console_bridge::restorePreviousOutputHandler(); }
  Collector(const Collector&) = delete;
  Collector& operator=(const Collector&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/,
           int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) {
      messages_.push_back(text);
    }
  }

 private:
  std::vector<std::string>& messages_;
};

}  // namespace

UrdfdomResult parse_by_urdfdom(const std::string& text) {
  static std::mutex one_at_a_time;  // the output handler is one for the whole program
  const std::lock_guard lock(one_at_a_time);
  UrdfdomResult result;
  const Collector collector(result.messages);
  try {
    result.model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    result.model.reset();
    result.messages.emplace_back(error.what());
  }
  return result;
}

}  // namespace handway::geometric
