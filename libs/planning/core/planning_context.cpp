#include "handway/planning/core/planning_context.h"

#include "core/thread_pool.h"

#include <algorithm>
#include <utility>

namespace handway::planning {

PlanningContext::PlanningContext(const PlanningProblem& problem, const PlanRequest& request,
                                 std::stop_token stop, Observer& observer)
    : problem_(problem),
      request_(request),
      stop_(std::move(stop)),
      observer_(observer),
      begin_(std::chrono::steady_clock::now()),
      threads_(std::make_unique<ThreadPool>(request.threads)),
      validator_(std::make_unique<MotionValidator>(problem_, request_, statistics_, *threads_,
                                                   [this] { return interruption().has_value(); })) {
}

PlanningContext::~PlanningContext() = default;

double PlanningContext::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

std::optional<PlanStatus> PlanningContext::interruption() const {
  if (stop_.stop_requested()) {
    return PlanStatus::kCancelled;
  }
  if (parent_) {
    return parent_->interruption();
  }
  if (elapsed_s() > request_.time_limit_s) {
    return PlanStatus::kTimeLimit;
  }
  return std::nullopt;
}

std::unique_ptr<sampling::Sampler> PlanningContext::make_sampler(
    int dimension, std::uint64_t seed, sampling::ValidityPredicate valid) const {
  return sampling::make_sampler(sampler_, dimension, seed, std::move(valid));
}

std::unique_ptr<PlanningContext> PlanningContext::make_child(const PlanningProblem& problem,
                                                             Observer& observer,
                                                             std::stop_token stop) const {
  PlanRequest request = request_;
  request.threads = 1;
  auto child = std::make_unique<PlanningContext>(problem, request, std::move(stop), observer);
  child->parent_ = this;
  child->begin_ = begin_;
  child->sampler_ = sampler_;
  return child;
}

void PlanningContext::run_on_threads(int count, const std::function<void(int)>& work) {
  threads_->run(0, count, work);
}

void PlanningContext::count_rejection(int pair, double step) {
  statistics_.rejections_per_pair.resize(
      static_cast<std::size_t>(problem_.checker->world().check_count()));
  ++statistics_.rejections_per_pair[static_cast<std::size_t>(pair)];
  statistics_.rejections_per_tenth.resize(10);
  ++statistics_.rejections_per_tenth[static_cast<std::size_t>(std::clamp(step, 0.0, 0.99) * 10)];
}

}  // namespace handway::planning
