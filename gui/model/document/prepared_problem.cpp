#include "model/document/prepared_problem.h"

#include "handway/geometric/collision/volumes/preparation.h"

#include <chrono>
#include <utility>

namespace handway::gui {

PreparationQueue::PreparationQueue() : thread_([this](const std::stop_token& end) { work(end); }) {}

PreparationQueue::~PreparationQueue() {
  thread_.request_stop();
  const std::lock_guard lock(mutex_);
  running_.request_stop();
  for (Job& job : waiting_) {
    job.wanted.request_stop();
  }
}

void PreparationQueue::run(std::stop_source wanted, std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(waiting_, [](const Job& other) { return other.wanted.stop_requested(); });
    waiting_.push_back({std::move(wanted), std::move(job)});
  }
  wake_.notify_one();
}

void PreparationQueue::work(const std::stop_token& end) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, end, [this] { return !waiting_.empty(); }) && !end.stop_requested()) {
    Job job = std::move(waiting_.back());
    waiting_.pop_back();
    if (job.wanted.stop_requested()) {
      continue;
    }
    running_ = job.wanted;
    lock.unlock();
    job.work();
    job.work = nullptr;  // what it holds may take long to release
    lock.lock();
  }
}

namespace {

constexpr std::chrono::milliseconds kLookEvery(20);

// With a start and a goal, unless poses give it.
std::shared_ptr<const geometric::Scene> with_query(std::shared_ptr<const geometric::Scene> scene) {
  const bool has_goal = scene->goal || !scene->goal_poses.empty();
  if ((scene->start && has_goal) || scene->robots.empty()) {
    return scene;
  }
  auto complete = std::make_shared<geometric::Scene>(*scene);
  const geometric::Configuration& here = complete->robots.front().configuration;
  complete->start = scene->start.value_or(here);
  if (!has_goal) {
    complete->goal = here;
  }
  return complete;
}

}  // namespace

PreparedProblem::PreparedProblem(planning::SceneState loaded, const planning::Revision& revision,
                                 PreparationQueue& queue, const PreparedProblem* before)
    : revision_(revision) {
  if (before) {
    known_ = before->if_ready();
    known_ = known_ ? known_ : before->known_;
  }
  auto promise = std::make_shared<std::promise<Problem>>();
  problem_ = promise->get_future().share();
  // Results of an edit are likely to be edited again, and not worth the room on the disk.
  const geometric::Preparation preparation{wanted_.get_token(), before == nullptr};
  queue.run(wanted_, [promise = std::move(promise), loaded = std::move(loaded), known = known_,
                      preparation] {
    try {
      const planning::SceneState complete{with_query(loaded.scene), loaded.basis};
      promise->set_value(std::make_shared<const planning::PlanningProblem>(
          known ? planning::updated_problem(*known, complete.scene, complete.basis, preparation)
                : planning::make_problem(complete.scene, complete.basis, preparation)));
    } catch (...) {
      promise->set_exception(std::current_exception());
    }
  });
}

PreparedProblem::~PreparedProblem() { wanted_.request_stop(); }

PreparedProblem::Problem PreparedProblem::wait(const std::stop_token& stop) const {
  while (problem_.wait_for(kLookEvery) != std::future_status::ready) {
    if (stop.stop_requested() || wanted_.stop_requested()) {
      return nullptr;
    }
  }
  return if_ended();
}

PreparedProblem::Problem PreparedProblem::if_ended() const {
  try {
    return problem_.get();
  } catch (const geometric::PreparationStopped&) {
    return nullptr;
  } catch (const std::future_error&) {  // never begun
    return nullptr;
  }
}

PreparedProblem::Problem PreparedProblem::if_ready() const {
  if (problem_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return nullptr;
  }
  try {
    return if_ended();
  } catch (const std::exception&) {  // thrown at those who wait for it
    return nullptr;
  }
}

geometric::CollisionChecker* OwnChecker::wait(const std::stop_token& stop) {
  if (!checker_) {
    if (const PreparedProblem::Problem ready = problem_->wait(stop)) {
      checker_ = ready->checker->clone();
    }
  }
  return checker_.get();
}

}  // namespace handway::gui
