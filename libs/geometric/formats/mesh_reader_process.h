#pragma once

#include "handway/geometric/formats/mesh_stream.h"

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace handway::geometric {

/// Owns a descriptor of the system.
class OwnedDescriptor {
 public:
  explicit OwnedDescriptor(int descriptor = -1) : descriptor_(descriptor) {}
  ~OwnedDescriptor() { close(); }
  OwnedDescriptor(OwnedDescriptor&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)) {}
  OwnedDescriptor& operator=(OwnedDescriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

  [[nodiscard]] int get() const { return descriptor_; }
  void close();

 private:
  int descriptor_;
};

/// The program handway-mesh-reader while it runs; it serves one request after the other.
class MeshReaderProcess {
 public:
  /// @throws std::runtime_error if it can't be started.
  explicit MeshReaderProcess(std::filesystem::path program);
  /// Ends it.
  ~MeshReaderProcess();
  MeshReaderProcess(const MeshReaderProcess&) = delete;
  MeshReaderProcess& operator=(const MeshReaderProcess&) = delete;

  [[nodiscard]] const std::filesystem::path& program() const { return program_; }
  /// Returns whether the process runs and has sent everything.
  [[nodiscard]] bool idle() const;
  /// Returns whether it has reported the end of a reading before.
  [[nodiscard]] bool has_served() const { return has_served_; }

  /// @returns the pipe of the answer; invalid if the program has ended.
  [[nodiscard]] OwnedDescriptor ask(const MeshRequest& request, const std::filesystem::path& file);

  /// Returns the end of the reading. Nothing if the program died or is silent for `seconds`.
  [[nodiscard]] std::optional<MeshReadingEnd> wait_for_end(double seconds);

 private:
  std::filesystem::path program_;
  OwnedDescriptor socket_;
  pid_t process_ = -1;
  bool has_served_ = false;
};

/// Waits for bytes until `seconds` are over. @returns false at the end of the bytes or of the
/// time.
[[nodiscard]] bool read_whole(int descriptor, std::span<std::byte> bytes, double seconds);

/// The program: in the folder handway beside this library, or $HANDWAY_MESH_READER.
[[nodiscard]] std::filesystem::path mesh_reader_program();

/// Idle programs, for all threads: each thread has one for itself while it reads.
class MeshReaderPool {
 public:
  static MeshReaderPool& instance();

  /// @throws std::runtime_error if none can be started.
  [[nodiscard]] std::unique_ptr<MeshReaderProcess> take();
  /// Returns a program that has finished without errors.
  void give_back(std::unique_ptr<MeshReaderProcess> process);

 private:
  struct Idle;
  MeshReaderPool();

  Idle& idle_;
};

}  // namespace handway::geometric
