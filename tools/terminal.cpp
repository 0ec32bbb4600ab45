#include "terminal.h"

#include "handway/geometric/io/printable.h"
#include "printing.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

namespace handway::tools {

void print_line(const std::string& line) {
  print_out("{}\n", line);
  std::fflush(stdout);
}

void print_table(const std::string& table, bool first) {
  if (!first) {
    fmt::print("\033[{}A", std::count(table.begin(), table.end(), '\n'));
  }
  std::string cleared;
  for (const char c : geometric::printable(table)) {
    cleared += c == '\n' ? std::string("\033[K\n") : std::string(1, c);
  }
  fmt::print("{}", cleared);  // with what steers the terminal
  std::fflush(stdout);
}

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
