#include "basis_figures.h"
#include "basis_quality.h"
#include "commands.h"
#include "figures_program.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/hand/joint_recording.h"
#include "handway/device/retargeting/fingertip_errors.h"
#include "handway/device/retargeting/fingertip_retargeter.h"
#include "handway/device/retargeting/mapping_check.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/alike_lines.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway/report/rendering/text.h"
#include "handway/report/studies/basis_study_document.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/posture_table.h"
#include "mapped_recording.h"
#include "numbers.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

using device::SensorQuality;

constexpr Eigen::Index kMostShares = 8;
constexpr double kLargeEntry = 0.3;

std::string states(const SensorQuality& sensor) {
  return std::string(sensor.dead ? "  dead" : "") + (sensor.noisy ? "  noisy" : "") +
         (sensor.saturated ? "  saturated" : "");
}

/// Prints rate, repetitions, gaps and warnings of a recording, and the range of each sensor.
std::string quality_text(const MappedRecording& recording) {
  const device::RecordingQuality& quality = recording.quality;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out, "{}: {} rows of {}, {:.1f} s at {:.1f} Hz, {} repeated, {} gaps (longest {:.3g} s)\n",
      recording.file.string(), quality.rows, recording.calibrated ? "counts" : "angles",
      quality.duration, quality.rate, quality.duplicates, quality.gaps, quality.largest_gap);
  const bool counts = recording.calibrated;
  const double scale = counts ? 1.0 : 1.0 / geometric::kDegree;
  if (!quality.sensors.empty()) {
    fmt::format_to(out, "  {:<18}{:>8}{:>8}{:>8}\n", counts ? "sensor, counts" : "sensor, deg",
                   "least", "most", "noise");
  }
  for (const SensorQuality& sensor : quality.sensors) {
    fmt::format_to(out, "  {:<18}{:>8.1f}{:>8.1f}{:>8.2f}{}\n",
                   device::cyberglove_sensors()[static_cast<std::size_t>(sensor.sensor)].name,
                   scale * sensor.least, scale * sensor.most, scale * sensor.noise, states(sensor));
  }
  for (const std::string& warning : geometric::merged_alike(recording.recording.warnings)) {
    text += "  warning: " + warning + '\n';
  }
  for (const std::string& warning : geometric::merged_alike(quality.warnings)) {
    text += "  warning: " + warning + '\n';
  }
  return text;
}

/// Describes how many samples of each joint were clamped to its limits.
std::string clamp_text(const std::vector<MappedRecording>& recordings,
                       const device::PostureSource& mapper) {
  std::vector<Eigen::Index> clamped(mapper.joints().size(), 0);
  Eigen::Index samples = 0;
  for (const MappedRecording& recording : recordings) {
    samples += recording.mapped.postures.rows();
    for (std::size_t j = 0; j < clamped.size(); ++j) {
      clamped[j] += recording.mapped.clamped[j];
    }
  }
  std::string text;
  for (std::size_t j = 0; j < clamped.size(); ++j) {
    if (clamped[j] > 0) {
      text += fmt::format("  {:<18}{:>8}  {:5.1f} %\n", mapper.joints()[j], clamped[j],
                          100.0 * static_cast<double>(clamped[j]) / static_cast<double>(samples));
    }
  }
  return text.empty() ? fmt::format("All {} samples are within the joint limits.\n", samples)
                      : fmt::format("Clamped to joint limits, of {} samples:\n", samples) + text;
}

/// A line of cumulative shares, in percent, for each of the named analyses.
std::string share_text(
    const std::vector<std::pair<std::string, sampling::PrincipalComponents>>& analyses) {
  std::size_t width = 0;
  Eigen::Index columns = 0;
  for (const auto& [name, components] : analyses) {
    width = std::max(width, name.size());
    columns = std::max(columns, std::min(kMostShares, components.shares.size()));
  }
  std::string text = fmt::format("  {:<{}}", "components", std::max<std::size_t>(width, 10));
  for (Eigen::Index k = 0; k < columns; ++k) {
    text += fmt::format("{:>8}", k + 1);
  }
  text += '\n';
  for (const auto& [name, components] : analyses) {
    text += fmt::format("  {:<{}}", name, std::max<std::size_t>(width, 10));
    double sum = 0.0;
    for (Eigen::Index k = 0; k < std::min(columns, components.shares.size()); ++k) {
      sum += components.shares[k];
      text += fmt::format("{:>8.2f}", 100.0 * sum);
    }
    text += '\n';
  }
  return text;
}

/// Principal angles between the spaces of the first components, in degrees, for each pair.
std::string angle_text(
    const std::vector<std::pair<std::string, sampling::PrincipalComponents>>& analyses,
    int components) {
  std::string text;
  for (std::size_t a = 0; a < analyses.size(); ++a) {
    for (std::size_t b = a + 1; b < analyses.size(); ++b) {
      const Eigen::MatrixXd& first = analyses[a].second.directions;
      const Eigen::MatrixXd& second = analyses[b].second.directions;
      const Eigen::Index count = std::min({Eigen::Index{components}, first.cols(), second.cols()});
      text += fmt::format("  {} and {}:", analyses[a].first, analyses[b].first);
      for (const double angle :
           sampling::principal_angles(first.leftCols(count), second.leftCols(count))) {
        text += fmt::format(" {:.1f}", angle / geometric::kDegree);
      }
      text += '\n';
    }
  }
  return text;
}

/// Two lines: numbers of components k, and the largest principal angle between the spaces of the
/// first k of either, in degrees.
std::string largest_angle_text(const sampling::PrincipalComponents& a,
                               const sampling::PrincipalComponents& b) {
  constexpr Eigen::Index kMost = 4;
  std::string numbers = fmt::format("  {:<10}", "components");
  std::string angles = fmt::format("  {:<10}", "angle");
  const Eigen::Index count = std::min({kMost, a.directions.cols(), b.directions.cols()});
  for (Eigen::Index k = 1; k <= count; ++k) {
    const double angle =
        sampling::principal_angles(a.directions.leftCols(k), b.directions.leftCols(k)).maxCoeff();
    numbers += fmt::format("{:>8}", k);
    angles += fmt::format("{:>8.1f}", angle / geometric::kDegree);
  }
  return numbers + '\n' + angles + '\n';
}

/// Axes and half sides of a basis, and its largest entries.
std::string basis_text(const sampling::PmdBasis& basis) {
  std::string text;
  for (const sampling::FreeJoint& free : basis.free_joints) {
    text += fmt::format("  {:<6} half side {:.4f}  {}\n", "free", free.half_side,
                        basis.joints[static_cast<std::size_t>(free.joint)]);
  }
  for (const sampling::PrincipalDirection& direction : basis.directions) {
    text += fmt::format("  {:<6} half side {:.4f}  ", direction.name, direction.half_side);
    for (Eigen::Index j = 0; j < direction.vector.size(); ++j) {
      if (std::abs(direction.vector[j]) >= kLargeEntry) {
        text += fmt::format("{:+.2f} {}  ", direction.vector[j],
                            basis.joints[static_cast<std::size_t>(j)]);
      }
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return basis.directions.empty()
             ? text + "  warning: no direction found: no joint moves within its limits\n"
             : text;
}

namespace fs = std::filesystem;
using geometric::ResourceKind;
using NamedComponents = std::vector<std::pair<std::string, sampling::PrincipalComponents>>;

struct PcaOptions {
  std::vector<fs::path> recordings;
  fs::path mapping;
  std::string retarget;
  std::string joints_of;
  fs::path against;
  fs::path calibration;
  std::vector<std::string> free;
  int components = 4;
  double sigmas = 1.5;
  Normalisation normalisation = Normalisation::kLimits;
  bool robust = false;
  bool compare = false;
  bool fingertips = false;
  RecordingSteps steps;
  fs::path out;
  fs::path postures;
  fs::path plots;
  fs::path report;
  std::uint64_t seed = 1;
};

/// The robot's hand, and its mapping from a person's.
struct HandSource {
  fs::path robot;  ///< Its file.
  std::shared_ptr<const geometric::RobotModel> model;
  std::unique_ptr<device::PostureSource> source;
  device::HandBones bones;  ///< The person's.
};

HandSource hand_source(const PcaOptions& options, const device::GloveCalibration& person) {
  const fs::path preset = geometric::resource_dir() / "mappings" / "table1_sah.yaml";
  const fs::path file = options.mapping.empty() ? preset : options.mapping;
  HandSource made;
  made.bones = person.bones.value_or(device::typical_bones());
  const auto load = [&](const std::string& hand, const fs::path& folder, const std::string& by) {
    made.robot = geometric::find_resource(ResourceKind::kRobot, hand, folder, by);
    made.model = geometric::load_robot(made.robot);
  };
  const fs::path folder = fs::absolute(file).parent_path();
  if (!options.joints_of.empty()) {
    load(options.joints_of, fs::current_path(), "--joints-of");
    made.model = geometric::hand_alone(made.model);
    made.source = std::make_unique<device::OwnJoints>(*made.model);
    return made;
  }
  if (!options.retarget.empty() || device::is_retargeting(file)) {
    device::RetargetingSettings settings;
    if (options.retarget.empty()) {
      settings = device::read_retargeting(file);
      load(settings.hand, folder, file.string());
    } else {
      load(options.retarget, fs::current_path(), "--retarget");
    }
    settings.bones = made.bones;
    made.source = std::make_unique<device::FingertipRetargeter>(made.model, settings);
    return made;
  }
  const device::HandMapping mapping = device::read_mapping(file);
  load(mapping.hand, folder, file.string());
  made.source = std::make_unique<device::HandMapper>(mapping, *made.model, true, person.ranges);
  return made;
}

void print_fingertips(const std::vector<MappedRecording>& recordings, const HandSource& chosen) {
  print_out(
      "Fingertip error (distance to the person's fingertips, scaled to the robot's fingers), mm:\n "
      " {:<22}{:>8}{:>8}"
      "{:>8}\n",
      "", "mean", "median", "95 %");
  std::vector<device::GloveAngles> rows;
  Eigen::MatrixXd postures(0, static_cast<Eigen::Index>(chosen.source->joints().size()));
  for (const MappedRecording& recording : recordings) {
    const Eigen::Index first = postures.rows();
    const Eigen::Index count = recording.mapped.postures.rows();
    postures.conservativeResize(first + count, postures.cols());
    postures.bottomRows(count) = recording.mapped.postures;
    for (Eigen::Index row = 0; row < count; ++row) {
      rows.push_back(device::angles_of_row(recording.recording, row));
    }
  }
  const auto print = [&](const char* name, const std::vector<std::string>& joints,
                         const Eigen::MatrixXd& all, const device::FingertipRetargeter& hand) {
    const device::FingertipErrors errors = device::fingertip_errors(rows, joints, all, hand);
    print_out("  {:<22}{:>8.1f}{:>8.1f}{:>8.1f}\n", name, 1e3 * errors.mean, 1e3 * errors.median,
              1e3 * errors.most);
  };
  const auto* retargeter = dynamic_cast<const device::FingertipRetargeter*>(chosen.source.get());
  if (retargeter != nullptr) {
    print("fingertip retargeting", retargeter->joints(), postures, *retargeter);
    return;
  }
  device::RetargetingSettings settings;
  settings.bones = chosen.bones;
  const device::FingertipRetargeter other(chosen.model, settings);
  print("this mapping", chosen.source->joints(), postures, other);
  Eigen::MatrixXd retargeted(postures.rows(), static_cast<Eigen::Index>(other.joints().size()));
  Eigen::Index first = 0;
  for (const MappedRecording& recording : recordings) {
    const device::MappedPostures mapped = other.map_recording(recording.recording);
    retargeted.middleRows(first, mapped.postures.rows()) = mapped.postures;
    first += mapped.postures.rows();
  }
  print("fingertip retargeting", other.joints(), retargeted, other);
}

// Returns the thumb base, if the hand has one, unless other joints or "none" were requested.
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
  return text.empty() ? "none" : text;
}

std::string source_of(const PcaOptions& options, const Analysis& analysis) {
  std::string files;
  for (const fs::path& file : options.recordings) {
    files += (files.empty() ? "" : ", ") + file.filename().string();
  }
  return fmt::format(
      "handway pca of {}: {} samples{}, joints normalised by {}", files, analysis.samples,
      options.robust ? fmt::format(" ({} outliers excluded)", analysis.outliers) : "",
      options.normalisation == Normalisation::kLimits ? "their limits" : "their recorded range");
}

void print_comparison(const std::vector<MappedRecording>& recordings, const PcaOptions& options,
                      const device::PostureSource& mapper, const std::vector<int>& free,
                      const Analysis& joined) {
  NamedComponents each;
  for (const MappedRecording& recording : recordings) {
    const Eigen::MatrixXd samples = normalised_samples({recording}, mapper, options.normalisation);
    each.emplace_back(recording.file.filename().string(),
                      analyse(samples, free, options.robust).components);
  }
  each.emplace_back("all together", joined.components);
  print_out("Cumulative variance of each recording alone, %:\n{}", share_text(each));
  print_out("Principal angles between the subspaces of the first {} components, deg:\n{}",
            options.components, angle_text(each, options.components));
}

// Prints the result of the same recordings under another mapping to the same hand.
void print_other_mapping(const std::vector<MappedRecording>& recordings, const PcaOptions& options,
                         const geometric::RobotModel& hand, const device::PostureSource& mapper,
                         const std::vector<int>& free, const Analysis& chosen,
                         const device::PersonRanges& ranges) {
  const device::HandMapper other(device::read_mapping(options.against), hand, true, ranges);
  if (other.joints() != mapper.joints()) {
    throw geometric::InputError(
        {options.against.string(), "joints", "other joints, or another order of the joints",
         "the joints of --mapping in its order", "Copy that mapping and change it."});
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
  print_out("Cumulative variance with the other mapping, %:\n{}", share_text(both));
  print_out("Largest angle between the subspaces of the first components, deg:\n{}",
            largest_angle_text(both[0].second, both[1].second));
}

void report(const std::vector<MappedRecording>& recordings, const PcaOptions& options,
            const HandSource& hand, const std::vector<int>& free) {
  sampling::BasisStudySettings settings;
  settings.free_joints = free;
  settings.directions = options.components;
  settings.seed = options.seed;
  const sampling::BasisStudy study =
      study_recordings(recordings, hand.model, *hand.source, options.normalisation, settings);
  print_out("{}", report::to_text(report::basis_study_document(study, settings.confidence)));
  write_study(study, settings, recordings, hand.model->name(), *hand.source, options.report);
}

/// Counts the rows that differ from all others, at most `enough`.
Eigen::Index distinct_rows(const Eigen::MatrixXd& samples, Eigen::Index enough) {
  constexpr double kSame = 1e-9;
  std::vector<Eigen::Index> distinct;
  for (Eigen::Index row = 0; row < samples.rows() && std::ssize(distinct) < enough; ++row) {
    if (std::ranges::none_of(distinct, [&](Eigen::Index other) {
          return (samples.row(row) - samples.row(other)).cwiseAbs().maxCoeff() < kSame;
        })) {
      distinct.push_back(row);
    }
  }
  return std::ssize(distinct);
}

/// Reports a basis that would only repeat its few rows.
/// @throws InputError if all rows are the same posture, from which no direction follows.
void look_at_rows(const std::vector<MappedRecording>& recordings, const PcaOptions& options,
                  const Eigen::MatrixXd& samples, const std::vector<int>& free) {
  const auto differs = [](const MappedRecording& recording, const MappedRecording& first) {
    const Eigen::MatrixXd& rows = recording.mapped.unclamped;
    return (rows.rowwise() - first.mapped.unclamped.row(0)).cwiseAbs().maxCoeff() > 1e-9;
  };
  if (std::ranges::none_of(recordings, [&](const MappedRecording& recording) {
        return differs(recording, recordings.front());
      })) {
    throw geometric::InputError(
        {options.recordings.front().string(), "",
         samples.rows() == 1 ? "one row" : fmt::format("{} equal rows", samples.rows()),
         "postures that differ", "A single posture defines no motion direction"});
  }
  const Eigen::Index joints = samples.cols() - std::ssize(free);
  const Eigen::Index distinct = distinct_rows(samples, joints + 1);
  if (distinct <= joints) {
    print_out(
        "  warning: only {} different row{} for {} joints: the basis spans no other postures; "
        "record more postures\n",
        distinct, distinct == 1 ? "" : "s", joints);
  }
}

// The times of all rows, from 0 for each recording.
Eigen::VectorXd times_of(const std::vector<MappedRecording>& recordings) {
  std::vector<double> times;
  for (const MappedRecording& recording : recordings) {
    for (const double time : recording.recording.times) {
      times.push_back(time - recording.recording.times[0]);
    }
  }
  return Eigen::Map<const Eigen::VectorXd>(times.data(), std::ssize(times));
}

// Origins of the recordings that say more than the names of their files, after a semicolon each.
std::string origins_of(const std::vector<MappedRecording>& recordings) {
  std::string text;
  for (const MappedRecording& recording : recordings) {
    const std::string& origin = recording.recording.header.origin;
    text += origin.empty() || origin == recording.file.filename() ? "" : "; " + origin;
  }
  return text;
}

// Writes plots and, if there is a program that draws them, pictures of the hand.
void write_plots(const fs::path& folder, const sampling::PmdBasis& basis,
                 const Eigen::MatrixXd& postures, const Eigen::VectorXd& shares) {
  write_basis_plots(folder, basis, postures, shares);
  try {
    draw_pictures(folder);
  } catch (const geometric::InputError& error) {
    print_error("handway: no pictures of the hand: {}\n", error.what());
  }
}

int pca(const PcaOptions& options) {
  const device::GloveCalibration calibration = options.calibration.empty()
                                                   ? device::typical_calibration()
                                                   : device::read_calibration(options.calibration);
  const HandSource hand = hand_source(options, calibration);
  const device::PostureSource& mapper = *hand.source;
  const std::vector<int> free = free_joints(options, mapper.joints());
  std::vector<MappedRecording> recordings;
  for (const fs::path& file : options.recordings) {
    const device::Recording read = options.joints_of.empty()
                                       ? device::read_recording(file)
                                       : device::read_joint_recording(file, *hand.model);
    recordings.push_back(mapped_recording(file, read, calibration, options.steps, mapper));
    print_out("{}", quality_text(recordings.back()));
    if (recordings.back().calibrated && options.calibration.empty()) {
      print_out("  warning: no --calibration given: assuming the counts of a typical right hand\n");
    }
  }
  print_out("{}", clamp_text(recordings, mapper));
  for (const MappedRecording& recording : recordings) {
    if (const std::string warning = device::clamping_warning(recording.mapped); !warning.empty()) {
      print_out("  warning: {}\n", warning);
    }
  }

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
  look_at_rows(recordings, options, chosen_samples, free);
  print_out("Cumulative variance, % (free joints: {}):\n{}", names_of(free, mapper.joints()),
            share_text(both));
  if (options.robust) {
    print_out("{} of {} samples excluded as outliers\n", chosen.outliers, chosen.samples);
  }
  if (options.compare) {
    print_comparison(recordings, options, mapper, free, chosen);
  }
  if (!options.against.empty()) {
    print_other_mapping(recordings, options, *hand.model, mapper, free, chosen, calibration.ranges);
  }
  if (options.fingertips) {
    print_fingertips(recordings, hand);
  }
  if (!options.report.empty()) {
    report(recordings, options, hand, free);
  }
  const fs::path out_folder =
      options.out.empty() ? fs::current_path() : fs::absolute(options.out).parent_path();
  const auto hand_seen_from = [&](const fs::path& folder) {
    return geometric::resource_reference(ResourceKind::kRobot, hand.robot, folder).string();
  };
  sampling::PmdBasis basis = sampling::make_pmd_basis(
      hand_seen_from(out_folder), source_of(options, chosen), mapper.joints(), chosen.components,
      {free, options.components, options.sigmas});
  print_out("Basis for {}:\n{}", basis.hand, basis_text(basis));
  if (!options.postures.empty()) {
    sampling::write_postures({basis.hand, basis.source + origins_of(recordings), basis.joints,
                              chosen_samples, times_of(recordings)},
                             options.postures);
    basis.postures = options.postures;
  }
  if (!options.out.empty()) {
    sampling::write_pmd_basis(basis, options.out);
  }
  if (!options.plots.empty()) {
    basis.hand = hand_seen_from(fs::absolute(options.plots));
    write_plots(options.plots, basis, joint_values(chosen_samples, mapper),
                chosen.components.shares);
  }
  return kDone;
}

void add_steps(CLI::App& command, RecordingSteps& steps) {
  command
      .add_option("--from", steps.from,
                  "Start of the part to use, s after the start of the recording")
      ->check(not_negative());
  command
      .add_option("--to", steps.to, "End of the part to use, s after the start of the recording")
      ->check(positive_number());
  command.add_flag("--drop-duplicates", steps.drop_duplicates,
                   "Leave out rows that are equal to the previous row");
  command.add_option("--resample", steps.resample, "Resample to this constant rate, Hz")
      ->check(number_in(1e-3, 1e15));
  command.add_option("--low-pass", steps.low_pass, "Cut-off frequency of a low-pass filter, Hz")
      ->check(number_in(1e-3, 1e6));
}

}  // namespace

void add_pca_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PcaOptions>();
  CLI::App* command =
      app.add_subcommand("pca", "Compute principal motion directions from recordings of a hand");
  command
      ->add_option("recordings", options->recordings,
                   "Recordings of a glove or, with --joints-of, of a robot hand")
      ->required();
  command->add_option("--mapping", options->mapping,
                      "Mapping of the glove to a hand, or a fingertip retargeting (default: Table "
                      "1 for the SAH hand)");
  command
      ->add_option("--retarget", options->retarget,
                   "Fingertip retargeting to this robot hand, without a mapping")
      ->type_name("ROBOT")
      ->excludes("--mapping");
  command
      ->add_option(
          "--joints-of", options->joints_of,
          "The recordings are of this robot hand's own joints, without a glove and a mapping")
      ->type_name("ROBOT")
      ->excludes("--mapping")
      ->excludes("--retarget");
  command
      ->add_option(
          "--against", options->against,
          "Another mapping to the same hand, to compare the variances and subspaces of both")
      ->excludes("--joints-of");
  command
      ->add_option("--calibration", options->calibration,
                   "Calibration of glove and person (default: a typical right hand's)")
      ->excludes("--joints-of");
  command
      ->add_option("--free", options->free,
                   "Free joint: it is excluded from the analysis and has an axis of its own "
                   "(default: thumb_base, if the hand has it); \"none\": no free joint")
      ->type_name("JOINT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--components", options->components,
                   "Number of principal directions of the basis")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--sigmas", options->sigmas,
                   "Half side of the box, in standard deviations along each direction")
      ->check(positive_number())
      ->capture_default_str();
  command
      ->add_option("--normalise", options->normalisation,
                   "Scale joints by their limits or by their recorded range")
      ->type_name("limits|range")
      ->transform(CLI::Transformer(std::map<std::string, Normalisation>{
          {"limits", Normalisation::kLimits}, {"range", Normalisation::kRange}}))
      ->option_text("limits|range [limits]");
  command->add_flag("--robust", options->robust, "Exclude outliers");
  command->add_flag("--compare", options->compare, "Also analyse each recording alone");
  command
      ->add_flag("--fingertips", options->fingertips,
                 "Print the distances of the robot's fingertips from the person's, with the "
                 "mapping and with retargeting")
      ->excludes("--joints-of");
  add_steps(*command, options->steps);
  command->add_option("--out", options->out, "File for the basis (YAML)");
  command->add_option("--postures", options->postures,
                      "File for the postures (CSV), which the basis then names");
  command->add_option("--plots", options->plots,
                      "Folder for figures: plots (SVG) and pictures (PNG and SVG)");
  command->add_option("--report", options->report,
                      "File for a report (JSON): the number of directions that are enough, their "
                      "stability, and their quality for each recording; it is also printed");
  command->add_option("--seed", options->seed, "Seed of the report's bootstrap")
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = pca(*options); });
}

}  // namespace handway::tools
