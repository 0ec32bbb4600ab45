#include "glove_serve.h"

#include "exit_codes.h"
#include "interrupt.h"
#include "number_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <stop_token>
#include <thread>

namespace handway::tools {

void add_glove_serve_options(CLI::App& command, GloveServeOptions& options) {
  CLI::Option* tcp = command.add_option(
      "--tcp", options.tcp_port, "Listen on this TCP port of this computer; 0: any free one");
  command.add_flag("--pty", options.pty, "Open a pseudo-terminal, as a serial port")->excludes(tcp);
  command.add_option("--duration", options.duration_s, "End after so many s")
      ->check(positive_number());
}

int serve_glove(device::GloveEmulatorSettings settings, device::GloveSignal signal,
                const GloveServeOptions& options) {
  using Clock = std::chrono::steady_clock;
  settings.tcp_port = options.tcp_port;
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  const device::GloveEmulator emulator(settings, std::move(signal));
  fmt::print("{}\n", emulator.address());
  std::fflush(stdout);
  const auto begin = Clock::now();
  while (!stop.stop_requested() &&
         !(options.duration_s &&
           Clock::now() - begin > std::chrono::duration<double>(*options.duration_s))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  fmt::print(stderr, "{} records sent, {} of them lost or damaged\n", emulator.records(),
             emulator.faults());
  return kDone;
}

}  // namespace handway::tools
