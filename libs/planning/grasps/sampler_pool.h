#pragma once

#include "core/thread_pool.h"
#include "grasps/grasp_sampler.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <stop_token>
#include <utility>
#include <vector>

namespace handway::planning {

/// A sampler for each thread of a search.
class SamplerPool {
 public:
  SamplerPool(const PlanningProblem& problem, const geometric::SceneObject& object,
              const PregraspOptions& options, std::stop_token stop)
      : stop_(std::move(stop)), threads_(std::max(options.threads, 1)) {
    samplers_.reserve(static_cast<std::size_t>(threads_.size()));
    for (int thread = 0; thread < threads_.size(); ++thread) {
      samplers_.push_back(std::make_unique<GraspSampler>(problem, object, options, stop_));
    }
  }

  [[nodiscard]] const GraspSampler& front() const { return *samplers_.front(); }

  /// Calls `work(sampler, i)` for each i from 0 to count - 1, in any order on all threads, with the
  /// sampler of the thread; none is begun after a stop was requested.
  template <typename Work>
  void run(std::size_t count, const Work& work) {
    std::atomic<std::size_t> next = 0;
    threads_.run(0, threads_.size(), [&](int thread) {
      GraspSampler& sampler = *samplers_[static_cast<std::size_t>(thread)];
      for (std::size_t i = next++; i < count && !stop_.stop_requested(); i = next++) {
        work(sampler, i);
      }
    });
  }

 private:
  std::stop_token stop_;
  ThreadPool threads_;
  std::vector<std::unique_ptr<GraspSampler>> samplers_;
};

}  // namespace handway::planning
