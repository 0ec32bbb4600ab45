#include "mujoco_model.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace handway::import_mjcf {
namespace {

constexpr std::size_t kLargestFile = std::size_t{16} << 20;

// MuJoCo's own way with errors is to end the program.
void throw_error(const char* message) { throw std::runtime_error(message); }

std::vector<std::string>* caught = nullptr;

void catch_warning(const char* message) { caught->emplace_back(message); }

/// MuJoCo's handlers of errors and warnings are for the whole program: ours for as long as this is
/// there.
class Handlers {
 public:
  explicit Handlers(std::vector<std::string>& warnings)
      : error_(mju_user_error), warning_(mju_user_warning) {
    caught = &warnings;
    mju_user_error = throw_error;
    mju_user_warning = catch_warning;
  }
  ~Handlers() {
    mju_user_error = error_;
    mju_user_warning = warning_;
  }
  Handlers(const Handlers&) = delete;
  Handlers& operator=(const Handlers&) = delete;

 private:
  void (*error_)(const char*);
  void (*warning_)(const char*);
};

/// MuJoCo's files in memory, which it prefers to those of the disk.
class MemoryFiles {
 public:
  MemoryFiles() { mj_defaultVFS(files_.get()); }
  ~MemoryFiles() { mj_deleteVFS(files_.get()); }
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;

  // False if its name is too long.
  bool add(const std::string& name, const std::string& text) {
    if (mj_makeEmptyFileVFS(files_.get(), name.c_str(), static_cast<int>(text.size())) != 0) {
      return false;
    }
    const int index = mj_findFileVFS(files_.get(), name.c_str());
    std::memcpy(files_->filedata[index], text.data(), text.size());
    return true;
  }

  [[nodiscard]] const mjVFS* get() const { return files_.get(); }

 private:
  std::unique_ptr<mjVFS> files_ = std::make_unique<mjVFS>();
};

// The file's text as MuJoCo 3 understands it: a joint with a range is limited. A line stays what it
// was.
std::string with_limits(const std::filesystem::path& file) {
  std::string text = geometric::read_text_file(file, "a robot as MJCF", kLargestFile);
  pugi::xml_document document;
  if (document.load_buffer(text.data(), text.size())) {
    if (const pugi::xml_node first = document.child("mujoco").first_child();
        first.type() == pugi::node_element) {
      // The offset is that of the name, behind the <.
      text.insert(static_cast<std::size_t>(first.offset_debug()) - 1,
                  "<compiler autolimits=\"true\"/>");
    }
  }
  return text;
}

}  // namespace

ModelPointer compile_mjcf(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const Handlers handlers(warnings);
  MemoryFiles files;
  const bool in_memory = files.add(file.filename().string(), with_limits(file));
  std::array<char, 1024> message{};
  std::string reason;
  try {
    ModelPointer model(mj_loadXML(file.c_str(), in_memory ? files.get() : nullptr, message.data(),
                                  static_cast<int>(message.size())));
    if (model) {
      return model;
    }
    reason = message.data();
  } catch (const std::exception& error) {
    reason = error.what();
  }
  throw geometric::InputError(
      {file.string(), "", "a file that MuJoCo does not take: " + reason, "a robot as MJCF", ""});
}

std::string name_of(const mjModel& model, mjtObj kind, int index) {
  if (const char* name = mj_id2name(&model, kind, index); name != nullptr && *name != '\0') {
    return name;
  }
  return fmt::format("{}_{}", mju_type2Str(kind), index);
}

}  // namespace handway::import_mjcf
