#include "glove/cyberglove_protocol.h"

#include "core/links.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>

namespace handway::device {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr int kTries = 3;
constexpr double kBaseRate = 115200.0;
// Long enough for a unit to finish its present record.
constexpr milliseconds kQuiet{100};
constexpr milliseconds kAnswerSlice{50};
// Bytes that may precede an answer: records of a stream that is ending.
constexpr std::size_t kLongestAnswer = 4096;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

std::optional<CyberGloveReply> find_reply(std::span<const std::uint8_t> bytes,
                                          std::span<const std::uint8_t> echo,
                                          std::size_t data_length) {
  for (auto from = bytes.begin();;) {
    const auto at = std::search(from, bytes.end(), echo.begin(), echo.end());
    if (at == bytes.end()) {
      return std::nullopt;
    }
    const auto rest = bytes.subspan(static_cast<std::size_t>(at - bytes.begin()) + echo.size());
    if (rest.size() >= 3 && rest[0] == 'e' && rest[2] == 0) {
      return CyberGloveReply{{}, static_cast<char>(rest[1])};
    }
    if (rest.size() > data_length && rest[data_length] == 0) {
      return CyberGloveReply{
          {rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(data_length)}};
    }
    from = at + 1;
  }
}

std::array<std::uint8_t, 4> sampling_words(double rate) {
  const auto product = static_cast<std::uint32_t>(std::lround(kBaseRate / rate));
  const std::uint32_t second = product / 65536 + 1;
  const std::uint32_t first = (product + second / 2) / second;
  return {static_cast<std::uint8_t>(first >> 8U), static_cast<std::uint8_t>(first),
          static_cast<std::uint8_t>(second >> 8U), static_cast<std::uint8_t>(second)};
}

void CyberGloveCommands::stop_stream(const std::stop_token& stop) {
  const std::uint8_t control_c = 0x03;
  link_.write({&control_c, 1});
  drain(kQuiet, timeout_, stop);
}

std::optional<CyberGloveReply> CyberGloveCommands::query(char letter, std::size_t data_length,
                                                         const std::stop_token& stop) {
  const std::array<std::uint8_t, 2> command{'?', static_cast<std::uint8_t>(letter)};
  return ask(command, command, data_length, stop);
}

std::optional<CyberGloveReply> CyberGloveCommands::set(char letter,
                                                       std::span<const std::uint8_t> arguments,
                                                       const std::stop_token& stop) {
  std::vector<std::uint8_t> command{static_cast<std::uint8_t>(letter)};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return ask(command, std::span(command).first(1), 0, stop);
}

std::optional<CyberGloveReply> CyberGloveCommands::ask(std::span<const std::uint8_t> command,
                                                       std::span<const std::uint8_t> echo,
                                                       std::size_t data_length,
                                                       const std::stop_token& stop) {
  for (int tries = 0; tries < kTries && !stop.stop_requested(); ++tries) {
    std::vector<std::uint8_t> answer;
    const auto begin = Clock::now();
    link_.write(command);
    while (Clock::now() - begin < timeout_ / kTries && !stop.stop_requested()) {
      std::optional<CyberGloveReply> reply;
      static_cast<void>(read_turn(link_, kAnswerSlice, [&](std::span<const std::uint8_t> bytes) {
        if (reply) {
          return;
        }
        answer.insert(answer.end(), bytes.begin(), bytes.end());
        reply = find_reply(answer, echo, data_length);
        if (answer.size() > kLongestAnswer) {
          answer.erase(answer.begin(), answer.end() - kLongestAnswer);
        }
      }));
      if (reply) {
        const double took = seconds(Clock::now() - begin);
        round_trip_ = round_trip_ == 0.0 ? took : std::min(round_trip_, took);
        return reply;
      }
    }
  }
  return std::nullopt;
}

void CyberGloveCommands::drain(milliseconds quiet, milliseconds at_most,
                               const std::stop_token& stop) {
  std::array<std::uint8_t, 256> chunk{};
  const auto begin = Clock::now();
  auto last = begin;
  while (Clock::now() - last < quiet && Clock::now() - begin < at_most && !stop.stop_requested()) {
    if (link_.read(chunk, quiet) > 0) {
      last = Clock::now();
    }
  }
}

namespace {

// The sampling period is given in words of two bytes.
bool takes_words(char letter) { return letter == 'T'; }

bool append_number(std::string_view text, bool word, std::vector<std::uint8_t>& out) {
  unsigned value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || value > (word ? 65535U : 255U)) {
    return false;
  }
  if (word) {
    out.push_back(static_cast<std::uint8_t>(value >> 8U));
  }
  out.push_back(static_cast<std::uint8_t>(value));
  return true;
}

}  // namespace

std::optional<TextCommand> read_text_command(std::span<const std::uint8_t> line) {
  const std::string text(line.begin(), line.end());
  TextCommand command;
  std::size_t at = 0;
  if (text.starts_with('?')) {
    command.query = true;
    ++at;
  }
  if (at >= text.size() || std::islower(static_cast<unsigned char>(text[at])) == 0) {
    return std::nullopt;
  }
  command.letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text[at])));
  ++at;
  while ((at = text.find_first_not_of(" \r\n", at)) != std::string::npos) {
    const std::size_t end = std::min(text.find_first_of(" \r\n", at), text.size());
    if (!append_number(std::string_view(text).substr(at, end - at), takes_words(command.letter),
                       command.arguments)) {
      return std::nullopt;
    }
    at = end;
  }
  return command;
}

std::vector<std::uint8_t> text_line(std::string_view line) {
  std::vector<std::uint8_t> out(line.begin(), line.end());
  out.push_back('\r');
  out.push_back('\n');
  return out;
}

std::vector<std::uint8_t> text_refusal(std::string_view code) { return text_line(code); }

std::vector<std::uint8_t> text_answer(char before, char letter,
                                      std::span<const std::uint8_t> values) {
  std::string text;
  if (before != 0) {
    text += before;
  }
  text += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const std::uint8_t value : values) {
    text += ' ' + std::to_string(value);
  }
  return text_line(text);
}

}  // namespace handway::device
