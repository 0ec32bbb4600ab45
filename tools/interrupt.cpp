#include "interrupt.h"

#include <csignal>

namespace handway::tools {
namespace {

std::stop_source* interrupted = nullptr;

extern "C" void on_interrupt(int signal) {
  interrupted->request_stop();
  std::signal(signal, SIG_DFL);
}

}  // namespace

StopsOnInterrupt::StopsOnInterrupt(std::stop_source& stop) {
  interrupted = &stop;
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

StopsOnInterrupt::~StopsOnInterrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  interrupted = nullptr;
}

}  // namespace handway::tools
