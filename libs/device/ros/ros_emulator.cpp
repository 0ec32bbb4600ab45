#include "handway/device/ros/ros_emulator.h"

#include "core/web_socket_port.h"

#include <chrono>
#include <deque>
#include <mutex>
#include <thread>

namespace handway::device {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds kTick{1000};
constexpr double kFeedbackPeriod = 0.01;  // s

}  // namespace

struct RosEmulator::Running {
  Running(const RosControllerSettings& settings, std::uint16_t given)
      : controller(settings),
        port(given),
        address("ros://localhost:" + std::to_string(port.port())) {}

  struct Due {
    double time = 0.0;  ///< s
    WebSocketPort::Message message;
  };

  mutable std::mutex mutex;  ///< Of the controller.
  RosController controller;
  WebSocketPort port;
  std::string address;
  std::deque<Due> sent;
  std::jthread thread;  ///< Last: it uses all the others.

  void run(const std::stop_token& stop);
  void send(WebSocketPort::Host host, const RosController::Messages& messages, double now);
  [[nodiscard]] double delay() const {
    return controller.active_fault() == FaultKind::kLate ? kFaultDelay : 0.0;
  }
};

void RosEmulator::Running::send(WebSocketPort::Host host, const RosController::Messages& messages,
                                double now) {
  for (const std::string& text : messages) {
    sent.push_back({now + delay(), {host, text}});
  }
}

void RosEmulator::Running::run(const std::stop_token& stop) {
  const auto begin = Clock::now();
  double last_feedback = 0.0;
  bool cut = false;
  while (!stop.stop_requested()) {
    const std::vector<WebSocketPort::Message> messages = port.serve(kTick);
    const double now = std::chrono::duration<double>(Clock::now() - begin).count();
    const std::scoped_lock lock(mutex);
    controller.advance(now);
    for (const WebSocketPort::Message& message : messages) {
      send(message.host, controller.receive(message.host, message.text, now), now);
    }
    if (now - last_feedback >= kFeedbackPeriod) {
      last_feedback = now;
      for (const WebSocketPort::Host host : port.hosts()) {
        send(host, controller.feedback(host), now);
      }
    }
    if (controller.active_fault() == FaultKind::kLost && !cut) {
      cut = true;
      port.disconnect();
    }
    while (!sent.empty() && sent.front().time <= now) {
      port.send(sent.front().message.host, std::move(sent.front().message.text));
      sent.pop_front();
    }
  }
}

RosEmulator::RosEmulator(const RosControllerSettings& settings, std::uint16_t port)
    : running_(std::make_unique<Running>(settings, port)) {
  running_->thread =
      std::jthread([running = running_.get()](const std::stop_token& stop) { running->run(stop); });
}

RosEmulator::~RosEmulator() = default;

const std::string& RosEmulator::address() const { return running_->address; }

Eigen::VectorXd RosEmulator::position() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.position();
}

bool RosEmulator::moving() const {
  const std::scoped_lock lock(running_->mutex);
  return running_->controller.moving();
}

}  // namespace handway::device
