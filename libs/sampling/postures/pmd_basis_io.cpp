#include "handway/sampling/postures/pmd_basis_io.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace handway::sampling {
namespace {

using geometric::InputError;

constexpr double kUnitLengthTolerance = 1e-2;  // published vectors have four digits

// Reads the parts of one file and knows what to say about wrong ones.
class BasisReader {
 public:
  explicit BasisReader(const std::filesystem::path& file) : file_(file) {}

  [[nodiscard]] PmdBasis read() const {
    const YAML::Node root = load();
    check_keys(
        root, "",
        {"hand", "source", "units", "postures", "joints", "mean", "free_joints", "directions"});
    PmdBasis basis;
    basis.hand = text(root, "", "hand");
    basis.source = root["source"] ? text(root, "", "source") : "";
    if (const std::string units = text(root, "", "units"); units != "normalised") {
      fail(root["units"], "units", '"' + units + '"', "normalised",
           "Scale every joint's range to [0, 1]");
    }
    if (root["postures"]) {
      basis.postures = std::filesystem::absolute(file_).parent_path() / text(root, "", "postures");
    }
    basis.joints = joint_names(root);
    basis.mean = numbers(root, "", "mean", basis.joints.size());
    for_each(root, "free_joints", [&](const YAML::Node& node, const std::string& element) {
      basis.free_joints.push_back(free_joint(node, element, basis));
    });
    for_each(root, "directions", [&](const YAML::Node& node, const std::string& element) {
      basis.directions.push_back(direction(node, element, basis));
    });
    if (basis.dimension() == 0) {
      fail(root, "directions", "neither free joints nor directions", "at least one axis", "");
    }
    return basis;
  }

 private:
  [[noreturn]] void fail(const YAML::Node& node, const std::string& element,
                         const std::string& found, const std::string& expected,
                         const std::string& advice) const {
    const YAML::Mark mark = node.Mark();
    std::string source = file_.string();
    if (!mark.is_null()) {
      source += ':' + std::to_string(mark.line + 1);
    }
    throw InputError({source, element, found, expected, advice});
  }

  [[nodiscard]] YAML::Node load() const {
    const YAML::Node root = YAML::Load(geometric::read_yaml_text(file_, "a PMD basis"));
    if (!root.IsMap()) {
      fail(root, "", "no keys", "a PMD basis with the keys hand, units, joints and mean", "");
    }
    return root;
  }

  void check_keys(const YAML::Node& map, const std::string& element,
                  std::initializer_list<std::string_view> known) const {
    if (!map.IsMap()) {
      fail(map, element, "no keys", fmt::format("the keys {}", fmt::join(known, ", ")), "");
    }
    for (const auto& entry : map) {
      const std::string& key = entry.first.Scalar();
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        fail(entry.first, element, "unknown key \"" + key + '"',
             fmt::format("one of {}", fmt::join(known, ", ")), "");
      }
    }
  }

  // The value of a key that must be there.
  [[nodiscard]] YAML::Node value(const YAML::Node& map, const std::string& element,
                                 const char* key) const {
    YAML::Node node = map[key];
    if (!node) {
      fail(map, element, fmt::format("no key \"{}\"", key), "it", "");
    }
    return node;
  }

  [[nodiscard]] std::string text(const YAML::Node& map, const std::string& element,
                                 const char* key) const {
    const YAML::Node node = value(map, element, key);
    if (!node.IsScalar()) {
      fail(node, within(element, key), "a list or map", "text", "");
    }
    return node.Scalar();
  }

  [[nodiscard]] double number(const YAML::Node& node, const std::string& element) const {
    double result = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, result)) {
      fail(node, element, node.IsScalar() ? '"' + node.Scalar() + '"' : "a list or map", "a number",
           "");
    }
    if (!std::isfinite(result)) {
      fail(node, element, node.Scalar(), "a finite number", "");
    }
    return result;
  }

  [[nodiscard]] Eigen::VectorXd numbers(const YAML::Node& map, const std::string& element,
                                        const char* key, std::size_t count) const {
    const YAML::Node node = value(map, element, key);
    const std::string name = within(element, key);
    if (!node.IsSequence()) {
      fail(node, name, "no list", fmt::format("a list of {} numbers", count), "");
    }
    if (node.size() != count) {
      fail(node, name, fmt::format("{} numbers", node.size()),
           fmt::format("{}, one per joint", count), "Follow the order of the key joints");
    }
    Eigen::VectorXd result(static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i) {
      result[static_cast<Eigen::Index>(i)] = number(node[i], fmt::format("{}[{}]", name, i));
    }
    return result;
  }

  [[nodiscard]] double half_side(const YAML::Node& map, const std::string& element) const {
    const YAML::Node node = value(map, element, "half_side");
    const double result = number(node, within(element, "half_side"));
    if (result <= 0.0) {
      fail(node, within(element, "half_side"), node.Scalar(), "a number above 0",
           "Remove an axis that isn't to be sampled");
    }
    return result;
  }

  [[nodiscard]] std::vector<std::string> joint_names(const YAML::Node& root) const {
    const YAML::Node node = value(root, "", "joints");
    if (!node.IsSequence() || node.size() == 0) {
      fail(node, "joints", "no list of names", "the hand's independent joints", "");
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string element = fmt::format("joints[{}]", i);
      if (!node[i].IsScalar()) {
        fail(node[i], element, "a list or map", "a joint's name", "");
      }
      const std::string& name = node[i].Scalar();
      if (std::find(names.begin(), names.end(), name) != names.end()) {
        fail(node[i], element, '"' + name + "\" a second time", "every joint once", "");
      }
      names.push_back(name);
    }
    return names;
  }

  template <typename Read>
  void for_each(const YAML::Node& root, const char* key, const Read& read_one) const {
    const YAML::Node list = root[key];
    if (!list || list.IsNull()) {
      return;
    }
    if (!list.IsSequence()) {
      fail(list, key, "no list", "a list", "");
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      read_one(list[i], fmt::format("{}[{}]", key, i));
    }
  }

  [[nodiscard]] FreeJoint free_joint(const YAML::Node& node, const std::string& element,
                                     const PmdBasis& basis) const {
    check_keys(node, element, {"joint", "half_side", "centre"});
    const std::string name = text(node, element, "joint");
    const auto found = std::find(basis.joints.begin(), basis.joints.end(), name);
    if (found == basis.joints.end()) {
      fail(node["joint"], within(element, "joint"), "unknown joint \"" + name + '"',
           fmt::format("one of {}", fmt::join(basis.joints, ", ")), "");
    }
    FreeJoint result;
    result.joint = static_cast<int>(found - basis.joints.begin());
    for (const FreeJoint& other : basis.free_joints) {
      if (other.joint == result.joint) {
        fail(node["joint"], within(element, "joint"), '"' + name + "\" a second time",
             "every joint once", "");
      }
    }
    result.half_side = half_side(node, element);
    result.centre = number(value(node, element, "centre"), within(element, "centre"));
    return result;
  }

  [[nodiscard]] PrincipalDirection direction(const YAML::Node& node, const std::string& element,
                                             const PmdBasis& basis) const {
    check_keys(node, element, {"name", "half_side", "variance", "vector"});
    PrincipalDirection result;
    result.name = text(node, element, "name");
    result.half_side = half_side(node, element);
    if (const YAML::Node variance = node["variance"]) {
      result.variance = number(variance, within(element, "variance"));
      if (result.variance < 0.0) {
        fail(variance, within(element, "variance"), variance.Scalar(), "0 or more", "");
      }
    }
    result.vector = numbers(node, element, "vector", basis.joints.size());
    if (const double length = result.vector.norm(); std::abs(length - 1.0) > kUnitLengthTolerance) {
      fail(node["vector"], within(element, "vector"), fmt::format("length {:.4f}", length),
           "length 1", "Divide the vector by its length and multiply half_side by it");
    }
    return result;
  }

  static std::string within(const std::string& element, const char* key) {
    return element.empty() ? key : element + '.' + key;
  }

  std::filesystem::path file_;
};

std::string shortest(double x) { return fmt::format("{}", x); }

void emit_numbers(YAML::Emitter& out, const Eigen::VectorXd& values) {
  out << YAML::Flow << YAML::BeginSeq;
  for (const double value : values) {
    out << shortest(value);
  }
  out << YAML::EndSeq;
}

// A path as it's written into a file beside, below or above it.
std::string seen_from(const std::filesystem::path& file, const std::filesystem::path& path) {
  const std::filesystem::path target = std::filesystem::absolute(path).lexically_normal();
  const std::filesystem::path folder =
      std::filesystem::absolute(file).lexically_normal().parent_path();
  const std::filesystem::path relative = target.lexically_relative(folder);
  return (relative.empty() ? target : relative).generic_string();
}

}  // namespace

PmdBasis read_pmd_basis(const std::filesystem::path& file) { return BasisReader(file).read(); }

void write_pmd_basis(const PmdBasis& basis, const std::filesystem::path& file) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  out << YAML::Key << "hand" << YAML::Value << basis.hand;
  out << YAML::Key << "source" << YAML::Value << YAML::DoubleQuoted << basis.source;
  out << YAML::Key << "units" << YAML::Value << "normalised";
  if (!basis.postures.empty()) {
    out << YAML::Key << "postures" << YAML::Value << YAML::DoubleQuoted
        << seen_from(file, basis.postures);
  }
  out << YAML::Key << "joints" << YAML::Value << YAML::Flow << basis.joints;
  out << YAML::Key << "mean" << YAML::Value;
  emit_numbers(out, basis.mean);
  if (!basis.free_joints.empty()) {
    out << YAML::Key << "free_joints" << YAML::Value << YAML::BeginSeq;
    for (const FreeJoint& free : basis.free_joints) {
      out << YAML::Flow << YAML::BeginMap;
      out << YAML::Key << "joint" << YAML::Value
          << basis.joints.at(static_cast<std::size_t>(free.joint));
      out << YAML::Key << "half_side" << YAML::Value << shortest(free.half_side);
      out << YAML::Key << "centre" << YAML::Value << shortest(free.centre);
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  }
  if (!basis.directions.empty()) {
    out << YAML::Key << "directions" << YAML::Value << YAML::BeginSeq;
    for (const PrincipalDirection& direction : basis.directions) {
      const double norm = direction.vector.norm();
      const double length = std::abs(norm - 1.0) > kUnitLengthTolerance ? norm : 1.0;
      out << YAML::BeginMap;
      out << YAML::Key << "name" << YAML::Value << direction.name;
      out << YAML::Key << "half_side" << YAML::Value << shortest(direction.half_side * length);
      if (direction.variance != 0.0) {
        out << YAML::Key << "variance" << YAML::Value
            << shortest(direction.variance * length * length);
      }
      out << YAML::Key << "vector" << YAML::Value;
      emit_numbers(out, direction.vector / length);
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  }
  out << YAML::EndMap;
  geometric::replace_file(file, std::string(out.c_str()) + '\n');
}

}  // namespace handway::sampling
