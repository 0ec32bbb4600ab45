#include "handway/device/emulators/glove_emulator.h"

#include "glove/cyberglove_protocol.h"
#include "handway/device/glove/glove_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr std::uint8_t kInterrupt = 0x03;
constexpr std::uint8_t kControlR = 0x12;
constexpr double kRestartTime = 1.75;    // s
constexpr double kCommandTimeout = 1.0;  // s, after which a half command is forgotten.
constexpr double kBacklog = 0.25;        // s

// Bytes that follow the letter of a binary command of a setting; other commands are elsewhere.
std::optional<std::size_t> argument_bytes(char letter) {
  switch (letter) {
    case 'B':
    case 'D':
    case 'F':
    case 'J':
    case 'L':
    case 'N':
    case 'Q':
    case 'U':
    case 'W':
    case 'Y':
      return 1;
    case 'C':
    case 'M':
    case 'P':
      return 3;
    case 'T':
      return 4;
    default:
      return std::nullopt;
  }
}

bool is_upper(std::uint8_t byte) { return byte >= 'A' && byte <= 'Z'; }

void append(CyberGloveUnit::Bytes& out, std::span<const std::uint8_t> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

void append(CyberGloveUnit::Bytes& out, std::initializer_list<std::uint8_t> bytes) {
  out.insert(out.end(), bytes);
}

}  // namespace

CyberGloveUnit::CyberGloveUnit(const CyberGloveUnitSettings& settings, GloveSignal signal)
    : settings_(settings), signal_(std::move(signal)) {
  (void)cyberglove_wired(settings.sensors);  // Refuses other numbers of sensors.
  if (!(settings.rate > 0.0)) {
    throw std::invalid_argument("a glove's sampling rate has to be above 0");
  }
  reset_registers();
}

void CyberGloveUnit::reset_registers() {
  const auto sensors = static_cast<std::uint8_t>(settings_.sensors);
  const auto words = sampling_words(settings_.rate);
  registers_ = {{'B', {1}},
                {'C', Bytes(3, 0)},
                {'D', {0}},
                {'F', {0}},
                {'J', {0}},
                {'K', {0xFF, 0xFF, 0x3F}},
                {'L', {0}},
                {'M', {0xFF, 0xFF, 0x3F}},
                {'N', {sensors}},
                {'P', Bytes(3, 0)},
                {'Q', {0}},
                {'S', {sensors}},
                {'T', {words.begin(), words.end()}},
                {'U', {0}},
                {'V', {0, 2, 0, 1}},
                {'W', {0}},
                {'Y', {0}}};
  if (settings_.sensors == 18) {
    registers_['K'] = registers_['M'] = {0x7B, 0xBB, 0x3F};
  }
}

CyberGloveUnit::Bytes CyberGloveUnit::receive(std::span<const std::uint8_t> bytes, double now) {
  Bytes out;
  if (!command_.empty() && now - command_time_ > kCommandTimeout) {
    command_.clear();
  }
  for (const std::uint8_t byte : bytes) {
    command_time_ = now;
    take(byte, now, out);
  }
  return out;
}

void CyberGloveUnit::take(std::uint8_t byte, double now, Bytes& out) {
  if (restarted_at_) {
    return;
  }
  // Some hosts send the two characters "^C" for Ctrl-C.
  const bool spelled = !command_.empty() && command_[0] == '^' && (byte == 'C' || byte == 'R');
  if (byte == kInterrupt || (spelled && byte == 'C')) {
    streaming_.reset();
    command_.clear();
    append(out, spelled ? Bytes{'^', 'C', '\r', '\n', 0} : Bytes{kInterrupt, 0});
    return;
  }
  if (streaming_) {
    command_.assign(byte == '^' ? 1 : 0, byte);
    return;
  }
  if (byte == kControlR || spelled) {
    append(out, spelled ? Bytes{'^', 'R', '\r', '\n'} : Bytes{kControlR});
    command_.clear();
    reset_registers();
    restarted_at_ = now + kRestartTime;
    return;
  }
  command_.push_back(byte);
  const std::uint8_t kind = command_[0] == '?' && command_.size() > 1 ? command_[1] : command_[0];
  if (command_[0] == '^' || (command_[0] == '?' && command_.size() == 1)) {
    return;
  }
  if (is_upper(kind)) {
    take_binary(now, out);
  } else if (std::islower(kind) != 0) {
    take_text(now, out);
  } else {
    if (kind != '\r' && kind != '\n') {
      append(out, {kind, 'e', '?', 0});
    }
    command_.clear();
  }
}

void CyberGloveUnit::take_binary(double now, Bytes& out) {
  const char letter = static_cast<char>(command_[0]);
  if (letter == '?') {
    query(static_cast<char>(command_[1]), Form::kBinary, out);
  } else if (letter == 'G') {
    append(out, record(Form::kBinary, 'G', now));
  } else if (letter == 'S') {
    begin_stream(Form::kBinary, now);
  } else if (letter == 'A') {
    // CyberTouch: a count with as many pairs, or FF with six strengths.
    const std::size_t count = command_.size() < 2   ? 1
                              : command_[1] == 0xFF ? 7
                                                    : 1 + 2 * std::size_t{command_[1]};
    if (command_.size() <= count) {
      return;
    }
    append(out, {'A', 0});
  } else if (const auto count = argument_bytes(letter)) {
    if (command_.size() <= *count) {
      return;
    }
    set(letter, {command_.begin() + 1, command_.end()}, Form::kBinary, out);
  } else {
    append(out, {command_[0], 'e', '?', 0});
  }
  command_.clear();
}

void CyberGloveUnit::take_text(double now, Bytes& out) {
  if (command_.back() != '\r') {
    if (command_.size() > 64) {
      command_.clear();
      append(out, text_refusal("e?"));
    }
    return;
  }
  const std::optional<TextCommand> command = read_text_command(command_);
  command_.clear();
  if (!command) {
    append(out, text_refusal("e?"));
  } else if (command->query) {
    query(command->letter, Form::kText, out);
  } else if (command->letter == 'G') {
    append(out, record(Form::kText, 'G', now));
  } else if (command->letter == 'S') {
    begin_stream(Form::kText, now);
  } else if (command->letter == 'I') {
    append(out, text_line("i CyberGlove interface unit, emulated by Handway"));
  } else {
    set(command->letter, command->arguments, Form::kText, out);
  }
}

CyberGloveUnit::Bytes CyberGloveUnit::query_data(char letter) const {
  switch (letter) {
    case 'G':
      return {static_cast<std::uint8_t>(plugged_ ? 0x03 : 0x01)};
    case 'R':
      return {static_cast<std::uint8_t>(settings_.right_hand ? 1 : 0)};
    case 'P': {
      Bytes flags = registers_.at('P');
      flags[0] = plugged_ ? 1 : 0;
      flags[1] = static_cast<std::uint8_t>(
          0x80 | (settings_.right_hand ? 0x40 : 0) | (registers_.at('D')[0] != 0 ? 0x20 : 0) |
          (registers_.at('F')[0] != 0 ? 0x10 : 0) | (registers_.at('U')[0] != 0 ? 0x04 : 0));
      return flags;
    }
    default: {
      const auto found = registers_.find(letter);
      return found == registers_.end() ? Bytes{} : found->second;
    }
  }
}

void CyberGloveUnit::query(char letter, Form form, Bytes& out) const {
  const Bytes data = query_data(letter);
  if (form == Form::kText) {
    append(out, data.empty() ? text_refusal("e?") : text_answer('?', letter, data));
    return;
  }
  append(out, {'?', static_cast<std::uint8_t>(letter)});
  if (data.empty()) {
    append(out, {'e', '?'});
  }
  append(out, data);
  append(out, {0});
}

void CyberGloveUnit::set(char letter, const Bytes& arguments, Form form, Bytes& out) {
  const auto expected = argument_bytes(letter);
  bool good = expected && arguments.size() == *expected;
  const char* refusal = "e?";
  if (good && letter == 'N') {
    good = arguments[0] >= 1 && arguments[0] <= settings_.sensors;
  }
  if (good && letter == 'T') {
    const unsigned product =
        (arguments[0] * 256U + arguments[1]) * (arguments[2] * 256U + arguments[3]);
    good = product == 0 || 115200.0 / product <= settings_.top_rate;
    refusal = good ? refusal : "es";
  }
  if (good) {
    registers_[letter] = arguments;
  }
  if (form == Form::kText) {
    append(out, good ? text_answer(0, letter, arguments) : text_refusal(refusal));
    return;
  }
  append(out, {static_cast<std::uint8_t>(letter)});
  if (!good) {
    append(out, {static_cast<std::uint8_t>(refusal[0]), static_cast<std::uint8_t>(refusal[1])});
  }
  append(out, {0});
}

double CyberGloveUnit::period() const {
  const Bytes& words = registers_.at('T');
  const double product = (words[0] * 256.0 + words[1]) * (words[2] * 256.0 + words[3]);
  return product > 0.0 ? product / 115200.0 : 1.0 / settings_.top_rate;
}

void CyberGloveUnit::begin_stream(Form form, double now) {
  streaming_ = form;
  next_record_ = now + period();
}

CyberGloveUnit::Bytes CyberGloveUnit::record(Form form, char letter, double time) const {
  if (!plugged_) {
    return form == Form::kText ? text_refusal("eg")
                               : Bytes{static_cast<std::uint8_t>(letter), 'e', 'g', 0};
  }
  const auto counts = signal_(time);
  const auto wired = cyberglove_wired(settings_.sensors);
  Bytes values;
  for (const int sensor : wired.first(registers_.at('N')[0])) {
    values.push_back(static_cast<std::uint8_t>(
        std::clamp<int>(counts[static_cast<std::size_t>(sensor)], 1, 255)));
  }
  if (form == Form::kText) {
    return text_answer(0, letter, values);
  }
  Bytes out{static_cast<std::uint8_t>(letter)};
  append(out, values);
  if (registers_.at('D')[0] != 0) {
    const auto ticks = static_cast<std::uint32_t>(time * 1000.0);
    // A zero byte is sent as 1, which a bit of the first byte marks. The first byte has its highest
    // bit set, so that it is never 0 itself.
    Bytes stamp{0x80};
    for (unsigned k = 0; k < 4; ++k) {
      const auto byte = static_cast<std::uint8_t>(ticks >> (24U - 8U * k));
      stamp[0] |= static_cast<std::uint8_t>(byte == 0 ? 1U << k : 0U);
      stamp.push_back(byte == 0 ? 1 : byte);
    }
    append(out, stamp);
  }
  if (registers_.at('U')[0] != 0) {
    append(out, {static_cast<std::uint8_t>(1 | (registers_.at('W')[0] != 0 ? 2 : 0) |
                                           (registers_.at('L')[0] != 0 ? 4 : 0))});
  }
  append(out, {0});
  return out;
}

std::vector<CyberGloveUnit::Bytes> CyberGloveUnit::advance(double now) {
  std::vector<Bytes> out;
  if (restarted_at_ && now >= *restarted_at_) {
    restarted_at_.reset();
    out.push_back({0});
  }
  if (streaming_) {
    next_record_ = std::max(next_record_, now - kBacklog);
  }
  while (streaming_ && next_record_ <= now) {
    out.push_back(record(*streaming_, 'S', next_record_));
    next_record_ += period();
    if (!plugged_) {
      streaming_.reset();  // One "eg", then silence.
    }
  }
  return out;
}

std::optional<double> CyberGloveUnit::next_due() const {
  if (restarted_at_) {
    return restarted_at_;
  }
  return streaming_ ? std::optional(next_record_) : std::nullopt;
}

namespace {

constexpr double kNativePeriod = 1.0 / 90.0;  // s
// Records of one thirtieth of a second, which the time stamp numbers.
constexpr int kRepeats = 3;

// "1ts" takes a time of day in 8 characters; "1m", "1u", "1w", "1s" a byte; "1e", "1d" a letter.
std::size_t command_length(const std::string& begun) {
  if (begun.size() < 2) {
    return 2;
  }
  switch (begun[1]) {
    case 'e':
    case 'd':
    case 'm':
    case 'u':
    case 'w':
    case 's':
      return 3;
    case 't':
      return 11;
    default:
      return 2;
  }
}

}  // namespace

CyberGlove3Unit::Bytes CyberGlove3Unit::receive(std::span<const std::uint8_t> bytes, double now) {
  for (const std::uint8_t byte : bytes) {
    const char letter = static_cast<char>(byte);
    if (byte == kInterrupt) {
      next_record_.reset();
      command_.clear();
      continue;
    }
    const bool begins = letter == '1' || letter == '!';
    if (command_.empty() && !begins) {
      continue;  // No command of this glove.
    }
    command_ += letter;
    if (command_[0] == '!') {
      if (command_ == "!!!") {
        next_record_.reset();
      }
      if (letter != '!' || command_.size() == 3) {
        command_.clear();
      }
    } else if (command_.size() == command_length(command_)) {
      take_command(now);
      command_.clear();
    }
  }
  return {};
}

void CyberGlove3Unit::take_command(double now) {
  if (command_ == "1eu" || command_ == "1du") {
    usb_ = command_[1] == 'e';
  } else if (command_ == "1S" && !next_record_) {
    next_record_ = now + kNativePeriod;
  }
}

std::vector<CyberGlove3Unit::Bytes> CyberGlove3Unit::advance(double now) {
  std::vector<Bytes> out;
  if (next_record_) {
    next_record_ = std::max(*next_record_, now - kBacklog);
  }
  while (next_record_ && *next_record_ <= now) {
    if (usb_ && plugged_) {
      out.push_back(record(*next_record_));
    }
    *next_record_ += kNativePeriod;
  }
  return out;
}

std::optional<double> CyberGlove3Unit::next_due() const { return next_record_; }

CyberGlove3Unit::Bytes CyberGlove3Unit::record(double time) {
  const auto seconds = static_cast<long>(time);
  const int in_second = static_cast<int>((time - static_cast<double>(seconds)) / kNativePeriod);
  const std::string stamp =
      fmt::format("{:02}:{:02}:{:02}:{:02}:{}S", seconds / 3600 % 24, seconds / 60 % 60,
                  seconds % 60, in_second / kRepeats + 1, in_second % kRepeats);
  Bytes out(stamp.begin(), stamp.end());
  for (const std::uint16_t count : signal_(time)) {
    const int value = std::clamp<int>(count, 1, 255) << 4;
    out.push_back(static_cast<std::uint8_t>(value >> 8));
    out.push_back(static_cast<std::uint8_t>(value));
  }
  out.insert(out.end(), {'\r', '\n', 0});
  return out;
}

GloveEmulator::GloveEmulator(const GloveEmulatorSettings& settings, GloveSignal signal)
    : emulator_(settings, std::make_unique<CyberGloveUnit>(settings.unit, std::move(signal))) {}

}  // namespace handway::device
