#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/postures/motion_components.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::sampling {

/// Recorded postures of a hand.
struct PostureTable {
  std::string hand;                 ///< Robot that the joints belong to.
  std::string source;               ///< Source of the postures.
  std::vector<std::string> joints;  ///< Names of the columns.
  Eigen::MatrixXd postures;         ///< Normalised joints, shape [postures, joints].
  /// Time of each posture, s, shape [postures]; empty: not known. Where it falls, another recording
  /// begins.
  Eigen::VectorXd times = {};
};

/// Posture tables as CSV files: lines that begin with `#` describe the rows, then comes a header
/// and a row for each posture, joints normalised to [0, 1]. The first column may be the time, s.
///
///     # handway postures 1
///     # hand: sah_right
///     # source: where the postures come from
///     time,thumb_base,thumb_abduction,…
///     0.010,0.5561,0.5561,…
///
/// @throws geometric::InputError with file, line and the fault: no such file, another first line,
/// no hand, no header or a joint twice in it, a row of another length, a value that is no number
/// within 1e-6 of [0, 1], a time that is no finite number, no rows.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT PostureTable read_postures(const std::filesystem::path& file);

/// Replaces the file whole. Values are rounded to four decimals, a hundredth of a degree for a
/// joint that turns by 100°; times to milliseconds.
/// @throws geometric::InputError if the file can't be written.
/// @throws std::invalid_argument unless there is a name for every column, and a time for every row
/// or for none.
HANDWAY_SAMPLING_EXPORT void write_postures(const PostureTable& table,
                                            const std::filesystem::path& file);

/// The recorded posture most similar to another.
struct NearestPosture {
  double distance = 0.0;   ///< In normalised joints.
  Eigen::VectorXd joints;  ///< Normalised, shape [joints of the basis].
};

/// Postures of a person, for queries of the one nearest to any posture. Free joints of the basis
/// don't count in distances: like the paper's thumb base (section 4.2) they move independently of
/// the person's hand. So a posture of SC^h and its twin with another thumb base are equally human,
/// as for PostureSubspace.
class HANDWAY_SAMPLING_EXPORT RecordedPostures {
 public:
  /// @throws geometric::InputError unless the table is of the basis' hand and has all its joints.
  /// @param name of the table, for that message: its file.
  RecordedPostures(const PmdBasis& basis, const PostureTable& table, const std::string& name);
  ~RecordedPostures();

  [[nodiscard]] Eigen::Index count() const;
  [[nodiscard]] const std::string& source() const { return source_; }

  /// @param posture normalised joints, shape [joints of the basis].
  /// @returns the posture with the free joints of `posture`.
  [[nodiscard]] NearestPosture nearest(const Eigen::VectorXd& posture) const;

  /// Distance to the PMD subspace that 95 % of the postures don't exceed: the usual distance of a
  /// hand like the recorded one.
  [[nodiscard]] double usual_distance_to_subspace() const { return usual_distance_; }

  /// Functional components of the motions in the recording, joints in the order of the basis; null
  /// if there are none. Free joints don't count.
  [[nodiscard]] const MotionComponents* motions() const { return motions_.get(); }
  /// Reason why there are no components of motions, a sentence; empty if there are.
  [[nodiscard]] const std::string& motions_fault() const { return motions_fault_; }

 private:
  struct Tree;

  /// @param postures in the order of the basis' joints, one a column.
  void find_motions(const Eigen::VectorXd& times, const Eigen::MatrixXd& postures);

  std::string source_;
  HandJointIndices free_joints_;
  std::unique_ptr<const Tree> tree_;
  double usual_distance_ = 0.0;
  std::unique_ptr<const MotionComponents> motions_;
  std::string motions_fault_;
};

/// The postures named by a basis; null if it names none.
/// @throws geometric::InputError as read_postures() and the constructor.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT std::shared_ptr<const RecordedPostures>
load_recorded_postures(const PmdBasis& basis);

/// Loads the postures of `file`, not those that the basis names. @throws as above.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT std::shared_ptr<const RecordedPostures>
load_recorded_postures(const PmdBasis& basis, const std::filesystem::path& file);

}  // namespace handway::sampling
