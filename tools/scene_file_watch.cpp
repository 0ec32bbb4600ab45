#include "scene_file_watch.h"

#include "handway/geometric/io/disk_cache.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPeriod{20};

SeenFile glimpse(const fs::path& file) {
  std::error_code none;
  return {file, fs::last_write_time(file, none), fs::file_size(file, none), ""};
}

}  // namespace

std::vector<SeenFile> see_files(const std::vector<fs::path>& files) {
  std::vector<SeenFile> seen;
  for (const fs::path& file : files) {
    seen.push_back(glimpse(file));
    seen.back().digest = geometric::digest_of_file(file);
  }
  return seen;
}

SceneFileWatch::SceneFileWatch(std::vector<SeenFile> seen, std::function<void()> on_edit)
    : seen_(std::move(seen)),
      on_edit_(std::move(on_edit)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

bool SceneFileWatch::was_edited() {
  bool edited = false;
  for (SeenFile& before : seen_) {
    SeenFile now = glimpse(before.file);
    if (now.written == before.written && now.size == before.size) {
      continue;
    }
    now.digest = geometric::digest_of_file(before.file);
    edited = edited || now.digest != before.digest;
    before = std::move(now);
  }
  return edited;
}

void SceneFileWatch::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(kPeriod);
    if (was_edited()) {
      on_edit_();
    }
  }
}

}  // namespace handway::tools
