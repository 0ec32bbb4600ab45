#include "device_serve.h"

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

CLI::Option* add_serve_options(CLI::App& command, ServeOptions& options) {
  CLI::Option* tcp = command.add_option(
      "--tcp", options.tcp_port, "Listen on this TCP port of this computer; 0: any free one");
  command.add_flag("--pty", options.pty, "Open a pseudo-terminal, as a serial port")->excludes(tcp);
  command.add_option("--duration", options.duration_s, "End after so many s")
      ->check(positive_number());
  return tcp;
}

void add_line_fault_options(CLI::App& command, LineFaultOptions& options) {
  command.add_option("--dropout", options.dropout, "Share of records that are lost, 0 to 1")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--garbage", options.garbage, "Share of records that are damaged, 0 to 1")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--latency", options.latency_ms, "Delay of all that it sends, ms")
      ->check(CLI::Range(0.0, 60000.0));
  command
      .add_option("--unplug-after", options.unplug_after_s,
                  "Pull what measures off its unit after so many s")
      ->check(positive_number());
  command
      .add_option("--plug-again-after", options.plug_again_after_s,
                  "Put it back on so many s after the start")
      ->check(positive_number());
}

device::DeviceEmulatorSettings emulator_settings(const LineFaultOptions& options,
                                                 std::uint64_t seed) {
  device::DeviceEmulatorSettings settings;
  settings.faults = {options.dropout, options.garbage, seed};
  settings.latency = options.latency_ms / 1000.0;
  settings.unplug_at = options.unplug_after_s;
  settings.replug_at = options.plug_again_after_s;
  return settings;
}

void wait_until_ended(const std::string& address, const std::optional<double>& duration) {
  using Clock = std::chrono::steady_clock;
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  fmt::print("{}\n", address);
  std::fflush(stdout);
  const auto begin = Clock::now();
  while (!stop.stop_requested() &&
         !(duration && Clock::now() - begin > std::chrono::duration<double>(*duration))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

int serve_device(device::DeviceEmulatorSettings settings, std::unique_ptr<device::DeviceUnit> unit,
                 const ServeOptions& options) {
  settings.tcp_port = options.tcp_port;
  const device::DeviceEmulator emulator(settings, std::move(unit));
  wait_until_ended(emulator.address(), options.duration_s);
  fmt::print(stderr, "{} records sent, {} of them lost or damaged\n", emulator.records(),
             emulator.faults());
  return kDone;
}

}  // namespace handway::tools
