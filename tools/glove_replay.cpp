#include "glove_replay.h"

#include "device_serve.h"
#include "glove_show.h"
#include "handway/device/glove/glove_signals.h"
#include "handway/device/glove/recording.h"
#include "handway/device/glove/replay_glove.h"
#include "number_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace handway::tools {
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
    fmt::print(stderr, "warning: {}\n", warning);
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
  CLI::App* command = glove.add_subcommand("replay", "Play a recording");
  command->add_option("recording", options->file, "Recording (CSV)")->required();
  command->add_option("--speed", options->replay.speed, "Times as fast as it was recorded")
      ->check(positive_number())
      ->capture_default_str();
  command->add_flag("--loop", options->replay.loop, "Begin again at the end");
  add_glove_show_options(*command, options->show);
  add_serve_options(*command, options->serve);
  command->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace handway::tools
