#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace handway::test {

/// `handway ARGUMENTS` running beside the test; killed with the object.
class BackgroundProcess {
 public:
  explicit BackgroundProcess(const std::vector<std::string>& arguments);
  ~BackgroundProcess();
  BackgroundProcess(const BackgroundProcess&) = delete;
  BackgroundProcess& operator=(const BackgroundProcess&) = delete;

  /// The next line of standard output, without its end; empty if none comes within 10 s.
  [[nodiscard]] std::string read_line();
  void send(int signal) const;
  /// Waits for its end. @returns the exit code; -1 if a signal ended it or it runs on for 10 s.
  int wait();

 private:
  pid_t pid_ = -1;
  int output_ = -1;
};

}  // namespace handway::test
