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
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    before_[i] = std::signal(kSignals[i], on_interrupt);
    if (kSignals[i] == SIGHUP && before_[i] == SIG_IGN) {  // as nohup wants it
      std::signal(SIGHUP, SIG_IGN);
    }
  }
}

StopsOnInterrupt::~StopsOnInterrupt() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    std::signal(kSignals[i], before_[i]);
  }
  interrupted = nullptr;
}

}  // namespace handway::tools
