#include "recordings/topic_rows.h"

#include "recordings/message_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
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

/// Positions of poses. Messages with another number of poses are frames without a hand.
class PoseArrays final : public TopicRows {
 public:
  explicit PoseArrays(MessageEncoding encoding) : encoding_(encoding) {}

  void add(std::string_view bytes, double received) override {
    MessageReader message(bytes, encoding_);
    const std::optional<double> stamp = message.stamp();
    constexpr std::size_t kNumbers = 7;  // a point and a quaternion
    const std::size_t poses = message.count(kNumbers * sizeof(double));
    times_.push_back(stamp.value_or(received));
    other_ = poses == 0 || poses == kLandmarkPoses ? other_ : poses;
    for (std::size_t i = 0; i < 3 * kLandmarkPoses; ++i) {
      const bool is_read = poses == kLandmarkPoses;
      positions_.push_back(is_read ? message.float64() : kNotReceived);
      for (std::size_t rest = 3; is_read && i % 3 == 2 && rest < kNumbers; ++rest) {
        static_cast<void>(message.float64());
      }
    }
    has_hands_ = has_hands_ || poses == kLandmarkPoses;
    if (positions_.size() > kMostNumbers) {
      throw MessageError("more numbers than can be read");
    }
  }
  [[nodiscard]] std::vector<std::size_t> row_shape() const override {
    return {has_hands_ ? kLandmarkPoses : other_, 3};
  }
  [[nodiscard]] std::size_t row_count() const override { return times_.size(); }
  [[nodiscard]] Series series() const override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Series series;
    series.times = times_;
    series.time_unit.seconds = 1.0;
    series.values = Eigen::Map<const RowMajor>(positions_.data(), std::ssize(times_),
                                               Eigen::Index{3 * kLandmarkPoses});
    return series;
  }

 private:
  MessageEncoding encoding_;
  std::vector<double> times_;
  std::vector<double> positions_;
  std::size_t other_ = 0;
  bool has_hands_ = false;
};

}  // namespace

std::unique_ptr<TopicRows> rows_of_type(std::string_view type, MessageEncoding encoding) {
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
  return nullptr;
}

}  // namespace handway::device
