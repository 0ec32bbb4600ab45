#include "commands.h"
#include "glove_commands.h"
#include "handway/device/glove/glove_signals.h"
#include "numbers.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>

namespace handway::tools {
namespace {

constexpr int kMostSamples = 10'000'000;

struct GenerateOptions {
  std::uint64_t seed = 1;
  int samples = 13500;
  double rate = 100.0;
  std::filesystem::path out;
};

}  // namespace

void add_glove_generate(CLI::App& glove, int& exit_code) {
  auto options = std::make_shared<GenerateOptions>();
  CLI::App* command = glove.add_subcommand("generate", "Make a recording of a synthetic hand");
  command->add_option("--seed", options->seed, "Seed of the hand's motion and the noise")
      ->check(not_negative())
      ->capture_default_str();
  command->add_option("--samples", options->samples, "Rows")
      ->check(CLI::Range(1, kMostSamples))
      ->capture_default_str();
  command->add_option("--rate", options->rate, "Rows a second")
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--out", options->out, "Write the recording here (CSV)")->required();
  command->callback([options, &exit_code] {
    device::write_recording(
        device::generate_recording(options->seed, options->samples, options->rate), options->out);
    exit_code = kDone;
  });
}

}  // namespace handway::tools
