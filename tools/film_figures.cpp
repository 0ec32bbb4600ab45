#include "film_figures.h"

#include "campaign_command.h"
#include "emulated_run.h"
#include "figures_program.h"
#include "handway/device/core/device_error.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/hand_structure.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/paths/path_file.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/queries/human_likeness.h"
#include "handway/planning/queries/motion_likeness.h"
#include "handway/planning/spaces/state_space.h"
#include "handway/planning/timing/time_path.h"
#include "handway/report/rendering/csv.h"
#include "handway/sampling/sequences/random_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSeed = 1;
constexpr const char* kParameters = "preset=print, growth=linear";
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Row {
  const char* scene;
  const char* planner;
  const char* label;
  const char* camera = "";  ///< Keys of the row that turn it, if a shelf hides the view.
};

const std::vector<Row>& spaces() {
  static const std::vector<Row> kRows = {
      {"two_cans_on_table", "full-prm", "All joints of the hand (full-prm)"},
      {"two_cans_on_table", "pmd-prm", "Principal motion directions (pmd-prm)"}};
  return kRows;
}

const std::vector<Row>& problems() {
  static const std::vector<Row> kRows = {
      {"cans_on_desk", "pmd-prm", "1: Cans on a desk"},
      {"can_in_box", "pmd-prm", "2: Can in a box"},
      {"cans_in_shelf", "pmd-prm", "3: Cans in a shelf", ", azimuth_deg: -125, elevation_deg: 14"},
      {"cluttered_table", "pmd-prm", "4: T on a cluttered table",
       ", azimuth_deg: 70, elevation_deg: 28"}};
  return kRows;
}

fs::path scene_file(const Row& row) {
  return geometric::resource_dir().parent_path() / "scenes" / fmt::format("{}.yaml", row.scene);
}

/// Film strips of a figure, and what is measured on their paths.
class Film {
 public:
  Film(int number, std::string caption, const planning::PluginManager& plugins, double time_limit_s,
       const fs::path& folder)
      : made_{number, std::move(caption), "", {}, {}, ""},
        plugins_(plugins),
        time_limit_s_(time_limit_s),
        folder_(folder),
        name_(fmt::format("figure_{}", number)) {
    make_out_folder(folder_ / name_);
  }

  ReproducedFigure& made() { return made_; }

  [[nodiscard]] planning::PlanningProblem problem(const Row& row) const {
    const planning::SceneState loaded = planning::load_scene(scene_file(row), plugins_);
    return planning::make_problem(loaded.scene, loaded.basis);
  }

  // Returns nothing, and adds a sentence to the figure, if there is no path.
  [[nodiscard]] std::optional<planning::PlanResult> plan(const Row& row,
                                                         const planning::PlanningProblem& problem) {
    const auto planner = plugins_.planners().create(row.planner);
    planner->set_parameter(planning::kPresetKey, "print");
    planner->set_parameter("growth", "linear");
    planning::PlanResult result =
        planner->plan(problem, {.seed = kSeed, .time_limit_s = time_limit_s_});
    if (!result.solved()) {
      made_.problem += fmt::format("{}: {} ", row.label, result.reason);
      return std::nullopt;
    }
    return result;
  }

  void add(const Row& row, const std::string& file, const planning::Path& path,
           const planning::PlanningProblem& problem, const std::string& label) {
    const std::string csv = fmt::format("{}/{}.csv", name_, file);
    planning::write_path_csv(path, problem.model(), folder_ / csv);
    rows_ += fmt::format("  - {{label: \"{}\", scene: \"{}\", path: {}{}}}\n", label,
                         fs::absolute(scene_file(row)).string(), csv, row.camera);
  }

  // Takes the pictures. @param frames number of the pictures of a row, or "waypoints".
  [[nodiscard]] ReproducedFigure finish(const char* frames, const char* view) {
    if (made_.table) {
      geometric::replace_file(folder_ / (name_ + ".csv"), report::to_csv(*made_.table));
    }
    if (rows_.empty()) {
      return std::move(made_);
    }
    const fs::path file = folder_ / (name_ + ".yaml");
    geometric::replace_file(file, fmt::format("title: \"{}\"\nframes: {}\nview: {}\nrows:\n{}",
                                              made_.caption, frames, view, rows_));
    try {
      draw_pictures(file);
      made_.drawings.emplace_back(report::Picture{made_.caption, name_ + ".png"});
    } catch (const geometric::InputError& error) {
      made_.problem += error.what();
    }
    return std::move(made_);
  }

 private:
  ReproducedFigure made_;
  const planning::PluginManager& plugins_;
  double time_limit_s_;
  fs::path folder_;
  std::string name_;
  std::string rows_;
};

std::string planned_by(const std::string& planners) {
  return fmt::format("Planned by {} with {}, seed {}.", planners, kParameters, kSeed);
}

// Measures of a path that Fig. 14 shows and section 6.3 speaks of.
std::vector<report::Cell> measures_of(const std::string& label,
                                      const planning::PlanningProblem& problem,
                                      const planning::PlanResult& result) {
  const planning::HumanLikeness likeness(problem.model(), problem.joints.hand, *problem.basis,
                                         nullptr);
  const planning::DistanceAlong distance =
      planning::path_likeness(problem.model(), likeness, result.path).to_subspace;
  planning::MotionLikeness motion;
  const auto timed = planning::likeness_trajectory(problem, result.path);
  if (const auto* trajectory = std::get_if<planning::Trajectory>(&timed)) {
    motion = planning::motion_likeness(problem, *trajectory, nullptr);
  }
  return {label,
          result.path.waypoints.size(),
          report::fixed(distance.mean, 4),
          report::fixed(distance.largest, 4),
          report::fixed(motion.hand ? motion.hand->spectral_arc_length : kNone, 2),
          report::fixed(motion.deviation ? motion.deviation->arm : kNone, 4)};
}

report::Table table_of_measures() {
  return {{"Path",
           "nodes",
           {"mean distance of the hand from SC_h", "normalised joints"},
           {"largest", "normalised joints"},
           "smoothness of the hand (SPARC)",
           {"deviation of the arm from the straight motion", "normalised joints"}}};
}

// Plans each row and adds its film strip and its measures.
void add_planned(Film& film, const std::vector<Row>& rows) {
  film.made().table = table_of_measures();
  for (const Row& row : rows) {
    const planning::PlanningProblem problem = film.problem(row);
    if (const auto result = film.plan(row, problem)) {
      film.add(row, fmt::format("{}_{}", row.scene, row.planner), result->path, problem, row.label);
      film.made().table->rows.push_back(measures_of(row.label, problem, *result));
    }
  }
}

Eigen::Vector3d palm_at(const planning::PlanningProblem& problem,
                        const planning::Configuration& q) {
  const geometric::RobotInstance& robot = problem.scene->robots.front();
  geometric::RobotState state(robot.model);
  state.set_configuration(q);
  const int palm =
      geometric::HandStructure::of(*robot.model, problem.joints.arm, problem.joints.hand).palm;
  return state.link_pose(palm).translation();
}

// The virtual and the emulated run at equal points of the motion.
void add_side_by_side(Film& film, const Row& row) {
  constexpr int kPoints = 6;
  constexpr double kSpeed = 0.5;
  constexpr double kPeriod = 0.02;  // s
  const planning::PlanningProblem problem = film.problem(row);
  const auto result = film.plan(row, problem);
  if (!result) {
    return;
  }
  planning::TimingOptions timing;
  timing.speed = kSpeed;
  timing.period = kPeriod;
  const planning::TimedPath timed = planning::time_path(problem, result->path, "figure_15", timing);
  if (!timed.cleared()) {
    film.made().problem += "The path can't be timed. ";
    return;
  }
  EmulatedRun run;
  try {
    run = run_on_emulators(problem, timed.motion, kPoints);
  } catch (const device::DeviceError& error) {
    run.fault = error.what();
  }
  film.made().text = fmt::format(
      "{} Scene {}; the motion takes {:.2f} s at {:.0f} % of full speed. An emulated arm (VAL3 "
      "server) and an emulated hand ran it in real time; no real robot was there.",
      planned_by(row.planner), row.scene, timed.motion.trajectory.duration(), 100.0 * kSpeed);
  film.made().problem += run.fault;
  report::Table table{
      {{"Time", "s"}, {"largest difference of a joint", "°"}, {"distance of the palm", "mm"}}};
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    table.rows.push_back(
        {report::fixed(run.times[i], 2),
         report::fixed(
             (run.measured[i] - run.planned[i]).cwiseAbs().maxCoeff() / geometric::kDegree, 2),
         report::fixed(
             (palm_at(problem, run.measured[i]) - palm_at(problem, run.planned[i])).norm() /
                 geometric::kMillimetre,
             2)});
  }
  film.made().table = std::move(table);
  if (!run.times.empty()) {
    film.add(row, "planned", {run.planned}, problem, "Simulated");
    film.add(row, "measured", {run.measured}, problem, "Measured on emulated devices");
  }
}

/// Measures of how hard a problem is.
class Difficulty {
 public:
  explicit Difficulty(const planning::PlanningProblem& problem)
      : problem_(problem),
        region_(problem, planning::HandSpace::kPrincipalDirections, planning::CorridorForm::kJoint),
        checker_(problem.checker->clone()) {}

  [[nodiscard]] std::vector<report::Cell> row(const std::string& label) const {
    return {label,
            report::fixed(clearance_at_goal() / geometric::kMillimetre, 1),
            report::percent(blocked()),
            report::percent(free_hands(0.5)),
            report::percent(free_hands(0.75)),
            report::percent(free_hands(1.0))};
  }

  [[nodiscard]] static report::Table table() {
    return {{"Problem",
             {"clearance from objects at the goal", "mm"},
             {"straight motion in collision"},
             {"free hand samples at 50 % of the motion"},
             {"at 75 %"},
             {"at 100 %"}}};
  }

 private:
  static constexpr int kSamples = 200;

  [[nodiscard]] double clearance_at_goal() const {
    checker_->place(problem_.goal);
    double least = planning::kFarClearance;
    const auto pairs = checker_->world().pairs();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!checker_->world().is_self_pair(pairs[i])) {
        least = std::min(least, checker_->pair_distance(static_cast<int>(i), least));
      }
    }
    return least;
  }

  // Share of the straight motion from start to goal.
  [[nodiscard]] double blocked() const {
    int count = 0;
    for (int i = 0; i <= kSamples; ++i) {
      const planning::Configuration q =
          problem_.start + static_cast<double>(i) / kSamples * (problem_.goal - problem_.start);
      count += checker_->first_collision(q) ? 1 : 0;
    }
    return static_cast<double>(count) / (kSamples + 1);
  }

  // With the arm on its straight motion, the hand sampled from the thumb base and four PMDs.
  [[nodiscard]] double free_hands(double place) const {
    constexpr int kPmds = 4;
    const int axes = std::min(region_.basis().dimension(),
                              static_cast<int>(region_.basis().free_joints.size()) + kPmds);
    const Eigen::VectorXd centre =
        Eigen::VectorXd::Constant(region_.space().corridor_dimension(), 0.5);
    const auto arm = region_.arm_at(place, 0.0, centre);
    if (!arm) {
      return 0.0;
    }
    sampling::RandomStream draws(kSeed);
    int count = 0;
    for (int i = 0; i < kSamples; ++i) {
      count += checker_->first_collision(region_.with_hand(*arm, draws.uniform(axes))) ? 0 : 1;
    }
    return static_cast<double>(count) / kSamples;
  }

  const planning::PlanningProblem& problem_;
  planning::HandArmRegion region_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
};

// Start and goal of the problems, with the task of Table 2 for comparison.
void add_problems(Film& film) {
  film.made().table = Difficulty::table();
  const Row benchmark{"two_cans_on_table", "", "Table 2: Two cans on a table"};
  film.made().table->rows.push_back(Difficulty(film.problem(benchmark)).row(benchmark.label));
  for (const Row& row : problems()) {
    const planning::PlanningProblem problem = film.problem(row);
    film.add(row, row.scene, {{problem.start, problem.goal}}, problem, row.label);
    film.made().table->rows.push_back(Difficulty(problem).row(row.label));
  }
  film.made().text = fmt::format(
      "Start and goal of the scenes that ship, which are reconstructions. Nothing is planned. "
      "Measured: the straight motion at 201 configurations; 200 hand samples (thumb base and four "
      "PMDs, seed {}) with the arm on its straight motion.",
      kSeed);
}

}  // namespace

const std::set<int>& film_figures() {
  static const std::set<int> kNumbers = {14, 15, 16, 17};
  return kNumbers;
}

std::vector<ReproducedFigure> reproduce_films(const std::set<int>& figures,
                                              const planning::PluginManager& plugins,
                                              double time_limit_s, const fs::path& folder) {
  std::vector<ReproducedFigure> made;
  const auto film = [&](int number, const char* caption) {
    return Film(number, caption, plugins, time_limit_s, folder);
  };
  if (figures.contains(14)) {
    Film strips = film(14,
                       "The hand along a path: planned in all joints of the hand, and with "
                       "principal motion directions");
    strips.made().text = planned_by("full-prm and pmd-prm");
    add_planned(strips, spaces());
    made.push_back(strips.finish("6", "hand"));
  }
  if (figures.contains(15)) {
    Film strips = film(15, "A path in simulation and on emulated devices, at equal times");
    add_side_by_side(strips, spaces().back());
    made.push_back(strips.finish("waypoints", "task"));
  }
  if (figures.contains(16)) {
    Film strips = film(16, "Start and goal of the four problems");
    add_problems(strips);
    made.push_back(strips.finish("waypoints", "task"));
  }
  if (figures.contains(17)) {
    Film strips = film(17, "Paths of the four problems");
    strips.made().text = planned_by("pmd-prm");
    add_planned(strips, problems());
    made.push_back(strips.finish("6", "task"));
  }
  return made;
}

}  // namespace handway::tools
