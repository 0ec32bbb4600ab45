#include "app/freed_memory.h"

#include "features/workbench.h"
#include "model/jobs/background.h"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <thread>

namespace handway::gui {
namespace {

// After the last work, and between one return and the next: workers, plots and the fine picture
// free what they held some time after they are done.
constexpr std::array<int, 3> kPausesMs = {1000, 2000, 8000};
constexpr int kBlockOfItsOwn = 1 << 19;  // bytes; larger ones go back as soon as they are freed

}  // namespace

FreedMemory::FreedMemory(Workbench& workbench) : QObject(&workbench), workbench_(workbench) {
  mallopt(M_MMAP_THRESHOLD, kBlockOfItsOwn);  // else it grows with the largest block so far
  // One arena for each core, instead of eight: each keeps pages that only a part is used of.
  mallopt(M_ARENA_MAX, static_cast<int>(std::max(2U, std::thread::hardware_concurrency())));
  pause_.setSingleShot(true);
  connect(&pause_, &QTimer::timeout, this, &FreedMemory::give_back_when_idle);
  const auto wait = [this] { wait_for_idleness(); };
  connect(&workbench.document, &Document::opened, this, wait);
  connect(&workbench.document, &Document::edited, this, wait);
  connect(&workbench.session, &PlanningSession::ended, this, wait);
}

void FreedMemory::wait_for_idleness() {
  returns_ = 0;
  pause_.start(kPausesMs.front());
}

void FreedMemory::give_back_when_idle() {
  if (workbench_.is_busy()) {
    wait_for_idleness();
    return;
  }
  run_in_background([] { malloc_trim(0); });
  if (++returns_ < kPausesMs.size()) {
    pause_.start(kPausesMs[returns_]);
  }
}

}  // namespace handway::gui
