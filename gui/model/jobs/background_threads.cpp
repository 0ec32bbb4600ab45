#include "model/jobs/background_threads.h"

#include <chrono>
#include <utility>

namespace handway::gui {

void BackgroundThreads::run(std::function<void()> job) {
  std::erase_if(running_, [](const Running& running) {
    return running.done.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  std::packaged_task<void()> task(std::move(job));
  std::future<void> done = task.get_future();
  running_.push_back({std::move(done), std::jthread(std::move(task))});
}

}  // namespace handway::gui
