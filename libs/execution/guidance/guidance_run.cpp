#include "handway/execution/guidance/guidance_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace handway::execution {

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
                             const PathToolCurve& way, GuidedMotion& motion,
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
        sample.step = guide.update(*handle, way.arc_length_at(motion.place()));
        device.apply(sample.step.force);
        if (sample.step.engaged) {
          const double target =
              sample.step.arrived ? way.last_place() : way.place_at(sample.step.progress);
          motion.advance(target, now - outcome.time);
        }
        outcome.arrived = motion.place() >= way.last_place();
        sample.place = motion.place();
        sample.q = way.configuration(sample.place);
        outcome.time = now;
        ++outcome.samples;
        outcome.largest_deviation = std::max(outcome.largest_deviation, sample.step.deviation);
        outcome.strongest = std::max(outcome.strongest, sample.step.force.norm());
        listeners.on_sample(sample);
      }
      if (now - led >= kLeadPeriod || outcome.arrived) {
        led = now;
        listeners.lead(way.configuration(motion.place()));
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
