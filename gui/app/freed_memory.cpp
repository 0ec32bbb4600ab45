#include "app/freed_memory.h"

#include "features/workbench.h"
#include "model/jobs/background.h"

#include <malloc.h>

namespace handway::gui {
namespace {

constexpr int kPauseMs = 1000;           // after the last work
constexpr int kBlockOfItsOwn = 1 << 19;  // bytes; larger ones go back as soon as they are freed

}  // namespace

FreedMemory::FreedMemory(Workbench& workbench) : QObject(&workbench), workbench_(workbench) {
  mallopt(M_MMAP_THRESHOLD, kBlockOfItsOwn);  // else it grows with the largest block so far
  pause_.setSingleShot(true);
  pause_.setInterval(kPauseMs);
  connect(&pause_, &QTimer::timeout, this, &FreedMemory::give_back_when_idle);
  const auto wait = [this] { pause_.start(); };
  connect(&workbench.document, &Document::opened, this, wait);
  connect(&workbench.document, &Document::edited, this, wait);
  connect(&workbench.session, &PlanningSession::ended, this, wait);
}

void FreedMemory::give_back_when_idle() {
  if (workbench_.is_busy()) {
    pause_.start();
    return;
  }
  run_in_background([] { malloc_trim(0); });
}

}  // namespace handway::gui
