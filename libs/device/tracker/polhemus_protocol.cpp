#include "polhemus_protocol.h"

#include "handway/device/tracker/fastrak_parser.h"
#include "handway/device/tracker/liberty_parser.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace handway::device {

namespace {

constexpr int kFastrakStations = 4;

FastrakFormat fastrak_format(const PolhemusSettings& settings) {
  FastrakFormat format;
  format.items = settings.ascii ? std::vector<int>{2, 4} : std::vector<int>{2, 11};
  if (settings.button) {
    format.items.push_back(16);
  }
  format.items.push_back(settings.ascii ? 1 : 0);
  format.binary = !settings.ascii;
  return format;
}

LibertyFormat liberty_format(const PolhemusSettings& settings) {
  LibertyFormat format;
  if (settings.button) {
    format.items.push_back(10);
  }
  return format;
}

template <typename Parser>
class ParsedProtocol : public PolhemusProtocol {
 public:
  std::vector<PolhemusRecord> parse(std::span<const std::uint8_t> bytes) override {
    return parser_.push(bytes);
  }
  void reset() override { parser_.reset(); }
  [[nodiscard]] TrackerFaults faults() const override {
    return {parser_.resynchronisations(), parser_.dropped_bytes(), 0};
  }

 protected:
  explicit ParsedProtocol(Parser parser) : parser_(std::move(parser)) {}

 private:
  Parser parser_;
};

class FastrakProtocol final : public ParsedProtocol<FastrakParser> {
 public:
  explicit FastrakProtocol(const PolhemusSettings& settings)
      : ParsedProtocol(FastrakParser(fastrak_format(settings))),
        format_(fastrak_format(settings)) {}

  [[nodiscard]] std::string_view name() const override {
    return format_.binary ? "Polhemus Fastrak, binary" : "Polhemus Fastrak, ASCII";
  }
  // The return ends a command that another program left unfinished.
  [[nodiscard]] std::string stop_command() const override { return "\rc"; }
  [[nodiscard]] std::string probe_command() const override { return "S"; }
  [[nodiscard]] std::vector<std::string> set_up_commands() const override {
    std::vector<std::string> commands{"U"};
    for (int station = 1; station <= kFastrakStations; ++station) {
      commands.push_back(fmt::format("O{},{}\r", station, fmt::join(format_.items, ",")));
    }
    commands.emplace_back(format_.binary ? "f" : "F");
    return commands;
  }
  [[nodiscard]] std::string start_command() const override { return "C"; }

 private:
  FastrakFormat format_;
};

class LibertyProtocol final : public ParsedProtocol<LibertyParser> {
 public:
  explicit LibertyProtocol(const PolhemusSettings& settings)
      : ParsedProtocol(LibertyParser(liberty_format(settings))),
        format_(liberty_format(settings)) {}

  [[nodiscard]] std::string_view name() const override { return "Polhemus Liberty"; }
  // The return ends a command that another program left unfinished.
  [[nodiscard]] std::string stop_command() const override { return "\rPF1\r"; }
  [[nodiscard]] std::string probe_command() const override {
    return "\x15"
           "0\r";
  }
  [[nodiscard]] std::vector<std::string> set_up_commands() const override {
    return {"U0\r", fmt::format("O*,{}\r", fmt::join(format_.items, ",")), "Q0\r"};
  }
  [[nodiscard]] std::string start_command() const override { return "C\r"; }

 private:
  LibertyFormat format_;
};

}  // namespace

std::unique_ptr<PolhemusProtocol> make_polhemus_protocol(const PolhemusSettings& settings) {
  if (settings.model == PolhemusModel::kFastrak) {
    return std::make_unique<FastrakProtocol>(settings);
  }
  if (settings.ascii) {
    throw std::invalid_argument("a Liberty is read in binary only");
  }
  return std::make_unique<LibertyProtocol>(settings);
}

}  // namespace handway::device
