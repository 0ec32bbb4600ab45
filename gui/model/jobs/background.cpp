#include "model/jobs/background.h"

#include <QRunnable>
#include <QThreadPool>

#include <utility>

namespace handway::gui {
namespace {

class Task : public QRunnable {
 public:
  explicit Task(std::function<void()> work) : work_(std::move(work)) {}
  void run() override { work_(); }

 private:
  std::function<void()> work_;
};

}  // namespace

void run_in_background(std::function<void()> work) {
  QThreadPool::globalInstance()->start(new Task(std::move(work)));
}

}  // namespace handway::gui
