#include "recordings/topic_rows.h"

#include "recordings/message_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace handway::device {
namespace {

constexpr double kNotReceived = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostJoints = 10000;
constexpr std::size_t kLandmarkPoses = 21;

/// Rows of joints by name: a joint that is missing in a message keeps its value.
class JointRows : public TopicRows {
 public:
  explicit JointRows(MessageEncoding encoding) : encoding_(encoding) {}
  [[nodiscard]] std::vector<std::size_t> row_shape() const final { return {names_.size()}; }
  [[nodiscard]] std::size_t row_count() const final { return rows_.size(); }
  [[nodiscard]] std::vector<std::string> names() const final { return names_; }
  [[nodiscard]] Series series() const final {
    Series series;
    series.times = times_;
    series.time_unit.seconds = 1.0;
    const auto columns = static_cast<Eigen::Index>(names_.size());
    series.values.setConstant(std::ssize(rows_), columns, kNotReceived);
    for (Eigen::Index row = 0; row < series.values.rows(); ++row) {
      if (row > 0) {
        series.values.row(row) = series.values.row(row - 1);
      }
      for (const auto& [joint, value] : rows_[static_cast<std::size_t>(row)]) {
        series.values(row, static_cast<Eigen::Index>(joint)) = value;
      }
    }
    if (left_out_ > 0) {
      series.warnings.push_back(fmt::format(
          "{} messages left out: they have no positions, or not one for each name", left_out_));
    }
    return series;
  }

 protected:
  MessageEncoding encoding_;

  void add_row(const std::vector<std::string>& names, const std::vector<double>& positions,
               double time) {
    if (positions.empty() || names.size() != positions.size()) {
      ++left_out_;
      return;
    }
    std::vector<std::pair<std::size_t, double>> row;
    for (std::size_t i = 0; i < names.size(); ++i) {
      row.emplace_back(column_of_joint(names[i], i), positions[i]);
    }
    numbers_ += names_.size();
    if (numbers_ + row.size() > kMostNumbers) {
      throw MessageError("more numbers than can be read");
    }
    rows_.push_back(std::move(row));
    times_.push_back(time);
  }

 private:
  // Most messages have the same names in the same order.
  std::size_t column_of_joint(const std::string& name, std::size_t guess) {
    if (guess < names_.size() && names_[guess] == name) {
      return guess;
    }
    const auto known = std::ranges::find(names_, name);
    if (known == names_.end()) {
      if (names_.size() == kMostJoints) {
        throw MessageError("more than 10000 names of joints");
      }
      names_.push_back(name);
      return names_.size() - 1;
    }
    return static_cast<std::size_t>(known - names_.begin());
  }

  std::vector<std::string> names_;
  std::vector<std::vector<std::pair<std::size_t, double>>> rows_;
  std::vector<double> times_;
  std::size_t numbers_ = 0;
  std::size_t left_out_ = 0;
};

class JointStates final : public JointRows {
 public:
  using JointRows::JointRows;

  void add(std::string_view bytes, double received) override {
    MessageReader message(bytes, encoding_);
    const std::optional<double> stamp = message.stamp();
    const std::vector<std::string> names = message.texts();
    add_row(names, message.float64s(), stamp.value_or(received));
  }
};

class JointTrajectories final : public JointRows {
 public:
  using JointRows::JointRows;

  void add(std::string_view bytes, double received) override {
    MessageReader message(bytes, encoding_);
    const double begin = message.stamp().value_or(received);
    const std::vector<std::string> names = message.texts();
    constexpr std::size_t kLeast = 24;  // four empty sequences and a duration
    for (std::size_t points = message.count(kLeast); points > 0; --points) {
      const std::vector<double> positions = message.float64s();
      for (int other = 0; other < 3; ++other) {  // velocities, accelerations, efforts
        static_cast<void>(message.float64s());
      }
      add_row(names, positions, begin + message.seconds());
    }
  }
};

/// Poses by the names of their frames, as columns NAME.x to NAME.qw.
class PoseRows : public JointRows {
 public:
  using JointRows::JointRows;

 protected:
  /// Reads a point and a quaternion.
  static void read_pose(MessageReader& message, const std::string& name,
                        std::vector<std::string>& names, std::vector<double>& values) {
    for (const char* part : {"x", "y", "z", "qx", "qy", "qz", "qw"}) {
      names.push_back(fmt::format("{}.{}", name, part));
      values.push_back(message.float64());
    }
  }
};

/// Reads geometry_msgs/PoseStamped, and geometry_msgs/TransformStamped behind its frame's name.
class StampedPoses final : public PoseRows {
 public:
  StampedPoses(MessageEncoding encoding, std::string_view topic, bool names_frame)
      : PoseRows(encoding),
        name_(topic.substr(std::min(topic.find_first_not_of('/'), topic.size()))),
        names_frame_(names_frame) {}

  void add(std::string_view bytes, double received) override {
    MessageReader message(bytes, encoding_);
    const double time = message.stamp().value_or(received);
    std::vector<std::string> names;
    std::vector<double> values;
    const std::string name = names_frame_ ? message.text() : name_;
    read_pose(message, name, names, values);
    add_row(names, values, time);
  }

 private:
  std::string name_;
  bool names_frame_;
};

class Transforms final : public PoseRows {
 public:
  using PoseRows::PoseRows;

  void add(std::string_view bytes, double received) override {
    MessageReader message(bytes, encoding_);
    std::vector<std::string> names;
    std::vector<double> values;
    std::optional<double> time;
    constexpr std::size_t kLeast = 72;  // a stamp, two empty names and seven numbers
    const std::size_t transforms = message.count(kLeast);
    for (std::size_t i = 0; i < transforms; ++i) {
      const std::optional<double> stamp = message.stamp();
      time = time ? time : stamp;
      const std::string child = message.text();
      read_pose(message, child, names, values);
    }
    if (transforms > 0) {
      add_row(names, values, time.value_or(received));
    }
  }
};

/// Positions of the landmarks of a hand. Frames with other numbers of points are without a hand.
class LandmarkRows : public TopicRows {
 public:
  using Points = std::vector<double>;  ///< x, y and z of each.

  explicit LandmarkRows(MessageEncoding encoding) : encoding_(encoding) {}

  [[nodiscard]] std::vector<std::size_t> row_shape() const final {
    return {has_hands_ ? kLandmarkPoses : other_, 3};
  }
  [[nodiscard]] std::size_t row_count() const final { return times_.size(); }
  [[nodiscard]] Series series() const final {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Series series;
    series.times = times_;
    series.time_unit.seconds = 1.0;
    series.values = Eigen::Map<const RowMajor>(positions_.data(), std::ssize(times_),
                                               Eigen::Index{3 * kLandmarkPoses});
    return series;
  }

 protected:
  MessageEncoding encoding_;

  void add_frame(const Points& points, double time) {
    const std::size_t count = points.size() / 3;
    const bool is_hand = count == kLandmarkPoses;
    times_.push_back(time);
    other_ = count == 0 || is_hand ? other_ : count;
    has_hands_ = has_hands_ || is_hand;
    if (is_hand) {
      positions_.insert(positions_.end(), points.begin(), points.end());
    } else {
      positions_.resize(positions_.size() + 3 * kLandmarkPoses, kNotReceived);
    }
    if (positions_.size() > kMostNumbers) {
      throw MessageError("more numbers than can be read");
    }
  }

 private:
  std::vector<double> times_;
  std::vector<double> positions_;
  std::size_t other_ = 0;
  bool has_hands_ = false;
};

void read_point(MessageReader& message, std::vector<double>& points) {
  for (int axis = 0; axis < 3; ++axis) {
    points.push_back(message.float64());
  }
}

void skip_quaternion(MessageReader& message) {
  for (int i = 0; i < 4; ++i) {
    static_cast<void>(message.float64());
  }
}

class PoseArrays final : public LandmarkRows {
 public:
  using LandmarkRows::LandmarkRows;

  void add(std::string_view bytes, double received) override {
    MessageReader message(bytes, encoding_);
    const std::optional<double> stamp = message.stamp();
    constexpr std::size_t kNumbers = 7;  // a point and a quaternion
    Points points;
    for (std::size_t poses = message.count(kNumbers * sizeof(double)); poses > 0; --poses) {
      read_point(message, points);
      skip_quaternion(message);
    }
    add_frame(points, stamp.value_or(received));
  }
};

/// Fields of markers, which have grown with ROS 2 Humble.
enum class MarkerLayout { kOld, kHumble };

/// A marker of visualization_msgs.
struct Marker {
  std::optional<double> stamp;
  std::string space;
  std::int32_t type = 0;
  std::int32_t action = 0;
  std::vector<double> position;
  std::vector<double> points;  ///< In the marker's frame.
};

Marker read_marker(MessageReader& message, MarkerLayout layout) {
  Marker marker;
  marker.stamp = message.stamp();
  marker.space = message.text();
  static_cast<void>(message.int32());  // its number
  marker.type = message.int32();
  marker.action = message.int32();
  read_point(message, marker.position);
  skip_quaternion(message);
  std::vector<double> scale;
  read_point(message, scale);
  message.skip(4 * sizeof(float));  // its color
  static_cast<void>(message.seconds());
  message.skip(1);  // whether its frame is locked
  for (std::size_t count = message.count(3 * sizeof(double)); count > 0; --count) {
    read_point(message, marker.points);
  }
  message.skip_sequence(4 * sizeof(float));  // colors
  if (layout == MarkerLayout::kHumble) {
    static_cast<void>(message.text());
    static_cast<void>(message.stamp());
    static_cast<void>(message.text());
    message.skip_sequence(1);
    message.skip_sequence(2 * sizeof(float));
  }
  static_cast<void>(message.text());
  static_cast<void>(message.text());
  if (layout == MarkerLayout::kHumble) {
    static_cast<void>(message.text());
    message.skip_sequence(1);
  }
  message.skip(1);
  return marker;
}

std::vector<Marker> read_markers(std::string_view bytes, MessageEncoding encoding,
                                 MarkerLayout layout) {
  constexpr std::size_t kLeast = 128;  // bytes of a marker, at least
  MessageReader message(bytes, encoding);
  std::vector<Marker> markers;
  for (std::size_t count = message.count(kLeast); count > 0; --count) {
    markers.push_back(read_marker(message, layout));
  }
  if (!message.is_at_end()) {
    throw MessageError("bytes behind its markers");
  }
  return markers;
}

std::vector<Marker> markers_in(std::string_view bytes, MessageEncoding encoding) {
  if (encoding == MessageEncoding::kCdr) {
    try {
      return read_markers(bytes, encoding, MarkerLayout::kHumble);
    } catch (const MessageError&) {
      return read_markers(bytes, encoding, MarkerLayout::kOld);
    }
  }
  return read_markers(bytes, encoding, MarkerLayout::kOld);
}

/// Landmarks in markers: the first 21 spheres of one namespace, or the first marker of 21 points.
class MarkerArrays final : public LandmarkRows {
 public:
  using LandmarkRows::LandmarkRows;

  void add(std::string_view bytes, double received) override {
    const std::vector<Marker> markers = markers_in(bytes, encoding_);
    const std::optional<double> stamp = markers.empty() ? std::nullopt : markers.front().stamp;
    add_frame(landmarks_in(markers), stamp.value_or(received));
  }

 private:
  static Points landmarks_in(const std::vector<Marker>& markers) {
    constexpr std::int32_t kSphere = 2;
    constexpr std::int32_t kAdd = 0;
    std::map<std::string, Points> spheres;
    for (const Marker& marker : markers) {
      if (marker.points.size() == 3 * kLandmarkPoses && marker.action == kAdd) {
        return marker.points;
      }
      if (marker.type == kSphere && marker.action == kAdd) {
        Points& points = spheres[marker.space];
        points.insert(points.end(), marker.position.begin(), marker.position.end());
      }
    }
    for (const Marker& marker : markers) {
      const auto found = spheres.find(marker.space);
      if (found != spheres.end() && found->second.size() == 3 * kLandmarkPoses) {
        return found->second;
      }
    }
    return Points(3 * markers.size(), kNotReceived);
  }
};

}  // namespace

std::unique_ptr<TopicRows> rows_of_type(std::string_view type, std::string_view topic,
                                        MessageEncoding encoding) {
  const auto is_type = [&](std::string_view package, std::string_view name) {
    // ROS 1 has no folder between package and name.
    return type ==
           fmt::format("{}{}{}", package, encoding == MessageEncoding::kCdr ? "/msg/" : "/", name);
  };
  if (is_type("sensor_msgs", "JointState")) {
    return std::make_unique<JointStates>(encoding);
  }
  if (is_type("trajectory_msgs", "JointTrajectory")) {
    return std::make_unique<JointTrajectories>(encoding);
  }
  if (is_type("geometry_msgs", "PoseArray")) {
    return std::make_unique<PoseArrays>(encoding);
  }
  if (is_type("visualization_msgs", "MarkerArray")) {
    return std::make_unique<MarkerArrays>(encoding);
  }
  if (is_type("geometry_msgs", "PoseStamped")) {
    return std::make_unique<StampedPoses>(encoding, topic, false);
  }
  if (is_type("geometry_msgs", "TransformStamped")) {
    return std::make_unique<StampedPoses>(encoding, topic, true);
  }
  if (is_type("tf2_msgs", "TFMessage") || is_type("tf", "tfMessage")) {
    return std::make_unique<Transforms>(encoding);
  }
  return nullptr;
}

bool is_pose_type(std::string_view type) {
  return type.ends_with("/PoseStamped") || type.ends_with("/TransformStamped") ||
         type.ends_with("/TFMessage") || type.ends_with("/tfMessage");
}

bool is_incidental_type(std::string_view type) {
  return is_pose_type(type) || type.ends_with("/MarkerArray");
}

}  // namespace handway::device
