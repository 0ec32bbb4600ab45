#pragma once

#include "tcp_host_port.h"

namespace handway::device {

/// Notices that a port's host is gone, or that another took its place.
class HostWatch {
 public:
  explicit HostWatch(const TcpHostPort& port) : port_(port) {}

  /// True if the host that was there when it was asked last is not there any more.
  [[nodiscard]] bool lost() {
    const bool gone = connected_ && (!port_.connected() || port_.connections() != connections_);
    connections_ = port_.connections();
    connected_ = port_.connected();
    return gone;
  }

 private:
  const TcpHostPort& port_;
  int connections_ = 0;
  bool connected_ = false;
};

}  // namespace handway::device
