#include "formats/mesh_reader_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostIdle = 4;

Clock::time_point after(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool wait_readable(int descriptor, Clock::time_point deadline) {
  while (true) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left < 0) {
      return false;
    }
    pollfd waiting{descriptor, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::min<long long>(left + 1, 1000)));
    if (ready > 0) {
      return true;
    }
    if (ready < 0 && errno != EINTR) {
      return false;
    }
  }
}

std::pair<OwnedDescriptor, OwnedDescriptor> socket_pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::runtime_error(std::string("no socket: ") + std::strerror(errno));
  }
  return {OwnedDescriptor(ends[0]), OwnedDescriptor(ends[1])};
}

// Settings of posix_spawn() for the program: it gets the socket, no output, no other descriptor of
// ours, a session and the signals of its own.
class Surroundings {
 public:
  explicit Surroundings(int socket) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_adddup2(&actions_, socket, kMeshReaderSocket);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
      ::posix_spawn_file_actions_addopen(&actions_, standard, "/dev/null", O_RDWR, 0);
    }
    ::posix_spawn_file_actions_addclosefrom_np(&actions_, kMeshReaderSocket + 1);
    ::posix_spawnattr_init(&attributes_);
    ::posix_spawnattr_setflags(&attributes_,
                               POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    sigset_t signals;
    ::sigemptyset(&signals);
    ::posix_spawnattr_setsigmask(&attributes_, &signals);
    ::sigfillset(&signals);
    ::posix_spawnattr_setsigdefault(&attributes_, &signals);
  }
  ~Surroundings() {
    ::posix_spawnattr_destroy(&attributes_);
    ::posix_spawn_file_actions_destroy(&actions_);
  }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  [[nodiscard]] pid_t start(const fs::path& program) const {
    std::string name = program.string();
    std::array<char*, 2> arguments{name.data(), nullptr};
    // Libraries that request large buffers for small files get them in large pages.
    std::string tunables = "GLIBC_TUNABLES=glibc.malloc.hugetlb=1";
    std::vector<char*> environment{tunables.data()};
    for (char** variable = environ; *variable != nullptr; ++variable) {
      if (!std::string_view(*variable).starts_with("GLIBC_TUNABLES=")) {
        environment.push_back(*variable);
      }
    }
    environment.push_back(nullptr);
    pid_t process = -1;
    const int error = ::posix_spawn(&process, name.c_str(), &actions_, &attributes_,
                                    arguments.data(), environment.data());
    if (error != 0) {
      throw std::runtime_error(std::strerror(error));
    }
    return process;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

bool send_request(int socket, MeshRequest request, std::string path, int reply) {
  std::array<iovec, 2> parts{iovec{&request, sizeof request}, iovec{path.data(), path.size()}};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  msghdr message{};
  message.msg_iov = parts.data();
  message.msg_iovlen = parts.size();
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  cmsghdr* header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof reply);
  std::memcpy(CMSG_DATA(header), &reply, sizeof reply);
  return ::sendmsg(socket, &message, MSG_NOSIGNAL) > 0;
}

}  // namespace

void OwnedDescriptor::close() {
  if (descriptor_ >= 0) {
    ::close(std::exchange(descriptor_, -1));
  }
}

MeshReaderProcess::MeshReaderProcess(fs::path program) : program_(std::move(program)) {
  auto [ours, theirs] = socket_pair();
  socket_ = std::move(ours);
  process_ = Surroundings(theirs.get()).start(program_);
}

MeshReaderProcess::~MeshReaderProcess() {
  ::kill(-process_, SIGKILL);  // and the process that reads a file
  ::kill(process_, SIGKILL);   // should it not have its session yet
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool MeshReaderProcess::idle() const {
  pollfd socket{socket_.get(), POLLIN, 0};
  return ::poll(&socket, 1, 0) == 0;
}

OwnedDescriptor MeshReaderProcess::ask(const MeshRequest& request, const fs::path& file) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
  }
  OwnedDescriptor ours(ends[0]);
  const OwnedDescriptor theirs(ends[1]);
  return send_request(socket_.get(), request, file.string(), theirs.get()) ? std::move(ours)
                                                                           : OwnedDescriptor();
}

std::optional<MeshReadingEnd> MeshReaderProcess::wait_for_end(double seconds) {
  MeshReadingEnd end;
  if (!wait_readable(socket_.get(), after(seconds)) ||
      ::recv(socket_.get(), &end, sizeof end, 0) != static_cast<ssize_t>(sizeof end) ||
      end.mark != kMeshStreamMark) {
    return std::nullopt;
  }
  has_served_ = true;
  return end;
}

bool read_whole(int descriptor, std::span<std::byte> bytes, double seconds) {
  const Clock::time_point deadline = after(seconds);
  while (!bytes.empty()) {
    if (!wait_readable(descriptor, deadline)) {
      return false;
    }
    const ssize_t size = ::read(descriptor, bytes.data(), bytes.size());
    if (size < 0 && errno == EINTR) {
      continue;
    }
    if (size <= 0) {
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(size));
  }
  return true;
}

fs::path mesh_reader_program() {
  if (const char* given = std::getenv("HANDWAY_MESH_READER"); given != nullptr && *given != '\0') {
    return given;
  }
  // This library's folder, independent of the program that has loaded it.
  Dl_info library{};
  std::error_code error;
  if (::dladdr(reinterpret_cast<const void*>(&mesh_reader_program), &library) != 0 &&
      library.dli_fname != nullptr) {
    return fs::canonical(library.dli_fname, error).parent_path() / "handway" /
           "handway-mesh-reader";
  }
  return "handway-mesh-reader";
}

struct MeshReaderPool::Idle {
  std::mutex mutex;
  std::vector<std::unique_ptr<MeshReaderProcess>> processes;
  pid_t owner = ::getpid();
};

// The processes end with the program, which closes their sockets, without being waited for.
MeshReaderPool::MeshReaderPool() : idle_(*new Idle) {}

MeshReaderPool& MeshReaderPool::instance() {
  static MeshReaderPool pool;
  return pool;
}

std::unique_ptr<MeshReaderProcess> MeshReaderPool::take() {
  fs::path program = mesh_reader_program();
  {
    const std::lock_guard lock(idle_.mutex);
    if (idle_.owner != ::getpid()) {  // a fork must not talk to what belongs to its parent
      for (std::unique_ptr<MeshReaderProcess>& process : idle_.processes) {
        static_cast<void>(process.release());
      }
      idle_.processes.clear();
      idle_.owner = ::getpid();
    }
    while (!idle_.processes.empty()) {
      std::unique_ptr<MeshReaderProcess> process = std::move(idle_.processes.back());
      idle_.processes.pop_back();
      if (process->idle() && process->program() == program) {
        return process;
      }
    }
  }
  return std::make_unique<MeshReaderProcess>(std::move(program));
}

void MeshReaderPool::give_back(std::unique_ptr<MeshReaderProcess> process) {
  const std::lock_guard lock(idle_.mutex);
  if (idle_.processes.size() < kMostIdle && idle_.owner == ::getpid()) {
    idle_.processes.push_back(std::move(process));
  }
}

}  // namespace handway::geometric
