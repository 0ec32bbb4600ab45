#include "pca_command.h"

#include "basis_plots.h"
#include "exit_codes.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/robot_loader.h"
#include "handway/sampling/postures/pmd_basis_io.h"
#include "handway/sampling/postures/posture_table.h"
#include "mapped_recording.h"
#include "number_options.h"
#include "pca_text.h"
#include "posture_analysis.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using geometric::ResourceKind;
using NamedComponents = std::vector<std::pair<std::string, sampling::PrincipalComponents>>;

struct PcaOptions {
  std::vector<fs::path> recordings;
  fs::path mapping;
  fs::path against;
  fs::path calibration;
  std::vector<std::string> free;
  int components = 4;
  double sigmas = 1.5;
  Normalisation normalisation = Normalisation::kLimits;
  bool robust = false;
  bool compare = false;
  RecordingSteps steps;
  fs::path out;
  fs::path postures;
  fs::path plots;
};

device::HandMapping mapping_of(const PcaOptions& options) {
  const fs::path preset = geometric::resource_dir() / "mappings" / "table1_sah.yaml";
  return device::read_mapping(options.mapping.empty() ? preset : options.mapping);
}

// The thumb base, if the hand has one, unless other joints or "none" were asked for.
std::vector<int> free_joints(const PcaOptions& options, const std::vector<std::string>& joints) {
  if (options.free.empty()) {
    return std::ranges::count(joints, "thumb_base") > 0 ? joint_indices({"thumb_base"}, joints)
                                                        : std::vector<int>{};
  }
  return options.free == std::vector<std::string>{"none"} ? std::vector<int>{}
                                                          : joint_indices(options.free, joints);
}

std::string names_of(const std::vector<int>& indices, const std::vector<std::string>& joints) {
  std::string text;
  for (const int index : indices) {
    text += (text.empty() ? "" : ", ") + joints[static_cast<std::size_t>(index)];
  }
  return text.empty() ? "no joint" : text;
}

std::string source_of(const PcaOptions& options, const Analysis& analysis) {
  std::string files;
  for (const fs::path& file : options.recordings) {
    files += (files.empty() ? "" : ", ") + file.filename().string();
  }
  return fmt::format(
      "handway pca of {}: {} samples{}, joints normalised by {}", files, analysis.samples,
      options.robust ? fmt::format(" ({} outliers left out)", analysis.outliers) : "",
      options.normalisation == Normalisation::kLimits ? "their limits"
                                                      : "the range they went through");
}

void print_comparison(const std::vector<MappedRecording>& recordings, const PcaOptions& options,
                      const device::HandMapper& mapper, const std::vector<int>& free,
                      const Analysis& joined) {
  NamedComponents each;
  for (const MappedRecording& recording : recordings) {
    const Eigen::MatrixXd samples = normalised_samples({recording}, mapper, options.normalisation);
    each.emplace_back(recording.file.filename().string(),
                      analyse(samples, free, options.robust).components);
  }
  each.emplace_back("all together", joined.components);
  fmt::print("Each recording by itself, cumulative variance in %:\n{}", share_text(each));
  fmt::print("Angles in degrees between the spaces of the first {} components:\n{}",
             options.components, angle_text(each, options.components));
}

// What the same recordings give under another mapping to the same hand.
void print_other_mapping(const std::vector<MappedRecording>& recordings, const PcaOptions& options,
                         const geometric::RobotModel& hand, const device::HandMapper& mapper,
                         const std::vector<int>& free, const Analysis& chosen) {
  const device::HandMapper other(device::read_mapping(options.against), hand);
  if (other.joints() != mapper.joints()) {
    throw geometric::InputError({options.against.string(), "joints", "others, or another order",
                                 "the joints of --mapping in its order",
                                 "Copy that mapping and change it."});
  }
  std::vector<MappedRecording> mapped;
  for (const MappedRecording& recording : recordings) {
    MappedRecording copy{recording.file, {}, {}, recording.calibrated, {}};
    copy.mapped = other.map_recording(recording.recording);
    mapped.push_back(std::move(copy));
  }
  const Eigen::MatrixXd samples = normalised_samples(mapped, other, options.normalisation);
  const NamedComponents both{
      {"this mapping", chosen.components},
      {options.against.filename().string(), analyse(samples, free, options.robust).components}};
  fmt::print("Under another mapping, cumulative variance in %:\n{}", share_text(both));
  fmt::print("Largest angle in degrees between the spaces of the first components:\n{}",
             largest_angle_text(both[0].second, both[1].second));
}

int pca(const PcaOptions& options) {
  const device::HandMapping mapping = mapping_of(options);
  const auto hand = geometric::load_robot(
      geometric::find_resource(ResourceKind::kRobot, mapping.hand, fs::current_path(),
                               options.mapping.empty() ? "" : options.mapping.string()));
  const device::HandMapper mapper(mapping, *hand);
  const std::vector<int> free = free_joints(options, mapper.joints());
  const device::GloveCalibration calibration = options.calibration.empty()
                                                   ? device::typical_calibration()
                                                   : device::read_calibration(options.calibration);
  std::vector<MappedRecording> recordings;
  for (const fs::path& file : options.recordings) {
    recordings.push_back(map_file(file, calibration, options.steps, mapper));
    fmt::print("{}", quality_text(recordings.back()));
    if (recordings.back().calibrated && options.calibration.empty()) {
      fmt::print("  warning: counts are taken for those of a typical hand: give --calibration\n");
    }
  }
  fmt::print("{}", clamp_text(recordings, mapper));

  NamedComponents both;
  Analysis chosen;
  Eigen::MatrixXd chosen_samples;
  for (const auto& [name, normalisation] :
       {std::pair("joints by limits", Normalisation::kLimits),
        std::pair("joints by own range", Normalisation::kRange)}) {
    Eigen::MatrixXd samples = normalised_samples(recordings, mapper, normalisation);
    Analysis analysis = analyse(samples, free, options.robust);
    both.emplace_back(name, analysis.components);
    if (normalisation == options.normalisation) {
      chosen = std::move(analysis);
      chosen_samples = std::move(samples);
    }
  }
  fmt::print("Cumulative variance in %, without {}:\n{}", names_of(free, mapper.joints()),
             share_text(both));
  if (options.robust) {
    fmt::print("{} of {} samples set aside as outliers\n", chosen.outliers, chosen.samples);
  }
  if (options.compare) {
    print_comparison(recordings, options, mapper, free, chosen);
  }
  if (!options.against.empty()) {
    print_other_mapping(recordings, options, *hand, mapper, free, chosen);
  }
  sampling::PmdBasis basis =
      sampling::make_pmd_basis(mapping.hand, source_of(options, chosen), mapper.joints(),
                               chosen.components, {free, options.components, options.sigmas});
  fmt::print("Basis for {}:\n{}", basis.hand, basis_text(basis));
  if (!options.postures.empty()) {
    sampling::write_postures({basis.hand, basis.source, basis.joints, chosen_samples},
                             options.postures);
    basis.postures = options.postures;
  }
  if (!options.out.empty()) {
    sampling::write_pmd_basis(basis, options.out);
  }
  if (!options.plots.empty()) {
    write_basis_plots(options.plots, basis, joint_values(chosen_samples, mapper),
                      chosen.components.shares);
  }
  return kDone;
}

void add_steps(CLI::App& command, RecordingSteps& steps) {
  command.add_option("--from", steps.from, "Leave out what was recorded before, s after the start")
      ->check(not_negative());
  command.add_option("--to", steps.to, "Leave out what was recorded later, s after the start")
      ->check(positive_number());
  command.add_flag("--drop-duplicates", steps.drop_duplicates,
                   "Leave out rows that repeat the one before");
  command.add_option("--resample", steps.resample, "Rows at even times, Hz")
      ->check(positive_number());
  command.add_option("--low-pass", steps.low_pass, "Smooth what is faster, Hz")
      ->check(positive_number());
}

}  // namespace

void add_pca_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PcaOptions>();
  CLI::App* command =
      app.add_subcommand("pca", "Find principal motion directions in recordings of a glove");
  command->add_option("recordings", options->recordings, "Recordings of a glove")->required();
  command->add_option("--mapping", options->mapping,
                      "Mapping of the glove to a hand (default: Table 1 for the SAH hand)");
  command->add_option("--against", options->against,
                      "Another mapping to the same hand: compare what both make of the recordings");
  command->add_option("--calibration", options->calibration,
                      "Calibration for recordings of counts (default: a typical right hand's)");
  command
      ->add_option("--free", options->free,
                   "A joint that gets an axis of its own (default: thumb_base); \"none\"")
      ->type_name("JOINT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--components", options->components, "Directions that the basis takes")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command->add_option("--sigmas", options->sigmas, "Half side of the box in standard deviations")
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--normalise", options->normalisation, "Scale joints by limits or range")
      ->type_name("limits|range")
      ->transform(CLI::Transformer(std::map<std::string, Normalisation>{
          {"limits", Normalisation::kLimits}, {"range", Normalisation::kRange}}))
      ->option_text("limits|range [limits]");
  command->add_flag("--robust", options->robust, "Set outliers aside");
  command->add_flag("--compare", options->compare, "Also analyse each recording by itself");
  add_steps(*command, options->steps);
  command->add_option("--out", options->out, "Write the basis here (YAML)");
  command->add_option("--postures", options->postures,
                      "Write the postures here (CSV), and name them in the basis");
  command->add_option("--plots", options->plots, "Draw figures to this folder (PNG and SVG)");
  command->callback([options, &exit_code] { exit_code = pca(*options); });
}

}  // namespace handway::tools
