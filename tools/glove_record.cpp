#include "commands.h"
#include "glove_commands.h"
#include "handway/device/glove/glove.h"
#include "handway/device/glove/recording.h"
#include "numbers.h"
#include "printing.h"
#include "terminal.h"

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <stop_token>

namespace handway::tools {
namespace {

using device::GloveFrame;
using device::GloveInfo;
using device::StreamState;
using std::chrono::milliseconds;

struct RecordOptions {
  GloveDeviceOptions device;
  std::filesystem::path out;
  std::optional<double> duration_s;
  std::uint64_t frames = 0;
  std::string origin;
};

device::RecordingHeader header_of(const GloveInfo& info, const std::string& origin) {
  device::RecordingHeader header = device::recording_header(info);
  header.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  header.origin = origin;
  return header;
}

/// Takes frames on the stream's thread and writes each before the next. The file begins with the
/// first connection: no file is overwritten without a glove.
class Recorder {
 public:
  explicit Recorder(const RecordOptions& options) : options_(options) {}

  void connected(const GloveInfo& info) {
    attempt([&] {
      if (!writer_) {
        writer_.emplace(options_.out, header_of(info, options_.origin), info.raw);
      }
    });
  }

  void take(const GloveFrame& frame) {
    attempt([&] {
      if (complete_) {
        return;
      }
      if (writer_->rows() == 0) {
        begin_ = frame.time;
      }
      GloveFrame row = frame;
      row.time -= begin_;
      if (options_.duration_s && row.time > *options_.duration_s) {
        complete_ = true;
        return;
      }
      writer_->append(row);
      complete_ = options_.frames > 0 && writer_->rows() == options_.frames;
    });
  }

  /// Returns whether the requested rows are written, or can't be.
  [[nodiscard]] bool complete() const {
    const std::lock_guard lock(mutex_);
    return complete_;
  }
  [[nodiscard]] std::size_t rows() const {
    const std::lock_guard lock(mutex_);
    return writer_ ? writer_->rows() : 0;
  }
  void rethrow() const {
    const std::lock_guard lock(mutex_);
    if (error_) {
      std::rethrow_exception(error_);
    }
  }

 private:
  template <typename Action>
  void attempt(const Action& action) {
    const std::lock_guard lock(mutex_);
    if (error_) {
      return;
    }
    try {
      action();
    } catch (...) {
      error_ = std::current_exception();
      complete_ = true;
    }
  }

  const RecordOptions& options_;
  mutable std::mutex mutex_;
  std::optional<device::RecordingWriter> writer_;
  double begin_ = 0.0;
  bool complete_ = false;
  std::exception_ptr error_;
};

void print_state(StreamState state) {
  if (state == StreamState::kLost) {
    print_error("connection lost; trying to connect again\n");
  } else if (state == StreamState::kUnplugged) {
    print_error("the glove is unplugged; waiting until it is plugged in\n");
  } else if (state == StreamState::kStreaming) {
    print_error("recording\n");
  }
}

int record(const RecordOptions& options) {
  Recorder recorder(options);
  device::GloveStreamHandlers handlers;
  handlers.on_connected = [&](const GloveInfo& info) { recorder.connected(info); };
  handlers.on_sample = [&](const GloveFrame& frame) { recorder.take(frame); };
  handlers.on_state = print_state;
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  device::GloveStream stream(make_glove(options.device), {}, handlers);
  // The duration includes time in which the glove is away.
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> first;
  while (!stop.stop_requested() && !recorder.complete() && !stream.wait(milliseconds(20))) {
    if (!first && recorder.rows() > 0) {
      first = Clock::now();
    }
    if (first && options.duration_s &&
        Clock::now() - *first > std::chrono::duration<double>(*options.duration_s)) {
      break;
    }
  }
  recorder.rethrow();
  if (stream.state() == StreamState::kFailed) {
    throw std::runtime_error(stream.error());
  }
  const device::StreamStatistics statistics = stream.statistics();
  stream.request_stop();
  while (!stream.wait(milliseconds(100))) {
  }
  recorder.rethrow();
  print_out("{} frames in {}\n{}\n", recorder.rows(), options.out.string(),
            statistics_line(statistics));
  return kDone;
}

}  // namespace

void add_glove_record(CLI::App& glove, int& exit_code) {
  auto options = std::make_shared<RecordOptions>();
  CLI::App* command = glove.add_subcommand("record", "Record the measurements of a glove");
  add_glove_device_options(*command, options->device);
  command->add_option("--out", options->out, "Recording to write (CSV)")->required();
  command
      ->add_option("--duration", options->duration_s,
                   "Stop after this time, s (default: at Ctrl+C)")
      ->check(positive_number());
  command->add_option("--frames", options->frames, "Stop after this number of frames")
      ->check(CLI::PositiveNumber);
  command->add_option("--origin", options->origin,
                      "Note about the person and the purpose, written to the file");
  command->callback([options, &exit_code] { exit_code = record(*options); });
}

}  // namespace handway::tools
