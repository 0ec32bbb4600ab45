#include "planner_figures.h"

#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/roadmap/roadmap_recorder.h"
#include "handway/planning/spaces/state_space.h"
#include "handway/report/rendering/csv.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/principal_components.h"
#include "handway/sampling/sequences/low_discrepancy.h"
#include "handway/sampling/sequences/random_stream.h"
#include "mapped_recording.h"
#include "posture_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using report::Mark;
using report::Series;

constexpr std::uint64_t kSeed = 1;
constexpr const char* kScene = "two_cans_on_table";
constexpr double kGap = std::numeric_limits<double>::quiet_NaN();  ///< Ends a line.

void add_point(Series& series, double x, double y) {
  series.x.push_back(x);
  series.y.push_back(y);
}

std::string spaced(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// Two joints of recorded postures with a basis of their own, and samples of its first direction.
class BoxFigure {
 public:
  BoxFigure()
      : study_(study_postures(geometric::resource_dir() / "recordings" / "free_hand.csv",
                              Normalisation::kLimits)),
        pair_(joint_indices({"middle_proximal", "ring_proximal"}, study_.basis.joints)),
        postures_(study_.samples.rows(), 2) {
    postures_ << study_.samples.col(pair_[0]), study_.samples.col(pair_[1]);
    components_ = sampling::principal_components(postures_);
    basis_ = sampling::make_pmd_basis(study_.basis.hand, study_.basis.source, {name(0), name(1)},
                                      components_, {{}, 2, kSigmas});
  }

  [[nodiscard]] ReproducedFigure make() const {
    ReproducedFigure made{
        11, "A space of two joints, the box of its first direction, and samples", "", {}, {}, ""};
    const Eigen::MatrixXd samples = drawn_samples();
    made.text = fmt::format(
        "C_h is the space of joints {} and {} in the recording free_hand, {} postures; SC_h is its "
        "first principal direction, B_h the segment of {:g} standard deviations to both sides of "
        "the mean. {} samples by Eq. (1), seed {}: the farthest is {:.1e} of a joint's range away "
        "from the direction.",
        pair_[0], pair_[1], postures_.rows(), kSigmas, samples.rows(), kSeed,
        farthest_from_direction(samples));
    made.drawings.push_back(drawing(samples));
    made.table = report::Table{{"Direction",
                                {"share of the variance", "%"},
                                "half side λ",
                                {"recorded postures within ±λ", "%"}}};
    for (Eigen::Index i = 0; i < 2; ++i) {
      made.table->rows.push_back(
          {fmt::format("ê{}", i + 1), report::fixed(100.0 * components_.shares[i], 2),
           report::fixed(half_side(i), 4), report::fixed(100.0 * share_within(i), 1)});
    }
    return made;
  }

 private:
  static constexpr double kSigmas = 1.5;
  static constexpr int kSamples = 15;

  [[nodiscard]] std::string name(std::size_t axis) const {
    return study_.basis.joints[static_cast<std::size_t>(pair_[axis])];
  }
  [[nodiscard]] double half_side(Eigen::Index i) const {
    return basis_.directions[static_cast<std::size_t>(i)].half_side;
  }

  [[nodiscard]] Eigen::MatrixXd drawn_samples() const {
    sampling::RandomStream draws(kSeed);
    Eigen::MatrixXd samples(kSamples, 2);
    for (Eigen::Index i = 0; i < kSamples; ++i) {
      samples.row(i) = sampling::map_to_posture(basis_, draws.uniform(1)).transpose();
    }
    return samples;
  }

  [[nodiscard]] double farthest_from_direction(const Eigen::MatrixXd& samples) const {
    return ((samples.rowwise() - basis_.mean.transpose()) * components_.directions.col(1))
        .cwiseAbs()
        .maxCoeff();
  }

  [[nodiscard]] double share_within(Eigen::Index i) const {
    const Eigen::VectorXd along =
        (postures_.rowwise() - basis_.mean.transpose()) * components_.directions.col(i);
    return static_cast<double>((along.array().abs() <= half_side(i)).count()) /
           static_cast<double>(along.size());
  }

  [[nodiscard]] Series segment(std::string label, Eigen::Index i) const {
    Series series{std::move(label), Mark::kLine};
    for (const double side : {-1.0, 1.0}) {
      const Eigen::VectorXd end = basis_.mean + side * half_side(i) * components_.directions.col(i);
      add_point(series, end[0], end[1]);
    }
    return series;
  }

  [[nodiscard]] report::Figure drawing(const Eigen::MatrixXd& samples) const {
    constexpr Eigen::Index kMostDots = 500;
    Series recorded{"recorded", Mark::kDots};
    const Eigen::Index count = std::min(kMostDots, postures_.rows());
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Index row = i * postures_.rows() / count;
      add_point(recorded, postures_(row, 0), postures_(row, 1));
    }
    Series drawn{"samples of ê1", Mark::kDots};
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
      add_point(drawn, samples(i, 0), samples(i, 1));
    }
    const auto axis = [&](std::size_t i) {
      return report::Axis{.title = fmt::format("Joint {}, {}", pair_[i], spaced(name(i))),
                          .unit = "normalised"};
    };
    return {"A box in a subspace",
            {report::XyPlot{"",
                            axis(0),
                            axis(1),
                            {std::move(recorded), segment("B_h: ±λ1 along ê1", 0),
                             segment("±λ2 along ê2", 1), std::move(drawn)}}},
            1,
            "figure_11.csv",
            "figure_11.svg"};
  }

  PostureStudy study_;
  std::vector<int> pair_;
  Eigen::MatrixXd postures_;  ///< Shape [samples, 2].
  sampling::PrincipalComponents components_;
  sampling::PmdBasis basis_;
};

planning::PlanningProblem shipped_problem(const planning::PluginManager& plugins) {
  const planning::SceneState scene = planning::load_scene(
      geometric::resource_dir().parent_path() / "scenes" / fmt::format("{}.yaml", kScene), plugins);
  return planning::make_problem(scene.scene, scene.basis);
}

/// Samples of all hypercubes along the arm's segment, each with a hand sample.
class SamplesFigure {
 public:
  explicit SamplesFigure(const planning::PlanningProblem& problem)
      : problem_(problem),
        region_(problem, planning::HandSpace::kPrincipalDirections, planning::CorridorForm::kJoint),
        checker_(problem.checker->clone()),
        steps_(region_.space().steps(kRho)) {
    const auto& arm = problem.joints.arm;
    const Eigen::VectorXd motion = (joints(problem.goal) - joints(problem.start)).cwiseAbs();
    std::vector<int> order(arm.begin(), arm.end());
    std::ranges::stable_sort(order, [&](int a, int b) { return motion[a] > motion[b]; });
    shown_ = {order.at(0), order.at(1)};
    draw_all();
  }

  [[nodiscard]] ReproducedFigure make() {
    ReproducedFigure made{12, "Samples of arm and hand", "", {}, {}, ""};
    const double motion = (arm_joints(problem_.goal) - arm_joints(problem_.start)).norm();
    made.text = fmt::format(
        "Scene {}, seed {}, rho_a = {:g}, thumb base and {} PMD, {} samples in each hypercube. The "
        "arm's motion is {:.4f} long in normalised joints; its {} hypercubes are {:.4f} apart, "
        "which is at most rho_a. They are listed in the order of the sweep. The arm is drawn in "
        "the two joints that move most.",
        kScene, kSeed, kRho, kPmds, kPerHypercube, motion, steps_ + 1, motion / steps_);
    made.drawings.push_back(report::Figure{
        "Samples of arm and hand", {arm_plot(), hand_plot()}, 2, "figure_12.csv", "figure_12.svg"});
    made.table = report::Table{{"Place on the segment", "samples", "free of collisions"}};
    for (const Hypercube& cube : cubes_) {
      made.table->rows.push_back({report::fixed(cube.place, 3), kPerHypercube, cube.free_count});
    }
    return made;
  }

 private:
  static constexpr double kRho = 0.05;
  static constexpr int kPmds = 1;
  static constexpr int kPerHypercube = 8;

  struct Hypercube {
    double place = 0.0;
    int free_count = 0;
  };

  [[nodiscard]] Eigen::VectorXd joints(const planning::Configuration& q) const {
    return geometric::normalised(problem_.model(), q);
  }
  [[nodiscard]] Eigen::VectorXd arm_joints(const planning::Configuration& q) const {
    return joints(q)(problem_.joints.arm);
  }

  void draw_all() {
    sampling::RandomStream draws(kSeed);
    const int axes = static_cast<int>(region_.basis().free_joints.size()) + kPmds;
    for (int i = 0; i <= steps_; ++i) {
      Hypercube cube{sampling::sweep_position(static_cast<std::uint64_t>(i))};
      for (int n = 0; n < kPerHypercube; ++n) {
        const Eigen::VectorXd in_cube = draws.uniform(region_.space().corridor_dimension());
        const Eigen::VectorXd in_box = draws.uniform(axes);
        const auto arm = region_.arm_at(cube.place, kRho, in_cube);
        if (!arm) {
          continue;
        }
        const bool is_free = !checker_->first_collision(region_.with_hand(*arm, in_box));
        cube.free_count += is_free ? 1 : 0;
        const Eigen::VectorXd x = joints(*arm);
        add_point(is_free ? free_arm_ : colliding_arm_, x[shown_[0]], x[shown_[1]]);
        add_point(is_free ? free_hand_ : colliding_hand_, 2.0 * in_box[0] - 1.0,
                  2.0 * in_box[1] - 1.0);
      }
      cubes_.push_back(cube);
    }
  }

  [[nodiscard]] report::XyPlot arm_plot() {
    const Eigen::VectorXd start = joints(problem_.start);
    const Eigen::VectorXd goal = joints(problem_.goal);
    Series segment{.label = "from start to goal", .mark = Mark::kLine, .color = 3};
    for (const Eigen::VectorXd* end : {&start, &goal}) {
      add_point(segment, (*end)[shown_[0]], (*end)[shown_[1]]);
    }
    Series squares{.label = "hypercubes", .mark = Mark::kLine, .color = 2};
    constexpr std::array<std::pair<double, double>, 5> kCorners = {
        {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
    for (const Hypercube& cube : cubes_) {
      const Eigen::VectorXd centre = start + cube.place * (goal - start);
      for (const auto& [x, y] : kCorners) {
        add_point(squares, centre[shown_[0]] + x * kRho, centre[shown_[1]] + y * kRho);
      }
      add_point(squares, kGap, kGap);
    }
    const auto axis = [&](std::size_t i) {
      return report::Axis{.title = spaced(problem_.model().variable(shown_[i]).name),
                          .unit = "normalised"};
    };
    return {
        "Arm",
        axis(0),
        axis(1),
        {std::move(squares), std::move(segment), std::move(free_arm_), std::move(colliding_arm_)}};
  }

  [[nodiscard]] report::XyPlot hand_plot() {
    const auto axis = [](const std::string& name) {
      return report::Axis{.title = name, .unit = "λ", .least = -1.05, .most = 1.05};
    };
    return {"Hand",
            axis("Thumb base"),
            axis("PMD 1"),
            {std::move(free_hand_), std::move(colliding_hand_)}};
  }

  const planning::PlanningProblem& problem_;
  planning::HandArmRegion region_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
  int steps_;
  std::array<int, 2> shown_{};
  std::vector<Hypercube> cubes_;
  Series free_arm_{.label = "free", .mark = Mark::kDots, .color = 0};
  Series colliding_arm_{.label = "in collision", .mark = Mark::kDots, .color = 1};
  Series free_hand_{.label = "free", .mark = Mark::kDots, .color = 0};
  Series colliding_hand_{.label = "in collision", .mark = Mark::kDots, .color = 1};
};

/// Records the roadmap and its search range after each sampled configuration, and stops the search
/// after some of them.
class RangeRecorder final : public planning::RoadmapRecorder {
 public:
  RangeRecorder() : RoadmapRecorder(kMostNodes) {}

  static constexpr std::size_t kMostNodes = 5;  // start, goal and three samples, as in Fig. 13

  void on_search_range(double d_ini, double d_goal) override {
    RoadmapRecorder::on_search_range(d_ini, d_goal);
    if (roadmap().nodes.size() > ranges_.size() + 2) {
      ranges_.emplace_back(d_ini, d_goal);
    }
    if (roadmap().nodes.size() >= kMostNodes) {
      stop_.request_stop();
    }
  }

  [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }
  /// Ranges after the first, second, … sample.
  [[nodiscard]] const std::vector<std::pair<double, double>>& ranges() const { return ranges_; }

 private:
  std::vector<std::pair<double, double>> ranges_;
  std::stop_source stop_;
};

/// Number of the component of each node: 0 with the start, 1 with the goal, 2 for all others.
std::vector<int> components_of(const planning::RecordedRoadmap& roadmap) {
  std::vector<int> component(roadmap.nodes.size(), 2);
  component[0] = 0;
  component[1] = 1;
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [from, to] : roadmap.edges) {
      int& a = component[static_cast<std::size_t>(from)];
      int& b = component[static_cast<std::size_t>(to)];
      grows = grows || a != b;
      a = b = std::min(a, b);
    }
  }
  return component;
}

report::XyPlot range_plot(const planning::PlanningProblem& problem,
                          const planning::RecordedRoadmap& roadmap) {
  constexpr std::array<const char*, 3> kLabels = {"connected to the start", "connected to the goal",
                                                  "neither"};
  const std::vector<int> component = components_of(roadmap);
  const Eigen::VectorXd start = geometric::normalised(problem.model(), problem.start);
  const Eigen::VectorXd motion =
      (geometric::normalised(problem.model(), problem.goal) - start)(problem.joints.hand);
  // Place across: how far the hand is along its own straight motion.
  const auto across = [&](const planning::RecordedRoadmap::Node& node) {
    const Eigen::VectorXd joints =
        (geometric::normalised(problem.model(), node.q) - start)(problem.joints.hand);
    return joints.dot(motion) / motion.squaredNorm();
  };
  std::vector<Series> series;
  for (int c = 0; c < 3; ++c) {
    if (std::ranges::count(component, c) == 0) {
      continue;
    }
    Series edges{"", Mark::kLine};
    Series nodes{kLabels[static_cast<std::size_t>(c)], Mark::kDots};
    edges.color = nodes.color = c;
    for (std::size_t i = 0; i < roadmap.nodes.size(); ++i) {
      if (component[i] == c) {
        add_point(nodes, roadmap.nodes[i].step, across(roadmap.nodes[i]));
        nodes.notes.push_back(i == 0 ? "c_ini" : i == 1 ? "c_goal" : fmt::format("s{}", i - 1));
      }
    }
    for (const auto& [from, to] : roadmap.edges) {
      if (component[static_cast<std::size_t>(from)] == c) {
        for (const int end : {from, to}) {
          const auto& node = roadmap.nodes[static_cast<std::size_t>(end)];
          add_point(edges, node.step, across(node));
        }
        add_point(edges, kGap, kGap);
      }
    }
    series.push_back(std::move(edges));
    series.push_back(std::move(nodes));
  }
  constexpr double kBelow = -0.1;
  series.push_back({.label = "search range",
                    .mark = Mark::kPoints,
                    .x = {roadmap.search_range.first, roadmap.search_range.second},
                    .y = {kBelow, kBelow},
                    .color = 3});
  return {"",
          {.title = "Place of the hypercube on the arm's segment", .least = -0.05, .most = 1.05},
          {.title = "Hand on its straight motion"},
          std::move(series)};
}

// The first seed after whose third sample the range is that of the print's example.
ReproducedFigure range_figure(const planning::PlanningProblem& problem,
                              const planning::PluginManager& plugins) {
  constexpr std::uint64_t kMostSeeds = 50;
  constexpr std::pair<double, double> kPrinted{0.5, 1.0};
  ReproducedFigure made{13, "The search range of a roadmap under construction", "", {}, {}, ""};
  for (std::uint64_t seed = kSeed; seed <= kMostSeeds; ++seed) {
    const auto planner = plugins.planners().create("pmd-prm");
    planner->set_parameter(planning::kPresetKey, "print");
    RangeRecorder recorder;
    static_cast<void>(
        planner->plan(problem, {.seed = seed, .time_limit_s = 10.0}, recorder.token(), &recorder));
    if (recorder.ranges().size() < 3 || recorder.ranges()[2] != kPrinted) {
      continue;
    }
    const std::vector<int> component = components_of(recorder.roadmap());
    made.text = fmt::format(
        "Scene {}, planner pmd-prm, preset=print, seed {}: the first of the seeds from {} on whose "
        "roadmap has, after three samples, the range [{:g}, {:g}] of the print's example.",
        kScene, seed, kSeed, kPrinted.first, kPrinted.second);
    made.table = report::Table{{"Sample", "place", "connected to", "d_ini", "d_goal"}};
    for (std::size_t i = 0; i < 3; ++i) {
      const int c = component[i + 2];
      made.table->rows.push_back({fmt::format("s{}", i + 1),
                                  report::fixed(recorder.roadmap().nodes[i + 2].step, 1),
                                  c == 0   ? "start"
                                  : c == 1 ? "goal"
                                           : "neither",
                                  report::fixed(recorder.ranges()[i].first, 1),
                                  report::fixed(recorder.ranges()[i].second, 1)});
    }
    made.drawings.push_back(report::Figure{"A roadmap after three samples",
                                           {range_plot(problem, recorder.roadmap())},
                                           1,
                                           "figure_13.csv",
                                           "figure_13.svg"});
    return made;
  }
  made.problem = fmt::format("None of {} seeds has the range of the print's example.", kMostSeeds);
  return made;
}

}  // namespace

const std::set<int>& planner_figures() {
  static const std::set<int> kNumbers = {11, 12, 13};
  return kNumbers;
}

std::vector<ReproducedFigure> reproduce_planner_figures(const std::set<int>& figures,
                                                        const planning::PluginManager& plugins,
                                                        const fs::path& folder) {
  std::vector<ReproducedFigure> made;
  if (figures.contains(11)) {
    made.push_back(BoxFigure().make());
  }
  if (figures.contains(12) || figures.contains(13)) {
    const planning::PlanningProblem problem = shipped_problem(plugins);
    if (figures.contains(12)) {
      made.push_back(SamplesFigure(problem).make());
    }
    if (figures.contains(13)) {
      made.push_back(range_figure(problem, plugins));
    }
  }
  for (const ReproducedFigure& figure : made) {
    if (figure.table) {
      geometric::replace_file(folder / fmt::format("figure_{}.csv", figure.number),
                              report::to_csv(*figure.table));
    }
  }
  return made;
}

}  // namespace handway::tools
