#include "model/devices/program_end.h"

#include "model/devices/motion_driver.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <system_error>

namespace handway::gui {
namespace {

// Messages that the thread reads besides numbers of signals.
constexpr unsigned char kDone = 0;

std::atomic<int> signal_pipe = -1;
std::mutex driver_mutex;
MotionDriver* driver_at_exit = nullptr;

// Does only what a signal handler may do: the thread does the rest.
extern "C" void forward_signal(int signal) {
  const int error = errno;
  const auto number = static_cast<unsigned char>(signal);
  [[maybe_unused]] const auto written = ::write(signal_pipe, &number, 1);
  errno = error;
}

void warn_unless(bool rested) {
  if (!rested) {
    std::fputs("handway-workbench: the robot was not seen at rest: LOOK AT THE ROBOT\n", stderr);
  }
}

void stop_at_exit() {
  const std::lock_guard lock(driver_mutex);
  if (driver_at_exit != nullptr) {
    warn_unless(driver_at_exit->end(ProgramEnd::kLongestWait));
  }
}

}  // namespace

ProgramEnd::ProgramEnd(MotionDriver& driver) : driver_(driver) {
  if (::pipe2(pipe_.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "no pipe for signals");
  }
  signal_pipe = pipe_[1];
  {
    const std::lock_guard lock(driver_mutex);
    driver_at_exit = &driver;
  }
  [[maybe_unused]] static const int kRegistered = std::atexit(stop_at_exit);
  thread_ = std::thread([this] { wait_for_signals(); });
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) {  // as nohup wants it
      struct sigaction action {};
      action.sa_handler = forward_signal;
      action.sa_flags = SA_RESTART;
      ::sigaction(kSignals[i], &action, nullptr);
    }
  }
}

ProgramEnd::~ProgramEnd() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], &before_[i], nullptr);
  }
  {
    const std::lock_guard lock(driver_mutex);
    driver_at_exit = nullptr;
  }
  [[maybe_unused]] const auto written = ::write(pipe_[1], &kDone, 1);
  thread_.join();
  signal_pipe = -1;
  ::close(pipe_[0]);
  ::close(pipe_[1]);
}

void ProgramEnd::wait_for_signals() {
  unsigned char signal = kDone;
  while (::read(pipe_[0], &signal, 1) == 1 && signal != kDone) {
    warn_unless(driver_.stop_and_wait(kLongestWait));
    std::signal(signal, SIG_DFL);
    ::kill(::getpid(), signal);
  }
}

}  // namespace handway::gui
