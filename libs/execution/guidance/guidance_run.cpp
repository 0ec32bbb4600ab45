#include "handway/execution/guidance/guidance_run.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace handway::execution {
namespace {

// Largest motion from one point of the curve to the next, norm over all joints, rad or m.
constexpr double kStep = 0.01;
// Displacement of a link below which it is at rest, because of rounding, m.
constexpr double kStands = 1e-6;

[[noreturn]] void refuse(std::string found, std::string expected) {
  throw geometric::InputError({"path", "", std::move(found), std::move(expected), ""});
}

}  // namespace

PathToolCurve::PathToolCurve(const std::shared_ptr<const geometric::RobotModel>& model,
                             planning::Path path, const std::string& link)
    : path_(std::move(path)) {
  if (path_.empty()) {
    refuse("no waypoints", "at least one");
  }
  const auto index = model->find_link(link);
  if (!index) {
    refuse(fmt::format("link \"{}\"", link), "a link of robot " + model->name());
  }
  geometric::RobotState robot(model);
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](double place) {
    robot.set_configuration(configuration(place));
    const Eigen::Vector3d p = robot.link_pose(*index).translation();
    const bool stands = !points.empty() && (p - points.back()).norm() < kStands;
    points.push_back(stands ? points.back() : p);
    places_.push_back(place);
  };
  for (std::size_t i = 0; i + 1 < path_.waypoints.size(); ++i) {
    const double distance = (path_.waypoints[i + 1] - path_.waypoints[i]).norm();
    const int steps = std::max(1, static_cast<int>(std::ceil(distance / kStep)));
    for (int k = 0; k < steps; ++k) {
      add(static_cast<double>(i) + static_cast<double>(k) / steps);
    }
  }
  add(static_cast<double>(path_.waypoints.size() - 1));
  curve_ = std::make_shared<device::ToolCurve>(std::move(points));
}

double PathToolCurve::place_at(double s) const {
  const std::vector<double>& arc = curve_->arc_lengths();
  const auto after = std::ranges::upper_bound(arc, s);
  if (after == arc.end()) {
    return places_.back();
  }
  if (after == arc.begin()) {
    return places_.front();
  }
  const auto i = static_cast<std::size_t>(after - arc.begin());
  const double share = (s - arc[i - 1]) / (arc[i] - arc[i - 1]);
  return places_[i - 1] + share * (places_[i] - places_[i - 1]);
}

double PathToolCurve::arc_length_at(double place) const {
  const std::vector<double>& arc = curve_->arc_lengths();
  const auto after = std::ranges::upper_bound(places_, place);
  if (after == places_.end()) {
    return arc.back();
  }
  if (after == places_.begin()) {
    return arc.front();
  }
  const auto i = static_cast<std::size_t>(after - places_.begin());
  const double share = (place - places_[i - 1]) / (places_[i] - places_[i - 1]);
  return arc[i - 1] + share * (arc[i] - arc[i - 1]);
}

geometric::Configuration PathToolCurve::configuration(double place) const {
  const auto last = static_cast<double>(path_.waypoints.size() - 1);
  const double clamped = std::clamp(place, 0.0, last);
  const auto i = static_cast<std::size_t>(std::min(clamped, std::max(0.0, last - 1.0)));
  if (path_.waypoints.size() == 1) {
    return path_.waypoints.front();
  }
  const double share = clamped - static_cast<double>(i);
  return path_.waypoints[i] + share * (path_.waypoints[i + 1] - path_.waypoints[i]);
}

std::string tool_link(const geometric::RobotModel& model, const std::vector<int>& arm) {
  return arm.empty() ? model.link(model.link_count() - 1).name
                     : model.link(model.variable_link(*std::ranges::max_element(arm))).name;
}

GuidedMotion::GuidedMotion(planning::Path path, Eigen::VectorXd velocity)
    : path_(std::move(path)), velocity_(std::move(velocity)) {
  if (path_.empty() || !(velocity_.array() > 0.0).all()) {
    throw std::invalid_argument("a guided motion needs a path, and velocities above 0");
  }
  for (std::size_t i = 0; i < path_.waypoints.size(); ++i) {
    if (path_.waypoints[i].size() != velocity_.size()) {
      throw std::invalid_argument("a waypoint of another size than the velocities");
    }
    if (i > 0) {
      durations_.push_back((path_.waypoints[i] - path_.waypoints[i - 1])
                               .cwiseAbs()
                               .cwiseQuotient(velocity_)
                               .maxCoeff());
    }
  }
}

double GuidedMotion::advance(double target, double dt) {
  const double goal = std::clamp(target, 0.0, static_cast<double>(durations_.size()));
  const bool forwards = goal > place_;
  while (dt > 0.0 && place_ != goal) {
    const double next = forwards ? std::min(goal, std::floor(place_) + 1.0)
                                 : std::max(goal, std::ceil(place_) - 1.0);
    const double edge = forwards ? std::floor(place_) : std::ceil(place_) - 1.0;
    const double duration = durations_[static_cast<std::size_t>(edge)];
    const double needed = std::abs(next - place_) * duration;
    if (needed > dt) {
      place_ += (forwards ? dt : -dt) / duration;
      return place_;
    }
    place_ = next;
    dt -= needed;
  }
  return place_;
}

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kWait{20};
constexpr double kLeadPeriod = 0.05;  // s

}  // namespace

GuidanceOutcome run_guidance(device::HapticDevice& device, device::ForceGuide& guide,
                             const PathToolCurve& curve, GuidedMotion& motion,
                             const std::stop_token& stop, const GuidanceListeners& listeners) {
  GuidanceOutcome outcome;
  const auto begin = Clock::now();
  double led = -kLeadPeriod;
  try {
    while (!stop.stop_requested() && !outcome.arrived) {
      const auto handle = device.read(kWait);
      const double now = std::chrono::duration<double>(Clock::now() - begin).count();
      if (handle) {
        GuidanceSample sample{now, *handle, {}, 0.0, {}};
        sample.step = guide.update(*handle, curve.arc_length_at(motion.place()));
        device.apply(sample.step.force);
        if (sample.step.engaged) {
          const double target =
              sample.step.arrived ? curve.last_place() : curve.place_at(sample.step.progress);
          motion.advance(target, now - outcome.time);
        }
        outcome.arrived = motion.place() >= curve.last_place();
        sample.place = motion.place();
        sample.q = curve.configuration(sample.place);
        outcome.time = now;
        ++outcome.samples;
        outcome.largest_deviation = std::max(outcome.largest_deviation, sample.step.deviation);
        outcome.strongest = std::max(outcome.strongest, sample.step.force.norm());
        listeners.on_sample(sample);
      }
      if (now - led >= kLeadPeriod || outcome.arrived) {
        led = now;
        listeners.lead(curve.configuration(motion.place()));
      }
    }
  } catch (const std::exception& error) {
    outcome.fault = error.what();
    outcome.arrived = false;
  } catch (...) {
    outcome.fault = "An unknown exception.";
    outcome.arrived = false;
  }
  device.release();
  return outcome;
}

}  // namespace handway::execution
