#include "handway/execution/guidance/guidance_run.h"

#include <algorithm>
#include <chrono>
#include <exception>

namespace handway::execution {
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
