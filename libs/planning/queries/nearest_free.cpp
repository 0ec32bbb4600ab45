#include "handway/planning/queries/nearest_free.h"

#include "handway/geometric/io/plural.h"
#include "handway/planning/core/motion_validator.h"
#include "handway/sampling/sequences/random_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

constexpr double kFirstShell = geometric::radians(0.1);
constexpr double kGrowth = 4.0 / 3.0;
constexpr int kDirections = 60;  // directions of each group of variables, per shell
constexpr int kSteps = 400;      // random ones, drawing back
constexpr double kPrecision = geometric::radians(0.01);

class NearestFreeSearch {
 public:
  NearestFreeSearch(const PlanningProblem& problem, Configuration from,
                    const NearestFreeOptions& options, double clearance, int checks_so_far,
                    const std::stop_token& stop)
      : model_(problem.model()),
        checker_(problem.checker->clone()),
        moving_(problem.joints.moving),
        from_(std::move(from)),
        options_(options),
        clearance_(clearance),
        stop_(stop),
        random_(options.seed),
        checks_(checks_so_far) {
    for (const std::vector<int>& group :
         {problem.joints.hand, problem.joints.arm, problem.joints.moving}) {
      if (!group.empty()) {
        groups_.push_back(group);
      }
    }
  }

  void run() {
    const Configuration inside = clamped(from_);
    if (is_free(inside)) {
      best_ = inside;
      return;
    }
    for (double radius = kFirstShell; !best_ && radius < kGrowth * options_.most_distance;
         radius *= kGrowth) {
      look_on_shell(std::min(radius, options_.most_distance));
    }
    if (best_) {
      draw_back();
    }
  }

  [[nodiscard]] NearestFree result() const {
    return {best_, best_ ? distance(*best_) : 0.0, checks_};
  }

 private:
  /// Clamps the moving variables to their limits.
  [[nodiscard]] Configuration clamped(const Configuration& q) const {
    const Configuration inside = model_.clamped(q);
    Configuration clamped = q;
    for (const int v : moving_) {
      clamped[v] = inside[v];
    }
    return clamped;
  }
  [[nodiscard]] double distance(const Configuration& q) const { return (q - from_).norm(); }
  [[nodiscard]] bool is_spent() const {
    return checks_ >= options_.most_checks || stop_.stop_requested();
  }

  bool is_free(const Configuration& q) {
    if (is_spent()) {
      return false;
    }
    ++checks_;
    if (const auto pair = checker_->first_collision(q, last_pair_)) {
      last_pair_ = *pair;
      return false;
    }
    return keeps_end_clearance(*checker_, q, clearance_);
  }

  /// Takes `q`, clamped to limits, if it is free and nearer than the result so far.
  bool offer(const Configuration& q) {
    Configuration candidate = clamped(q);
    if ((best_ && distance(candidate) >= distance(*best_) - 1e-12) || !is_free(candidate)) {
      return false;
    }
    best_ = std::move(candidate);
    return true;
  }

  void look_on_shell(double radius) {
    for (const int v : moving_) {
      for (const double step : {radius, -radius}) {
        Configuration q = from_;
        q[v] += step;
        offer_and_shorten(q);
      }
    }
    for (int i = 0; i < kDirections; ++i) {
      for (const std::vector<int>& group : groups_) {
        Configuration q = from_;
        const Eigen::VectorXd direction = random_.normal(static_cast<int>(group.size()));
        q(group) += radius * direction.normalized();
        offer_and_shorten(q);
      }
    }
  }

  void offer_and_shorten(const Configuration& q) {
    if (offer(q)) {
      shorten();
    }
  }

  /// Draws back along the straight line to the search's centre.
  void shorten() {
    const Configuration base = clamped(from_);
    const Eigen::VectorXd direction = *best_ - base;
    const double length = direction.norm();
    double blocked = 0.0;
    double free = 1.0;
    while ((free - blocked) * length > kPrecision && !is_spent()) {
      const double middle = 0.5 * (blocked + free);
      Configuration q = base + middle * direction;
      if (is_free(q)) {
        free = middle;
        best_ = std::move(q);
      } else {
        blocked = middle;
      }
    }
  }

  void draw_back() {
    for (const int v : moving_) {
      Configuration q = *best_;
      q[v] = from_[v];
      offer_and_shorten(q);
    }
    for (int i = 0; i < kSteps && !is_spent(); ++i) {
      const std::vector<int>& group = groups_[static_cast<std::size_t>(i) % groups_.size()];
      const double length = distance(*best_);
      Eigen::VectorXd direction = *best_ - from_;
      direction(group) +=
          0.5 * length * random_.normal(static_cast<int>(group.size())).normalized();
      offer_and_shorten(from_ + 0.97 * length * direction.normalized());
    }
  }

  const geometric::RobotModel& model_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
  std::vector<int> moving_;
  Configuration from_;
  NearestFreeOptions options_;
  double clearance_;
  const std::stop_token& stop_;
  sampling::RandomStream random_;
  std::vector<std::vector<int>> groups_;
  std::optional<Configuration> best_;
  int checks_ = 0;
  int last_pair_ = 0;
};

}  // namespace

NearestFree find_nearest_free(const PlanningProblem& problem, const Configuration& q,
                              const NearestFreeOptions& options, const std::stop_token& stop) {
  const auto search = [&](double clearance, int most_checks, int checks_so_far) {
    NearestFreeOptions part = options;
    part.most_checks = most_checks;
    NearestFreeSearch looking(problem, q, part, clearance, checks_so_far, stop);
    looking.run();
    return looking.result();
  };
  if (options.clearance <= kLeastEndClearance) {
    return search(kLeastEndClearance, options.most_checks, 0);
  }
  const NearestFree found = search(options.clearance, options.most_checks / 2, 0);
  return found.q ? found : search(kLeastEndClearance, options.most_checks, found.checks);
}

std::string describe_change(const geometric::RobotModel& model, const Configuration& from,
                            const Configuration& to, int most) {
  constexpr double kNoChange = 1e-6;  // rad or m
  std::vector<int> moved;
  for (int v = 0; v < model.variable_count(); ++v) {
    if (std::abs(to[v] - from[v]) > kNoChange) {
      moved.push_back(v);
    }
  }
  std::ranges::stable_sort(moved, std::greater(), [&](int v) { return std::abs(to[v] - from[v]); });
  std::string text;
  const std::size_t named = std::min(moved.size(), static_cast<std::size_t>(most));
  for (std::size_t i = 0; i < named; ++i) {
    const int v = moved[i];
    const double change = to[v] - from[v];
    const bool turns = model.variable(v).type == geometric::JointType::kRevolute;
    const double shown = turns ? geometric::degrees(change) : geometric::millimetres(change);
    text += fmt::format(
        "{}{} {}{}", i == 0 ? "" : ", ", model.variable(v).name,
        std::abs(shown) < 0.1 ? fmt::format("{:+.1g}", shown) : fmt::format("{:+.1f}", shown),
        turns ? "°" : " mm");
  }
  if (const std::size_t others = moved.size() - named; others > 0) {
    text += ", " + geometric::plural(others, "more joint");
  }
  return text.empty() ? "nothing" : text;
}

}  // namespace handway::planning
