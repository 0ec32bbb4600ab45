#include "handway/sampling/postures/pmd_basis.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/replace_file.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace handway::sampling {

Eigen::MatrixXd axes_of(const PmdBasis& basis) {
  Eigen::MatrixXd E = Eigen::MatrixXd::Zero(basis.mean.size(), basis.dimension());
  Eigen::Index column = 0;
  for (const FreeJoint& free : basis.free_joints) {
    E(free.joint, column++) = 1.0;
  }
  for (const PrincipalDirection& direction : basis.directions) {
    E.col(column++) = direction.vector;
  }
  return E;
}

Eigen::VectorXd half_sides_of(const PmdBasis& basis) {
  Eigen::VectorXd half_sides(basis.dimension());
  const auto directions =
      std::ranges::transform(basis.free_joints, half_sides.begin(), &FreeJoint::half_side).out;
  std::ranges::transform(basis.directions, directions, &PrincipalDirection::half_side);
  return half_sides;
}

Eigen::VectorXd centre_of(const PmdBasis& basis) {
  Eigen::VectorXd b = basis.mean;
  for (const FreeJoint& free : basis.free_joints) {
    b[free.joint] = free.centre;
  }
  return b;
}

Eigen::VectorXd map_to_posture(const PmdBasis& basis, const Eigen::VectorXd& u) {
  if (u.size() > basis.dimension()) {
    throw std::invalid_argument("sample has " + std::to_string(u.size()) +
                                " coordinates, the basis " + std::to_string(basis.dimension()) +
                                " axes");
  }
  const Eigen::MatrixXd axes = axes_of(basis);
  const Eigen::VectorXd half_sides = half_sides_of(basis);
  Eigen::VectorXd posture = centre_of(basis);
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    posture += (2.0 * u[i] - 1.0) * half_sides[i] * axes.col(i);
  }
  return posture.cwiseMax(0.0).cwiseMin(1.0);
}

Eigen::VectorXd project(const PmdBasis& basis, const Eigen::VectorXd& posture) {
  return axes_of(basis).colPivHouseholderQr().solve(posture - centre_of(basis));
}

double distance_to_subspace(const PmdBasis& basis, const Eigen::VectorXd& posture) {
  return PostureSubspace(basis).distance(posture);
}

PmdBasis full_joint_basis(std::string hand, std::vector<std::string> joints) {
  PmdBasis basis;
  basis.hand = std::move(hand);
  basis.source = "every joint over its whole range";
  basis.joints = std::move(joints);
  const auto count = static_cast<Eigen::Index>(basis.joints.size());
  basis.mean = Eigen::VectorXd::Constant(count, 0.5);
  for (int i = 0; i < static_cast<int>(count); ++i) {
    basis.free_joints.push_back({i, 0.5, 0.5});
  }
  return basis;
}

PostureSubspace::PostureSubspace(const PmdBasis& basis) : centre_(centre_of(basis)) {
  // Derived from project(), so that there is one definition.
  const Eigen::MatrixXd E = axes_of(basis);
  across_ = Eigen::MatrixXd::Identity(E.rows(), E.rows());
  for (Eigen::Index column = 0; column < E.rows(); ++column) {
    const Eigen::VectorXd e = project(basis, centre_ + Eigen::VectorXd::Unit(E.rows(), column));
    for (Eigen::Index axis = 0; axis < E.cols(); ++axis) {
      across_.col(column) -= e[axis] * E.col(axis);
    }
  }
}

Eigen::VectorXd PostureSubspace::outside(const Eigen::VectorXd& posture) const {
  return across_ * (posture - centre_);
}

double PostureSubspace::distance(const Eigen::VectorXd& posture) const {
  return outside(posture).norm();
}

Eigen::VectorXd PostureSubspace::closest(const Eigen::VectorXd& posture) const {
  return (posture - outside(posture)).cwiseMax(0.0).cwiseMin(1.0);
}

Eigen::VectorXd principal_angles(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.rows() != b.rows() || a.cols() == 0 || b.cols() == 0) {
    throw std::invalid_argument("principal angles need two bases of the same space");
  }
  const Eigen::MatrixXd& wide = a.cols() >= b.cols() ? a : b;
  const Eigen::MatrixXd& narrow = a.cols() >= b.cols() ? b : a;
  const Eigen::JacobiSVD<Eigen::MatrixXd> shared(wide.transpose() * narrow);
  const Eigen::JacobiSVD<Eigen::MatrixXd> apart(narrow - wide * (wide.transpose() * narrow));
  const Eigen::Index count = narrow.cols();
  Eigen::VectorXd angles(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double cosine = std::clamp(shared.singularValues()[i], 0.0, 1.0);
    const Eigen::Index from_last = count - 1 - i;
    const double sine = from_last < apart.singularValues().size()
                            ? std::clamp(apart.singularValues()[from_last], 0.0, 1.0)
                            : 0.0;
    angles[i] = cosine * cosine < 0.5 ? std::acos(cosine) : std::asin(sine);
  }
  return angles;
}

namespace {

using geometric::YamlElement;

constexpr double kUnitLengthTolerance = 1e-2;  // published vectors have four digits

double half_side(const YamlElement& axis) {
  const YamlElement element = axis.need("half_side");
  const double result = element.number();
  if (result <= 0.0) {
    element.refuse(element.found(), "a number above 0", "Remove an axis that isn't to be sampled");
  }
  return result;
}

std::vector<std::string> joint_names(const YamlElement& list) {
  std::vector<std::string> names;
  for (const YamlElement& item : list.items()) {
    if (std::ranges::count(names, item.text()) > 0) {
      item.refuse(item.found() + " a second time", "every joint once");
    }
    names.push_back(item.text());
  }
  if (names.empty()) {
    list.refuse("no names", "the hand's independent joints");
  }
  return names;
}

FreeJoint free_joint(const YamlElement& axis, const PmdBasis& basis) {
  axis.allow_keys({"joint", "half_side", "centre"});
  const YamlElement joint = axis.need("joint");
  const auto found = std::ranges::find(basis.joints, joint.text());
  if (found == basis.joints.end()) {
    joint.refuse("the unknown joint " + joint.found(),
                 fmt::format("one of {}", fmt::join(basis.joints, ", ")));
  }
  const auto index = static_cast<int>(found - basis.joints.begin());
  if (std::ranges::count(basis.free_joints, index, &FreeJoint::joint) > 0) {
    joint.refuse(joint.found() + " a second time", "every joint once");
  }
  return {index, axis.need("centre").number(), half_side(axis)};
}

PrincipalDirection direction(const YamlElement& axis, int joints) {
  axis.allow_keys({"name", "half_side", "variance", "vector"});
  PrincipalDirection result{axis.need("name").text(), axis.need("vector").numbers(joints),
                            half_side(axis)};
  if (const auto variance = axis.find("variance")) {
    result.variance = variance->number();
    if (result.variance < 0.0) {
      variance->refuse(variance->found(), "0 or more");
    }
  }
  if (const double length = result.vector.norm(); std::abs(length - 1.0) > kUnitLengthTolerance) {
    axis.need("vector").refuse(fmt::format("length {:.4f}", length), "length 1",
                               "Divide the vector by its length and multiply half_side by it");
  }
  return result;
}

std::vector<YamlElement> items_of(const YamlElement& top, const char* key) {
  const auto list = top.find(key);
  return list ? list->items() : std::vector<YamlElement>();
}

std::string shortest(double x) { return fmt::format("{}", x); }

void emit_numbers(YAML::Emitter& out, const Eigen::VectorXd& values) {
  out << YAML::Flow << YAML::BeginSeq;
  for (const double value : values) {
    out << shortest(value);
  }
  out << YAML::EndSeq;
}

// A path as written into a file beside, below or above it.
std::string seen_from(const std::filesystem::path& file, const std::filesystem::path& path) {
  const std::filesystem::path target = std::filesystem::absolute(path).lexically_normal();
  const std::filesystem::path folder =
      std::filesystem::absolute(file).lexically_normal().parent_path();
  const std::filesystem::path relative = target.lexically_relative(folder);
  return (relative.empty() ? target : relative).generic_string();
}

}  // namespace

PmdBasis read_pmd_basis(const std::filesystem::path& file) {
  const YamlElement top = YamlElement::read(file, "a PMD basis");
  top.allow_keys(
      {"hand", "source", "units", "postures", "joints", "mean", "free_joints", "directions"});
  PmdBasis basis;
  basis.hand = top.need("hand").text();
  if (const auto source = top.find("source")) {
    basis.source = source->text();
  }
  if (const YamlElement units = top.need("units"); units.text() != "normalised") {
    units.refuse(units.found(), "normalised", "Scale every joint's range to [0, 1]");
  }
  if (const auto postures = top.find("postures")) {
    basis.postures = std::filesystem::absolute(file).parent_path() / postures->text();
  }
  basis.joints = joint_names(top.need("joints"));
  const auto count = static_cast<int>(basis.joints.size());
  basis.mean = top.need("mean").numbers(count);
  for (const YamlElement& axis : items_of(top, "free_joints")) {
    basis.free_joints.push_back(free_joint(axis, basis));
  }
  for (const YamlElement& axis : items_of(top, "directions")) {
    basis.directions.push_back(direction(axis, count));
  }
  if (basis.dimension() == 0) {
    top.refuse("neither free joints nor directions", "at least one axis");
  }
  return basis;
}

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
