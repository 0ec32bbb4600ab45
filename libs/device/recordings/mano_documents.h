#pragma once

#include "recordings/mano_recording.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace handway::device {

/// Finds postures of MANO in JSON: 45 or 48 numbers, in any nesting, under a key of
/// is_mano_name(), one or a list of them. Times are values of keys with such a name beside or
/// around them.
class ManoFinder {
 public:
  void look_at(const nlohmann::ordered_json& value);

  [[nodiscard]] bool has_found() const { return !hands_.empty(); }
  /// Makes a recording of the hand that comes first. @pre has_found()
  /// @throws InputError as recording_of_mano().
  [[nodiscard]] Recording recording(const std::filesystem::path& file) const;

 private:
  using Json = nlohmann::ordered_json;
  struct Hand {
    ManoSide side;
    std::vector<ManoFrame> frames;
  };
  /// Place in a document.
  struct Place {
    std::string keys;  ///< Keys above, with slashes between them.
    std::optional<double> time;
    int depth = 0;
  };

  void look_at(const Json& value, const Place& place);
  void look_into(const Json& object, const Place& place);
  [[nodiscard]] bool take(const Json& value, const Place& place, const Json& object);
  void add(const std::vector<double>& numbers, const std::string& keys, std::optional<double> time);

  std::vector<Hand> hands_;
  bool all_units_are_named_ = true;
};

}  // namespace handway::device
