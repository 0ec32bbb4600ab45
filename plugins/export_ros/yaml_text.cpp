#include "yaml_text.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <limits>

namespace handway::export_ros {
namespace {

// NOLINTNEXTLINE(misc-no-recursion): messages are a few levels deep
void write_value(YAML::Emitter& out, const Message& message) {
  switch (message.type()) {
    case Message::value_t::object:
      out << YAML::BeginMap;
      for (const auto& [key, value] : message.items()) {
        out << YAML::Key << key << YAML::Value;
        write_value(out, value);
      }
      out << YAML::EndMap;
      return;
    case Message::value_t::array: {
      const bool plain =
          std::ranges::none_of(message, [](const Message& item) { return item.is_structured(); });
      out << (plain ? YAML::Flow : YAML::Block) << YAML::BeginSeq;
      for (const Message& item : message) {
        write_value(out, item);
      }
      out << YAML::EndSeq;
      return;
    }
    case Message::value_t::string:
      out << YAML::DoubleQuoted << message.get<std::string>();
      return;
    case Message::value_t::boolean:
      out << message.get<bool>();
      return;
    case Message::value_t::number_float:
      out << message.get<double>();
      return;
    default:
      out << message.get<std::int64_t>();
  }
}

}  // namespace

std::string to_yaml(const Message& message) {
  YAML::Emitter out;
  out.SetDoublePrecision(std::numeric_limits<double>::max_digits10);
  write_value(out, message);
  return std::string(out.c_str()) + "\n";
}

}  // namespace handway::export_ros
