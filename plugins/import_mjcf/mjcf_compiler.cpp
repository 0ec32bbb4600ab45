#include "mjcf_compiler.h"

#include "handway/geometric/io/input_error.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <mutex>
#include <regex>
#include <stdexcept>

namespace handway::import_mjcf {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNameInMemory = "handway.xml";

// MuJoCo handles errors by ending the program.
void throw_error(const char* message) { throw std::runtime_error(message); }

std::vector<std::string>* caught = nullptr;

void catch_warning(const char* message) { caught->emplace_back(message); }

/// MuJoCo's handlers of errors and warnings are for the whole program: this sets its own during its
/// lifetime.
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

  // Returns false if its name is too long.
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

/// Error of MuJoCo about a text.
struct Refusal {
  std::string reason;
  std::string element;   ///< May be empty.
  std::size_t line = 0;  ///< Line in the text; 0: none is named.
};

Refusal refusal_of(const std::string& message) {
  Refusal refusal{message.substr(0, message.find('\n')), "", 0};
  std::smatch match;
  static const std::regex kLine(R"(line(?: =)? (\d+))");
  if (std::regex_search(message, match, kLine)) {
    refusal.line = std::stoul(match[1]);
  }
  static const std::regex kElement(R"(Element '(.*)',)");
  if (std::regex_search(message, match, kElement)) {
    refusal.element = match[1];
  }
  return refusal;
}

ModelPointer compile_text(const fs::path& file, const std::string& text, Refusal& refusal) {
  MemoryFiles files;
  // MuJoCo searches other files relative to the apparent place of this one.
  if (!files.add(kNameInMemory, text)) {
    refusal.reason = "no room for it";
    return nullptr;
  }
  const std::string place = (fs::absolute(file).parent_path() / kNameInMemory).string();
  std::array<char, 1024> message{};
  try {
    ModelPointer model(
        mj_loadXML(place.c_str(), files.get(), message.data(), static_cast<int>(message.size())));
    refusal = refusal_of(message.data());
    return model;
  } catch (const std::exception& error) {
    refusal = refusal_of(error.what());
    return nullptr;
  }
}

// Leaves out the refused mesh, if a mesh is the reason: Handway can read it itself.
bool leave_out_mesh(const Refusal& refusal, Compiled& compiled) {
  if (refusal.line == 0 || refusal.line > compiled.text.places.size()) {
    return false;
  }
  for (const auto& [name, mesh] : compiled.text.meshes) {
    if (mesh.place == compiled.text.places[refusal.line - 1]) {
      return compiled.faulty_meshes.try_emplace(name, refusal.reason).second;
    }
  }
  return false;
}

}  // namespace

void ModelDeleter::operator()(mjModel* model) const { mj_deleteModel(model); }

Compiled compile_mjcf(const fs::path& file, std::vector<std::string>& warnings) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  Compiled compiled;
  Refusal refusal;
  do {
    std::vector<std::string> said;
    const Handlers handlers(said);
    compiled.text = mjcf_text(file, compiled.faulty_meshes);
    compiled.model = compile_text(file, compiled.text.text, refusal);
    if (compiled.model) {
      warnings.insert(warnings.end(), said.begin(), said.end());
      return compiled;
    }
  } while (leave_out_mesh(refusal, compiled));
  const bool placed = refusal.line > 0 && refusal.line <= compiled.text.places.size();
  throw geometric::InputError({placed ? compiled.text.places[refusal.line - 1] : file.string(),
                               refusal.element.empty() ? "" : "<" + refusal.element + ">",
                               "a file that MuJoCo does not take: " + refusal.reason,
                               "a robot as MJCF", ""});
}

}  // namespace handway::import_mjcf
