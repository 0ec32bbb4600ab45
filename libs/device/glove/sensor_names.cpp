#include "glove/sensor_names.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <utility>

namespace handway::device {

std::vector<std::string> sensor_names() {
  std::vector<std::string> names;
  for (const GloveSensor& sensor : cyberglove_sensors()) {
    names.emplace_back(sensor.name);
  }
  return names;
}

int named_sensor(const geometric::YamlElement& element, const std::string& name) {
  const std::optional<int> sensor = find_sensor(name);
  if (!sensor) {
    element.refuse('"' + name + '"', "a sensor's name or letter",
                   geometric::advise_name(name, sensor_names()));
  }
  return *sensor;
}

std::vector<std::string> words_of_name(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  std::erase(words, "");
  return words;
}

bool has_word(const std::vector<std::string>& words, std::initializer_list<const char*> any) {
  return std::ranges::any_of(
      words, [&](const std::string& word) { return std::ranges::find(any, word) != any.end(); });
}

namespace {

/// Other programs' names of the sensors, in small letters and digits alone.
const std::map<std::string, int>& other_names() {
  static const std::map<std::string, int> kNames = [] {
    std::map<std::string, int> names;
    const auto add = [&](const char* sensor, std::initializer_list<const char*> parts,
                         std::initializer_list<const char*> others) {
      for (const char* part : parts) {
        for (const char* other : others) {
          names[std::string(part) + other] = *find_sensor(sensor);
          names[std::string(other) + part] = *find_sensor(sensor);
        }
      }
    };
    for (std::size_t sensor = 0; sensor < kGloveSensors; ++sensor) {
      const GloveSensor& about = cyberglove_sensors()[sensor];
      for (const std::string_view name : {about.name, about.label}) {
        std::string joined;
        for (const std::string& word : words_of_name(name)) {
          joined += word;
        }
        names[joined] = static_cast<int>(sensor);
      }
    }
    add("ThumbRotate", {"thumb"}, {"rotation", "tmj", "tm", "cmc", "cmcflexion"});
    add("ThumbMPJ", {"thumb"}, {"mpj", "mcp", "mp", "pip"});
    add("ThumbIJ", {"thumb"}, {"ij", "ip", "dip"});
    add("ThumbAbduct", {"thumb"}, {"abduction", "abd", "ab", "cmcspread", "cmcabduction"});
    add("IndexMPJ", {"index"}, {"mcp", "mp"});
    add("IndexPIJ", {"index"}, {"pip"});
    add("IndexDIJ", {"index"}, {"dip"});
    add("MiddleMPJ", {"middle"}, {"mcp", "mp"});
    add("MiddlePIJ", {"middle"}, {"pip"});
    add("MiddleDIJ", {"middle"}, {"dip"});
    add("RingMPJ", {"ring"}, {"mcp", "mp"});
    add("RingPIJ", {"ring"}, {"pip"});
    add("RingDIJ", {"ring"}, {"dip"});
    add("PinkieMPJ", {"pinkie", "pinky", "little", "small"}, {"mpj", "mcp", "mp"});
    add("PinkiePIJ", {"pinkie", "pinky", "little", "small"}, {"pij", "pip"});
    add("PinkieDIJ", {"pinkie", "pinky", "little", "small"}, {"dij", "dip"});
    add("MiddleIndexAbduct", {"middleindex", "indexmiddle"}, {"abduct", "abduction", "abd", "ab"});
    add("RingMiddleAbduct", {"ringmiddle", "middlering"}, {"abduct", "abduction", "abd", "ab"});
    add("PinkieRingAbduct", {"pinkiering", "ringpinkie", "pinkyring", "ringpinky", "littlering"},
        {"abduct", "abduction", "abd", "ab"});
    add("PalmArch", {"palm"}, {"", "arch"});
    add("WristPitch", {"wrist"}, {"flexion", "flex", "pitch"});
    add("WristYaw", {"wrist"}, {"abduction", "abd", "yaw", "deviation"});
    // KIN-MUS and BE-UJI number the fingers from the thumb: "MCP2_F", "MCP2-3_A".
    for (const auto& [name, sensor] :
         std::initializer_list<std::pair<const char*, const char*>>{{"cmc1f", "ThumbRotate"},
                                                                    {"cmc1a", "ThumbAbduct"},
                                                                    {"mcp1f", "ThumbMPJ"},
                                                                    {"ip1f", "ThumbIJ"},
                                                                    {"mcp2f", "IndexMPJ"},
                                                                    {"pip2f", "IndexPIJ"},
                                                                    {"mcp3f", "MiddleMPJ"},
                                                                    {"pip3f", "MiddlePIJ"},
                                                                    {"mcp4f", "RingMPJ"},
                                                                    {"pip4f", "RingPIJ"},
                                                                    {"mcp5f", "PinkieMPJ"},
                                                                    {"pip5f", "PinkiePIJ"},
                                                                    {"mcp23a", "MiddleIndexAbduct"},
                                                                    {"mcp34a", "RingMiddleAbduct"},
                                                                    {"mcp45a", "PinkieRingAbduct"},
                                                                    {"cmc5f", "PalmArch"},
                                                                    {"wf", "WristPitch"},
                                                                    {"wa", "WristYaw"}}) {
      names[name] = *find_sensor(sensor);
    }
    return names;
  }();
  return kNames;
}

}  // namespace

std::optional<int> sensor_by_any_name(const std::string& name) {
  if (const std::optional<int> exact = find_sensor(name)) {
    return exact;
  }
  std::string joined;
  std::string plain;  // the joint alone, where bending goes without saying
  for (const std::string& word : words_of_name(name)) {
    if (!has_word({word}, {"g", "deg", "degree", "degrees", "rad", "raw", "counts", "angle",
                           "joint", "right", "left", "hand", "rh", "lh"})) {
      joined += word;
      plain += has_word({word}, {"flex", "flexion", "bend", "stretch"}) ? "" : word;
    }
  }
  for (const std::string& known : {joined, plain}) {
    if (const auto found = other_names().find(known); found != other_names().end()) {
      return found->second;
    }
  }
  return std::nullopt;
}

}  // namespace handway::device
