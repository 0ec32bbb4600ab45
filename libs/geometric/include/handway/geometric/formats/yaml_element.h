#pragma once

#include "handway/geometric/export.h"

#include <Eigen/Core>

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {

/// A part of a YAML file that knows its name and line, for precise messages about errors in it.
/// Cheap to copy; not for several threads at once.
///
/// All functions throw InputError naming file, line and element if the part has another
/// type.
class HANDWAY_GEOMETRIC_EXPORT YamlElement {
 public:
  /// The top of a file with one YAML document.
  /// @param what expected kind of the file, for messages: "a scene file".
  [[nodiscard]] static YamlElement read(const std::filesystem::path& file, const std::string& what);
  /// The top of a text without a file. @param source its origin, for messages.
  [[nodiscard]] static YamlElement parse(const std::string& text, const std::string& source,
                                         const std::string& what);

  /// Path from the top, for example "objects[2].pose.xyz"; empty for the top.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// "FILE:LINE".
  [[nodiscard]] std::string where() const;
  [[noreturn]] void refuse(const std::string& found, const std::string& expected,
                           const std::string& advice = "") const;
  /// Describes the value in short: `"abc"`, `a list of 3`, `nothing`, …
  [[nodiscard]] std::string found() const;

  [[nodiscard]] bool is_map() const;
  [[nodiscard]] bool is_list() const;
  [[nodiscard]] bool is_scalar() const;

  /// Checks that this is a map in which every key is known and occurs once;
  /// advises the nearest known key.
  void allow_keys(std::initializer_list<std::string> known) const;
  /// Checks that no key of this map is misspelt: neither a known one nor within two letters of one.
  /// Other keys are allowed. For third-party formats.
  void refuse_slips(std::initializer_list<std::string> known) const;
  /// The value of a key; nothing if the key is absent or its value empty.
  [[nodiscard]] std::optional<YamlElement> find(const std::string& key) const;
  [[nodiscard]] YamlElement need(const std::string& key) const;
  /// Returns the text under a key, or `otherwise` if the key is absent or its value empty.
  [[nodiscard]] std::string text_or(const std::string& key, const std::string& otherwise) const;
  [[nodiscard]] bool flag_or(const std::string& key, bool otherwise) const;
  [[nodiscard]] double number_or(const std::string& key, double otherwise) const;
  /// @param otherwise shape as numbers().
  [[nodiscard]] Eigen::VectorXd numbers_or(const std::string& key,
                                           const Eigen::VectorXd& otherwise) const;
  /// The items of the list under a key; none if the key is absent or its value empty.
  [[nodiscard]] std::vector<YamlElement> items_of(const std::string& key) const;
  /// Keys and values of a map in file order; keys are text and occur once.
  [[nodiscard]] std::vector<std::pair<std::string, YamlElement>> entries() const;
  [[nodiscard]] std::vector<YamlElement> items() const;

  [[nodiscard]] std::string text() const;
  /// Reads the words `true` and `false`, and those that YAML 1.1 and Python have for them (`True`,
  /// `yes`, `off`).
  [[nodiscard]] bool flag() const;
  /// Finite and within ±10⁶ (metres, radians: larger numbers are in wrong units).
  [[nodiscard]] double number() const;
  /// A list of `count` numbers, shape [count].
  [[nodiscard]] Eigen::VectorXd numbers(int count) const;

 private:
  struct Document;
  struct Node;

  YamlElement(std::shared_ptr<const Document> document, std::shared_ptr<const Node> node,
              std::string name);
  // Refuses a map's key, as refuse(), at the key's position: its value may be lines further down.
  [[noreturn]] void refuse_key(const std::string& key, const std::string& found,
                               const std::string& expected, const std::string& advice) const;
  [[nodiscard]] YamlElement child(const Node& node, const std::string& suffix) const;

  std::shared_ptr<const Document> document_;
  std::shared_ptr<const Node> node_;
  std::string name_;
};

/// The text of a YAML file of one document that can be parsed: at most 16 MB, a million elements
/// and 500 levels, with the targets of aliases counted once for each alias.
/// @param what expected kind of the file, for messages: "a scene file".
/// @throws InputError as read_text_file(); if it is not YAML, has more or fewer documents than one,
/// exceeds a limit, or has an alias within its own target.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string read_yaml_text(const std::filesystem::path& file,
                                                                  const std::string& what);

}  // namespace handway::geometric
