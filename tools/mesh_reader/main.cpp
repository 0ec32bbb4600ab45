/// Reads meshes of third-party formats for Handway's libraries, each file in a process of its own
/// (handway/geometric/io/mesh_stream.h). Users don't start it.
#include "handway/geometric/formats/mesh_stream.h"
#include "readers.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <string>

namespace handway::mesh_reader {
namespace {

using geometric::kMeshReaderSocket;
using geometric::MeshReadingEnd;
using geometric::MeshReadingOutcome;
using geometric::MeshReplyKind;
using geometric::MeshRequest;

constexpr rlim_t kOpenFiles = 64;

struct Order {
  MeshRequest request;
  std::filesystem::path file;
  int reply = -1;  ///< Descriptor to write to.
};

// Waits for the next one. Nothing if the library has closed the socket.
std::optional<Order> next_order() {
  Order order;
  std::array<char, geometric::kLongestMeshPath> path{};
  std::array<iovec, 2> parts{iovec{&order.request, sizeof order.request},
                             iovec{path.data(), path.size()}};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  msghdr message{};
  message.msg_iov = parts.data();
  message.msg_iovlen = parts.size();
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  ssize_t size = 0;
  do {
    size = ::recvmsg(kMeshReaderSocket, &message, MSG_CMSG_CLOEXEC);
  } while (size < 0 && errno == EINTR);
  const cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (size < static_cast<ssize_t>(sizeof order.request) ||
      order.request.mark != geometric::kMeshStreamMark || header == nullptr ||
      header->cmsg_type != SCM_RIGHTS) {
    return std::nullopt;
  }
  std::memcpy(&order.reply, CMSG_DATA(header), sizeof order.reply);
  order.file = std::string(path.data(), static_cast<std::size_t>(size) - sizeof order.request);
  return order;
}

void limit(int resource, rlim_t value) {
  const rlimit both{value, value};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

// Limits beyond which the process ends by a signal, or gets no more memory.
void set_limits(const MeshRequest& request) {
  const double whole = std::floor(request.seconds);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (request.seconds - whole));
  ::setitimer(ITIMER_PROF, &timer, nullptr);
  limit(RLIMIT_CPU, static_cast<rlim_t>(whole) + 2);
  limit(RLIMIT_AS, request.memory);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NOFILE, kOpenFiles);
}

void read_one(const Order& order) {
  try {
    set_limits(order.request);
    Mesh mesh(order.request.most_vertices);
    if (order.request.format == geometric::MeshFormat::kInventor) {
      read_inventor(order.file, order.request.scale, mesh);
    } else {
      read_by_assimp(order.file, mesh);
    }
    static_cast<void>(mesh.send(order.reply));
  } catch (const Refusal& refusal) {
    send_refusal(order.reply, MeshReplyKind::kRefused, refusal.text());
  } catch (const TooLarge&) {
    send_refusal(order.reply, MeshReplyKind::kTooLarge, "");
  } catch (const std::bad_alloc&) {
    send_refusal(order.reply, MeshReplyKind::kOutOfMemory, "");
  } catch (const std::exception& error) {
    send_refusal(order.reply, MeshReplyKind::kRefused,
                 Refusal("", error.what(), "a mesh file", "").text());
  }
}

// Reads one file in this process, which then ends without destructors and exit handlers: its state
// must not affect the next file.
[[noreturn]] void be_reader(const Order& order) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::close(kMeshReaderSocket);
  read_one(order);
  ::_exit(0);
}

MeshReadingEnd outcome_of(int status) {
  MeshReadingEnd end;
  if (WIFSIGNALED(status)) {
    end.signal = WTERMSIG(status);
    const bool slow = end.signal == SIGPROF || end.signal == SIGXCPU;
    end.outcome = slow ? MeshReadingOutcome::kTookTooLong : MeshReadingOutcome::kCrashed;
  } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    end.outcome = MeshReadingOutcome::kCrashed;
  }
  return end;
}

MeshReadingEnd serve(const Order& order) {
  const pid_t reader = ::fork();
  if (reader == 0) {
    be_reader(order);
  }
  ::close(order.reply);
  int status = 0;
  while (reader > 0 && ::waitpid(reader, &status, 0) < 0 && errno == EINTR) {
  }
  return reader > 0 ? outcome_of(status) : MeshReadingEnd{.outcome = MeshReadingOutcome::kCrashed};
}

int run() {
  prepare_assimp();
  prepare_inventor();
  while (const std::optional<Order> order = next_order()) {
    const MeshReadingEnd end = serve(*order);
    if (::send(kMeshReaderSocket, &end, sizeof end, MSG_NOSIGNAL) != sizeof end) {
      break;
    }
  }
  return 0;
}

}  // namespace
}  // namespace handway::mesh_reader

int main() {
  int type = 0;
  socklen_t size = sizeof type;
  if (::getsockopt(handway::geometric::kMeshReaderSocket, SOL_SOCKET, SO_TYPE, &type, &size) != 0 ||
      type != SOCK_SEQPACKET) {
    std::fputs("Handway's libraries start this program to read meshes; it has no other use.\n",
               stderr);
    return 2;
  }
  return handway::mesh_reader::run();
}
