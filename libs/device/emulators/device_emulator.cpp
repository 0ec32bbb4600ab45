#include "handway/device/emulators/device_emulator.h"

#include "core/ports.h"
#include "core/random_moves.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace handway::device {
std::vector<geometric::BoundParameter> parameters_of(LineFaultSettings& settings) {
  return {{"dropout", "Lost records", "", "Share of records that are lost", &settings.dropout, 0.0,
           1.0},
          {"garbage", "Damaged records", "", "Share of records that are damaged", &settings.garbage,
           0.0, 1.0}};
}

LineFaults::LineFaults(const LineFaultSettings& settings)
    : settings_(settings), random_(std::make_unique<SeededRandom>(settings.seed)) {
  for (const double probability : {settings.dropout, settings.garbage}) {
    if (!(probability >= 0.0 && probability <= 1.0)) {
      throw std::invalid_argument("a probability has to be from 0 to 1");
    }
  }
}

LineFaults::~LineFaults() = default;

std::vector<std::uint8_t> LineFaults::apply(std::vector<std::uint8_t> record) {
  if (record.empty()) {
    return record;
  }
  if (random_->uniform() < settings_.dropout) {
    ++count_;
    return {};
  }
  if (random_->uniform() < settings_.garbage) {
    ++count_;
    damage(record);
  }
  return record;
}

void LineFaults::damage(std::vector<std::uint8_t>& record) {
  const auto at = record.begin() + static_cast<std::ptrdiff_t>(random_->index(record.size()));
  switch (random_->index(5)) {
    case 0:
      record.erase(at);
      break;
    case 1:
      record.insert(at, *at);
      break;
    case 2:
      *at = 0;
      break;
    case 3:
      record.erase(at, record.end());
      break;
    default: {
      std::vector<std::uint8_t> noise(1 + random_->index(40));
      for (std::uint8_t& byte : noise) {
        byte = static_cast<std::uint8_t>(random_->bits());
      }
      record.insert(record.begin(), noise.begin(), noise.end());
    }
  }
}

namespace {

using Clock = std::chrono::steady_clock;

// Longest delay until a stop or an unplugging takes effect, s.
constexpr double kLongestWait = 0.02;

std::unique_ptr<HostPort> open_port(const DeviceEmulatorSettings& settings) {
  if (settings.udp_receiver) {
    return send_to_udp_port(*settings.udp_receiver);
  }
  if (settings.tcp_server) {
    return connect_to_tcp_port(*settings.tcp_server, settings.greeting);
  }
  return settings.tcp_port ? listen_on_tcp_port(*settings.tcp_port) : open_pseudo_terminal();
}

}  // namespace

struct DeviceEmulator::Running {
  Running(const DeviceEmulatorSettings& given, std::unique_ptr<DeviceUnit> given_unit)
      : settings(given),
        unit(std::move(given_unit)),
        faults(given.faults),
        port(open_port(given)),
        address(port->address()) {
    if (!(given.latency >= 0.0)) {
      throw std::invalid_argument("a latency can't be below 0");
    }
  }

  DeviceEmulatorSettings settings;
  std::unique_ptr<DeviceUnit> unit;
  LineFaults faults;
  std::unique_ptr<HostPort> port;
  std::string address;
  DelayedBytes outgoing;
  std::atomic<bool> plugged = true;
  std::atomic<std::uint64_t> records = 0;
  std::atomic<std::uint64_t> fault_count = 0;
  std::jthread thread;  ///< Last: it uses all other members.

  void run(const std::stop_token& stop);
  void send(DeviceUnit::Bytes bytes, double now);
  [[nodiscard]] bool plugged_at(double now) const;
  [[nodiscard]] double wait_from(double now) const;
};

bool DeviceEmulator::Running::plugged_at(double now) const {
  const bool pulled = settings.unplug_at && now >= *settings.unplug_at &&
                      !(settings.replug_at && now >= *settings.replug_at);
  return plugged && !pulled;
}

void DeviceEmulator::Running::send(DeviceUnit::Bytes bytes, double now) {
  if (!bytes.empty()) {
    outgoing.add(std::move(bytes), now + settings.latency);
  }
}

double DeviceEmulator::Running::wait_from(double now) const {
  double until = now + kLongestWait;
  if (const auto due = unit->next_due()) {
    until = std::min(until, *due);
  }
  if (const auto due = outgoing.next_due()) {
    until = std::min(until, *due);
  }
  return std::max(until - now, 0.0);
}

void DeviceEmulator::Running::run(const std::stop_token& stop) {
  const auto begin = Clock::now();
  const auto now = [begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::array<std::uint8_t, 256> bytes{};
  while (!stop.stop_requested()) {
    const auto wait = std::chrono::microseconds(static_cast<long>(wait_from(now()) * 1e6));
    const std::size_t count = port->read(bytes, wait);
    const double time = now();
    unit->set_plugged(plugged_at(time));
    // Records that were due before the host's command are sent before the answer.
    for (DeviceUnit::Bytes& record : unit->advance(time)) {
      send(faults.apply(std::move(record)), time);
      ++records;
    }
    fault_count = faults.count();
    if (count > 0) {
      send(unit->receive(std::span(bytes).first(count), time), time);
    }
    outgoing.send(*port, time);
  }
}

DeviceEmulator::DeviceEmulator(const DeviceEmulatorSettings& settings,
                               std::unique_ptr<DeviceUnit> unit)
    : running_(std::make_unique<Running>(settings, std::move(unit))) {
  running_->thread =
      std::jthread([running = running_.get()](const std::stop_token& stop) { running->run(stop); });
}

DeviceEmulator::~DeviceEmulator() = default;

const std::string& DeviceEmulator::address() const { return running_->address; }

void DeviceEmulator::set_plugged(bool plugged) { running_->plugged = plugged; }

std::uint64_t DeviceEmulator::records() const { return running_->records; }

std::uint64_t DeviceEmulator::faults() const { return running_->fault_count; }

}  // namespace handway::device
