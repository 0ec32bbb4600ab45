#include "handway/geometric/formats/mesh_import.h"

#include "formats/mesh_reader_process.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/file_contents.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;
constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20;
constexpr const char* kViewer = "Open the file in a mesh viewer, or export it again";

constexpr auto kAssimpEndings = std::to_array<std::string_view>(
    {".3d",      ".3ds",  ".3mf",   ".ac",   ".ac3d", ".acc", ".amf",     ".ase",       ".ask",
     ".assbin",  ".b3d",  ".blend", ".bsp",  ".bvh",  ".cob", ".csm",     ".dae",       ".dxf",
     ".enff",    ".fbx",  ".glb",   ".gltf", ".hmp",  ".ifc", ".ifczip",  ".iqm",       ".irr",
     ".irrmesh", ".lwo",  ".lws",   ".lxo",  ".md2",  ".md3", ".md5anim", ".md5camera", ".md5mesh",
     ".mdc",     ".mdl",  ".mesh",  ".mot",  ".ms3d", ".ndo", ".nff",     ".obj",       ".off",
     ".ogex",    ".pk3",  ".ply",   ".pmx",  ".prj",  ".q3o", ".q3s",     ".raw",       ".scn",
     ".sib",     ".smd",  ".step",  ".stl",  ".stp",  ".ter", ".uc",      ".vta",       ".x",
     ".x3d",     ".x3db", ".xgl",   ".xml",  ".zae",  ".zgl"});

/// Limits of one reading.
struct Limits {
  explicit Limits(std::uint64_t file_size) {
    const double megabytes = static_cast<double>(file_size) / static_cast<double>(kMegabyte);
    request.seconds = 0.8 + 0.8 * megabytes;
    request.memory = 768 * kMegabyte + 64 * file_size;
    request.most_vertices = 1'000'000 + file_size;
    // A waiting process uses no processor time; a busy machine gives it little.
    wall_seconds = 10.0 + 10.0 * request.seconds;
  }

  MeshRequest request;
  double wall_seconds = 0.0;
};

// Quotes another program's text in a message.
std::string readable(std::string_view text) {
  constexpr std::size_t kLongest = 300;
  std::string result;
  for (const char c : text.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7F ? ' ' : static_cast<char>(byte);
  }
  const auto end = result.find_last_not_of(" .");
  return result.substr(0, end == std::string::npos ? 0 : end + 1);
}

std::uint64_t checked_size(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) {
    throw InputError(
        {file.string(), "",
         error && error != std::errc::no_such_file_or_directory ? error.message() : "no such file",
         "a mesh file", "Check the path"});
  }
  if (!fs::is_regular_file(status)) {
    throw InputError({file.string(), "", "something that is not a file", "a mesh file", ""});
  }
  const std::uint64_t size = fs::file_size(file, error);
  if (error || size > kLargestFile) {
    throw InputError(
        {file.string(), "", error ? error.message() : fmt::format("{} MB", size / kMegabyte),
         fmt::format("a mesh of at most {} MB", kLargestFile / kMegabyte), "Simplify the mesh"});
  }
  return size;
}

constexpr std::size_t kStlHeader = 80;
constexpr std::size_t kStlTriangle = 50;

// Refuses a binary STL file whose count of triangles contradicts the size of the file.
void refuse_wrong_count(const fs::path& file, std::uint64_t size, std::string_view head) {
  std::string begin(head.substr(0, 5));
  std::ranges::transform(begin, begin.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool is_text = begin == "solid" && head.find('\0') == std::string_view::npos;
  if (!has_extension(file, ".stl") || is_text) {
    return;
  }
  if (size < kStlHeader + sizeof(std::uint32_t)) {
    throw InputError({file.string(), "", fmt::format("{} bytes", size),
                      "an STL mesh, of 84 bytes or more", "Copy or export it again"});
  }
  std::uint32_t count = 0;
  std::memcpy(&count, head.data() + kStlHeader, sizeof count);
  const std::uint64_t body = size - kStlHeader - sizeof count;
  if (body != std::uint64_t{count} * kStlTriangle) {
    throw InputError({file.string(), "",
                      fmt::format("an STL mesh that says {} triangle{}, in a file with room for {}",
                                  count, count == 1 ? "" : "s", body / kStlTriangle),
                      "as many", "It may be cut off: copy or export it again"});
  }
}

// Refuses contents that are recognized without a third-party library.
void refuse_other_contents(const fs::path& file, std::uint64_t size) {
  constexpr std::size_t kHead = 1024;
  const std::string head = head_of(file, kHead);
  if (size == 0) {
    throw InputError({file.string(), "", "an empty file", "a mesh", "Copy or export it again"});
  }
  const bool is_archive = has_extension(file, ".3mf") || has_extension(file, ".zae") ||
                          has_extension(file, ".pk3") || has_extension(file, ".ifczip") ||
                          has_extension(file, ".wrl") || has_extension(file, ".vrml");
  if (const std::optional<StandIn> other = stand_in(head); other && !is_archive) {
    throw InputError({file.string(), "", other->found, "a mesh", other->advice});
  }
  refuse_wrong_count(file, size, head);
}

std::uint64_t checked_contents(const fs::path& file) {
  const std::uint64_t size = checked_size(file);
  refuse_other_contents(file, size);
  return size;
}

/// One file that is read by a process, from the request to the mesh.
class Reading {
 public:
  Reading(const fs::path& file, MeshFormat format, double scale)
      : file_(file), limits_(checked_contents(file)) {
    limits_.request.format = format;
    limits_.request.scale = scale;
  }

  [[nodiscard]] ImportedMesh run() {
    const fs::path absolute = fs::absolute(file_);
    if (absolute.string().size() > kLongestMeshPath) {
      refuse("a path that is too long", "Move the file");
    }
    std::unique_ptr<MeshReaderProcess> process = start();
    std::optional<MeshReadingEnd> end = ask(*process, absolute);
    // Retries with a new process: one that served before may have been killed since.
    while (!end && seconds_left() > 0.0 && process->has_served()) {
      process = start();
      end = ask(*process, absolute);
    }
    if (!end && seconds_left() > 0.0) {
      refuse("contents on which the program that reads it ended");
    }
    if (!end) {
      refuse_time(limits_.wall_seconds);
    }
    MeshReaderPool::instance().give_back(std::move(process));
    check(*end);
    check_mesh();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& advice = kViewer) const {
    throw InputError({file_.string(), "", found, "a mesh that can be read", advice});
  }

  [[noreturn]] void refuse_time(double seconds) const {
    refuse(fmt::format("contents that take longer than {:.1f} s to read", seconds));
  }

  [[nodiscard]] double seconds_left() const {
    const std::chrono::duration<double> gone = Clock::now() - begin_;
    return std::max(limits_.wall_seconds - gone.count(), 0.0);
  }

  [[nodiscard]] std::unique_ptr<MeshReaderProcess> start() const {
    try {
      return MeshReaderPool::instance().take();
    } catch (const std::runtime_error& error) {
      throw InputError({file_.string(), "",
                        fmt::format("no way to read it: {} can't be started: {}",
                                    mesh_reader_program().string(), error.what()),
                        "Handway's program for meshes", "Install Handway again"});
    }
  }

  // @returns nothing if the program has ended, or no time is left.
  [[nodiscard]] std::optional<MeshReadingEnd> ask(MeshReaderProcess& process,
                                                  const fs::path& absolute) {
    try {
      // The pipe closes with this call: a process that continues to write ends.
      whole_ = receive(process.ask(limits_.request, absolute));
    } catch (const std::runtime_error& error) {
      refuse(error.what(), "Close other files, or raise the limit (ulimit -n)");
    }
    return process.wait_for_end(seconds_left());
  }

  // @returns whether a complete answer came, as far as its form shows.
  [[nodiscard]] bool receive(const OwnedDescriptor& pipe) {
    if (pipe.get() < 0 || !read(pipe, std::span(&reply_, 1)) || reply_.mark != kMeshStreamMark ||
        reply_.text_bytes > kLongestMeshText ||
        std::max(reply_.vertices, reply_.triangles) > limits_.request.most_vertices) {
      return false;
    }
    text_.resize(reply_.text_bytes);
    mesh_.triangles.vertices.resize(reply_.vertices);
    mesh_.triangles.triangles.resize(reply_.triangles);
    return read(pipe, std::span(text_)) && read(pipe, std::span(mesh_.triangles.vertices)) &&
           read(pipe, std::span(mesh_.triangles.triangles));
  }

  template <typename Element>
  [[nodiscard]] bool read(const OwnedDescriptor& pipe, std::span<Element> elements) const {
    return read_whole(pipe.get(), std::as_writable_bytes(elements), seconds_left());
  }

  void check(const MeshReadingEnd& end) const {
    if (end.outcome == MeshReadingOutcome::kTookTooLong) {
      refuse_time(limits_.request.seconds);
    }
    if (end.outcome == MeshReadingOutcome::kCrashed || !whole_) {
      const char* name = end.signal > 0 ? sigabbrev_np(end.signal) : nullptr;
      refuse(fmt::format("contents on which reading it crashed{}",
                         name != nullptr ? fmt::format(" (SIG{})", name) : ""));
    }
    switch (reply_.kind) {
      case MeshReplyKind::kMesh:
        return;
      case MeshReplyKind::kRefused:
        refuse_as_given();
      case MeshReplyKind::kTooLarge:
        refuse(fmt::format("more than {} vertices or triangles", limits_.request.most_vertices),
               "Simplify the mesh");
      case MeshReplyKind::kOutOfMemory:
        refuse(fmt::format("contents that take more than {} MB of memory to read",
                           limits_.request.memory / kMegabyte));
    }
    refuse("something unreadable");
  }

  [[noreturn]] void refuse_as_given() const {
    std::array<std::string, 4> parts;
    std::string_view rest = text_;
    for (std::string& part : parts) {
      const std::size_t end = std::min(rest.find('\0'), rest.size());
      part = readable(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    const auto& [source, found, expected, advice] = parts;
    throw InputError({source.empty() ? file_.string() : source, "", found, expected, advice});
  }

  void check_mesh() {
    const TriangleMesh& mesh = mesh_.triangles;
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      if (!vertex.allFinite()) {
        throw InputError({file_.string(), "", "a vertex that is not finite", "finite numbers",
                          "Export the mesh again"});
      }
    }
    for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
      if (*std::ranges::max_element(triangle) >= mesh.vertices.size()) {
        refuse("a triangle that names a vertex which the file does not have");
      }
    }
    const auto& [red, green, blue, alpha] = reply_.color;
    mesh_.color = {red, green, blue, alpha};
    mesh_.includes_files = reply_.includes_files != 0;
    mesh_.largest = reply_.largest;
    std::string_view rest = text_;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      mesh_.warnings.push_back(readable(rest.substr(0, end)));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }

  fs::path file_;
  Limits limits_;
  Clock::time_point begin_ = Clock::now();
  MeshReply reply_;
  std::string text_;
  bool whole_ = false;
  ImportedMesh mesh_;
};

}  // namespace

ImportedMesh import_mesh(const fs::path& file, MeshFormat format, double scale) {
  return Reading(file, format, scale).run();
}

std::optional<InputProblem> rounding_problem(double largest) {
  constexpr double kShare = 6e-8;  // of a coordinate
  constexpr double kMost = 1e-5;   // m
  if (largest * kShare <= kMost) {
    return std::nullopt;
  }
  return InputProblem{
      "", "",
      fmt::format("a coordinate of {:.6g} m, which is read in single precision and so rounded by "
                  "{:.2g} mm",
                  largest, 1e3 * kShare * largest),
      fmt::format("coordinates up to {:.0f} m, rounded by 0.01 mm at most",
                  std::floor(kMost / kShare)),
      "Check the unit and the scale; or export the mesh about an origin nearby, and place it by "
      "its "
      "pose"};
}

bool is_assimp_file(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(kAssimpEndings, ending) != kAssimpEndings.end();
}

}  // namespace handway::geometric
