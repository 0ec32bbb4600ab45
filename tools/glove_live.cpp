#include "commands.h"
#include "emulated_device.h"
#include "glove_commands.h"
#include "handway/device/emulators/glove_signals.h"
#include "handway/device/glove/glove.h"
#include "handway/device/glove/recording.h"
#include "handway/device/glove/replay_glove.h"
#include "numbers.h"
#include "printing.h"
#include "terminal.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <stop_token>
#include <string>

namespace handway::tools {
namespace {

struct GloveShowOptions {
  std::uint64_t frames = 0;  ///< Number of frames; 0: until Ctrl+C or the end.
  bool json = false;
};

using device::GloveFrame;
using device::GloveInfo;
using device::GloveStream;
using device::StreamState;
using std::chrono::milliseconds;

constexpr milliseconds kRefresh{100};

/// Takes frames on the stream's thread, for display by the main thread.
class Latest {
 public:
  explicit Latest(std::uint64_t wanted) : wanted_(wanted) {}

  /// @returns whether the frame is one of those requested.
  bool take(const GloveFrame& frame) {
    const std::lock_guard lock(mutex_);
    if (wanted_ > 0 && count_ == wanted_) {
      return false;
    }
    frame_ = frame;
    ++count_;
    return true;
  }
  [[nodiscard]] bool complete() const {
    const std::lock_guard lock(mutex_);
    return wanted_ > 0 && count_ == wanted_;
  }
  [[nodiscard]] GloveFrame frame() const {
    const std::lock_guard lock(mutex_);
    return frame_;
  }

 private:
  const std::uint64_t wanted_;
  mutable std::mutex mutex_;
  GloveFrame frame_;
  std::uint64_t count_ = 0;
};

void announce(const GloveInfo& info) {
  print_error("{}: {}, {} sensors, {} hand\n", info.device, info.model,
              info.angle_sensors.empty() ? static_cast<std::size_t>(info.sensors)
                                         : info.angle_sensors.size(),
              info.right_hand ? "right" : "left");
}

void add_glove_show_options(CLI::App& command, GloveShowOptions& options) {
  command.add_option("--frames", options.frames, "Stop after this number of frames")
      ->check(CLI::PositiveNumber);
  command.add_flag("--json", options.json, "Print one JSON object per line instead of a table");
}

/// Shows a glove's measurements: on a terminal a table that is refreshed, else one line per frame.
/// @throws geometric::InputError if it can't be connected.
/// @returns the exit code.
int show_glove(std::unique_ptr<device::Glove> glove, const GloveShowOptions& options) {
  const bool table = !options.json && ::isatty(STDOUT_FILENO) != 0;
  Latest latest(options.frames);
  int sensors = device::kGloveSensors;
  device::GloveStreamHandlers handlers;
  handlers.on_connected = [&](const GloveInfo& info) {
    sensors = info.sensors;
    announce(info);
  };
  handlers.on_sample = [&](const GloveFrame& frame) {
    if (latest.take(frame) && !table) {
      print_line(options.json ? frame_json(frame, sensors) : frame_line(frame, sensors));
    }
  };
  handlers.on_state = [&](StreamState state) {
    if (!table && (state == StreamState::kLost || state == StreamState::kUnplugged)) {
      print_error("{}\n", state_name(state));
    }
  };
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  GloveStream stream(std::move(glove), {}, handlers);
  bool first = true;
  while (!stop.stop_requested() && !latest.complete() && !stream.wait(kRefresh)) {
    const device::StreamStatistics statistics = stream.statistics();
    if (table && statistics.frames > 0) {
      print_table(glove_table(latest.frame(), stream.info().sensors, stream.state(), statistics),
                  first);
      first = false;
    }
  }
  if (stream.state() == StreamState::kFailed) {
    throw std::runtime_error(stream.error());
  }
  const device::StreamStatistics statistics = stream.statistics();
  stream.request_stop();
  stream.wait(milliseconds(1000));
  if (options.json) {
    print_line(statistics_json(statistics));
  } else {
    print_error("{}\n", statistics_line(statistics));
  }
  return kDone;
}

}  // namespace

void add_glove_live(CLI::App& glove, int& exit_code) {
  struct Options {
    GloveDeviceOptions device;
    GloveShowOptions show;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = glove.add_subcommand("live", "Show the measurements of a glove");
  add_glove_device_options(*command, options->device);
  add_glove_show_options(*command, options->show);
  command->callback([options, &exit_code] {
    exit_code = show_glove(make_glove(options->device), options->show);
  });
}

namespace {

struct ReplayOptions {
  std::filesystem::path file;
  device::ReplaySettings replay;
  GloveShowOptions show;
  ServeOptions serve;
};

device::Recording read(const std::filesystem::path& file) {
  device::Recording recording = device::read_recording(file);
  for (const std::string& warning : recording.warnings) {
    print_error("warning: {}\n", warning);
  }
  return recording;
}

int replay(const ReplayOptions& options) {
  device::Recording recording = read(options.file);
  if (!options.serve.pty && !options.serve.tcp_port) {
    return show_glove(
        std::make_unique<device::ReplayGlove>(recording, options.file.string(), options.replay),
        options.show);
  }
  recording.times /= options.replay.speed;
  device::SensorFaults none;
  none.noise = 0.0;
  auto unit = std::make_unique<device::CyberGloveUnit>(device::CyberGloveUnitSettings{},
                                                       recorded_signal(recording, 1, none));
  return serve_device({}, std::move(unit), options.serve);
}

}  // namespace

void add_glove_replay(CLI::App& glove, int& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = glove.add_subcommand("replay", "Play a recording as a glove's measurements");
  command->add_option("recording", options->file, "Recording (CSV)")->required();
  command
      ->add_option("--speed", options->replay.speed, "Speed, as a multiple of the recorded speed")
      ->check(positive_number())
      ->capture_default_str();
  command->add_flag("--loop", options->replay.loop, "Repeat until interrupted");
  add_glove_show_options(*command, options->show);
  add_serve_options(*command, options->serve);
  command->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace handway::tools
