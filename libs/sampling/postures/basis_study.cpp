#include "handway/sampling/postures/basis_study.h"

#include "handway/geometric/io/input_error.h"
#include "handway/sampling/postures/principal_components.h"
#include "handway/sampling/postures/quantile.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace handway::sampling {
namespace {

constexpr int kLengths = 5;                  // lengths of recordings: all, half of it, …
constexpr Eigen::Index kMostTested = 20000;  // rows that are reconstructed
constexpr double kMostShare = 0.95;

/// A posture that is reconstructed.
struct Tested {
  Eigen::VectorXd joints;
  Eigen::Matrix3Xd tips;
};

/// Block of rows that stay together.
struct Block {
  std::size_t recording = 0;
  int fold = 0;
  Eigen::Index rows = 0;
  IncrementalComponents components;
  std::vector<Tested> tested = {};  ///< Some of its rows.
};

/// The sum of values, and their number.
struct Sum {
  double sum = 0.0;
  double count = 0.0;

  void add(double value) {
    sum += value;
    ++count;
  }
  Sum& operator+=(const Sum& other) {
    sum += other.sum;
    count += other.count;
    return *this;
  }
  [[nodiscard]] double mean() const { return count > 0.0 ? sum / count : 0.0; }
};

/// Distances of fingertips in reconstructed postures, m.
struct Misses {
  std::vector<Sum> by_block;
  std::vector<double> all;
};

/// Largest principal angles between the spaces of the first 1, 2, … directions.
std::vector<double> largest_angles(const PrincipalComponents& a, const PrincipalComponents& b,
                                   int directions) {
  std::vector<double> angles;
  const Eigen::Index most =
      std::min({Eigen::Index{directions}, a.directions.cols(), b.directions.cols()});
  for (Eigen::Index k = 1; k <= most; ++k) {
    angles.push_back(
        principal_angles(a.directions.leftCols(k), b.directions.leftCols(k)).maxCoeff());
  }
  return angles;
}

class Study {
 public:
  Study(const std::vector<RecordedHand>& recordings, const FingertipsOf& fingertips,
        const BasisStudySettings& settings)
      : recordings_(recordings), fingertips_(fingertips), settings_(settings) {
    if (settings.directions < 1 || settings.folds < 2 || settings.resamples < 1 ||
        !(settings.block > 0.0) || !(settings.confidence > 0.0 && settings.confidence < 1.0)) {
      throw std::invalid_argument("a study's settings are out of range");
    }
    Eigen::Index rows = 0;
    for (const RecordedHand& recording : recordings) {
      rows += recording.samples.rows();
    }
    for (std::size_t r = 0; r < recordings.size(); ++r) {
      cut(r, std::max<Eigen::Index>(1, rows / kMostTested));
    }
    all_ = components_of(every_block);
  }

  BasisStudy run() {
    BasisStudy study;
    reconstruct(study);
    for (int halvings = kLengths - 1; halvings >= 0; --halvings) {
      add_stability(blocks_.size() >> static_cast<unsigned>(halvings), study);
    }
    if (recordings_.size() > 1) {
      compare_persons(study);
    }
    return study;
  }

 private:
  static bool every_block(const Block& /*block*/) { return true; }

  /// @param stride of rows that are tested.
  void cut(std::size_t recording, Eigen::Index stride) {
    const RecordedHand& hand = recordings_[recording];
    const auto length = std::max<Eigen::Index>(1, std::llround(settings_.block * hand.rate));
    const Eigen::Index count = hand.samples.rows() / length;
    if (count < 2) {
      throw geometric::InputError(
          {hand.name, "",
           fmt::format("{:.1f} s", static_cast<double>(hand.samples.rows()) / hand.rate),
           fmt::format("at least {:.3g} s, to be cut into blocks", 2.0 * settings_.block),
           "Record more postures."});
    }
    for (Eigen::Index b = 0; b < count; ++b) {
      const Eigen::Index first = b * length;
      const Eigen::Index last = b + 1 == count ? hand.samples.rows() : first + length;
      Block block{recording, static_cast<int>(b * settings_.folds / count), last - first,
                  IncrementalComponents(static_cast<int>(hand.samples.cols()))};
      for (Eigen::Index row = first; row < last; ++row) {
        const Eigen::VectorXd posture = hand.samples.row(row).transpose();
        block.components.add(posture);
        if ((row - first) % stride == 0) {
          block.tested.push_back({posture, fingertips_(posture)});
        }
      }
      blocks_.push_back(std::move(block));
    }
  }

  template <typename Taken>
  [[nodiscard]] PrincipalComponents components_of(const Taken& taken) const {
    IncrementalComponents sum(static_cast<int>(recordings_.front().samples.cols()));
    for (const Block& block : blocks_) {
      if (taken(block)) {
        sum.add(block.components);
      }
    }
    return sum.components(settings_.free_joints);
  }

  /// Reconstructs a posture with `directions` directions; free joints stay.
  [[nodiscard]] Eigen::VectorXd reconstructed(const Eigen::VectorXd& posture,
                                              const PrincipalComponents& basis,
                                              Eigen::Index directions) const {
    const auto V = basis.directions.leftCols(std::min(directions, basis.directions.cols()));
    Eigen::VectorXd result = basis.mean + V * (V.transpose() * (posture - basis.mean));
    for (const int joint : settings_.free_joints) {
      result[joint] = posture[joint];
    }
    return result.cwiseMax(0.0).cwiseMin(1.0);
  }

  /// Bases of the blocks taken, a fold left out in each.
  template <typename Taken>
  [[nodiscard]] std::vector<PrincipalComponents> bases_of_folds(const Taken& taken) const {
    std::vector<PrincipalComponents> bases;
    bases.reserve(static_cast<std::size_t>(settings_.folds));
    for (int fold = 0; fold < settings_.folds; ++fold) {
      bases.push_back(
          components_of([&](const Block& block) { return taken(block) && block.fold != fold; }));
    }
    return bases;
  }

  /// Returns the errors in the blocks taken, each reconstructed by its fold's basis.
  template <typename Taken>
  [[nodiscard]] Misses misses_of(const Taken& taken, const std::vector<PrincipalComponents>& bases,
                                 Eigen::Index directions) const {
    Misses misses;
    for (const Block& block : blocks_) {
      if (!taken(block)) {
        continue;
      }
      const PrincipalComponents& basis = bases[static_cast<std::size_t>(block.fold)];
      Sum& sum = misses.by_block.emplace_back();
      for (const Tested& tested : block.tested) {
        const Eigen::RowVectorXd off =
            (fingertips_(reconstructed(tested.joints, basis, directions)) - tested.tips)
                .colwise()
                .norm();
        std::ranges::for_each(off, [&](double miss) { sum.add(miss); });
        misses.all.insert(misses.all.end(), off.begin(), off.end());
      }
    }
    return misses;
  }

  void reconstruct(BasisStudy& study) {
    const std::vector<PrincipalComponents> bases = bases_of_folds(every_block);
    for (Eigen::Index k = 0; k <= all_.directions.cols(); ++k) {
      Misses misses = misses_of(every_block, bases, k);
      study.reconstruction.push_back({static_cast<int>(k), interval_of(misses.by_block),
                                      quantile_of(std::move(misses.all), kMostShare),
                                      all_.shares.head(k).sum()});
    }
  }

  /// Returns the interval of the mean over blocks or persons, by the bootstrap.
  [[nodiscard]] Interval interval_of(const std::vector<Sum>& sums) const {
    Sum total;
    for (const Sum& sum : sums) {
      total += sum;
    }
    std::vector<double> means;
    for (int i = 0; i < settings_.resamples; ++i) {
      RandomStream random = RandomStream(settings_.seed).fork(static_cast<std::uint64_t>(i));
      Sum drawn;
      for (std::size_t n = 0; n < sums.size(); ++n) {
        drawn += sums[random.below(sums.size())];
      }
      means.push_back(drawn.mean());
    }
    return bounds(total.mean(), means);
  }

  [[nodiscard]] Interval bounds(double mean, const std::vector<double>& values) const {
    const double tail = 0.5 * (1.0 - settings_.confidence);
    return {mean, quantile_of(values, tail), quantile_of(values, 1.0 - tail)};
  }

  void add_stability(std::size_t length, BasisStudy& study) {
    if (length < 2) {
      return;
    }
    std::vector<std::vector<double>> angles;
    double seconds = 0.0;
    for (int i = 0; i < settings_.resamples; ++i) {
      RandomStream random = RandomStream(settings_.seed).fork(static_cast<std::uint64_t>(i));
      IncrementalComponents drawn(static_cast<int>(all_.mean.size()));
      for (std::size_t n = 0; n < length; ++n) {
        const Block& block = blocks_[random.below(blocks_.size())];
        drawn.add(block.components);
        seconds += static_cast<double>(block.rows) / recordings_[block.recording].rate;
      }
      const std::vector<double> found =
          largest_angles(drawn.components(settings_.free_joints), all_, settings_.directions);
      angles.resize(std::max(angles.size(), found.size()));
      for (std::size_t k = 0; k < found.size(); ++k) {
        angles[k].push_back(found[k]);
      }
    }
    BasisStability& stability =
        study.stability.emplace_back(BasisStability{seconds / settings_.resamples, {}});
    for (const std::vector<double>& of_k : angles) {
      const Eigen::Map<const Eigen::VectorXd> all(of_k.data(), std::ssize(of_k));
      stability.angles.push_back(bounds(all.mean(), of_k));
    }
  }

  void compare_persons(BasisStudy& study) {
    std::vector<Sum> means;
    for (std::size_t r = 0; r < recordings_.size(); ++r) {
      const auto is_own = [r](const Block& block) { return block.recording == r; };
      const PrincipalComponents own = components_of(is_own);
      const PrincipalComponents others =
          components_of([&](const Block& block) { return !is_own(block); });
      const auto error_by = [&](const std::vector<PrincipalComponents>& bases) {
        return interval_of(misses_of(is_own, bases, settings_.directions).by_block);
      };
      PersonFit fit;
      fit.name = recordings_[r].name;
      fit.own = error_by(bases_of_folds(is_own));
      fit.others = error_by(std::vector(static_cast<std::size_t>(settings_.folds), others));
      fit.angles = largest_angles(own, others, settings_.directions);
      means.push_back({fit.others.mean, 1.0});
      study.persons.push_back(std::move(fit));
    }
    study.newcomer = interval_of(means);
  }

  const std::vector<RecordedHand>& recordings_;
  const FingertipsOf& fingertips_;
  const BasisStudySettings& settings_;
  std::vector<Block> blocks_;
  PrincipalComponents all_;
};

}  // namespace

int BasisStudy::enough_for(double error) const {
  const auto found = std::ranges::find_if(reconstruction, [&](const ReconstructionError& each) {
    return each.fingertip.high <= error;
  });
  return found == reconstruction.end() ? -1 : found->directions;
}

BasisStudy study_basis(const std::vector<RecordedHand>& recordings, const FingertipsOf& fingertips,
                       const BasisStudySettings& settings) {
  if (recordings.empty()) {
    throw std::invalid_argument("a study needs a recording");
  }
  return Study(recordings, fingertips, settings).run();
}

namespace {

/// Returns the index of each of `joints` in `others`.
std::vector<Eigen::Index> places_of(const std::vector<std::string>& joints,
                                    const std::vector<std::string>& others, const std::string& of) {
  std::vector<Eigen::Index> places;
  for (const std::string& joint : joints) {
    const auto found = std::ranges::find(others, joint);
    if (found == others.end()) {
      throw geometric::InputError({of, "joints", "no joint \"" + joint + "\"",
                                   "all joints of the basis", "Compare what is of the same hand."});
    }
    places.push_back(found - others.begin());
  }
  return places;
}

/// Orthonormal columns with the span of the basis.
Eigen::MatrixXd span_of(const PmdBasis& basis) {
  if (basis.dimension() == 0) {
    throw geometric::InputError(
        {"basis of " + basis.hand, "directions", "no axis", "one or more", ""});
  }
  const Eigen::MatrixXd axes = axes_of(basis).colwise().normalized();
  return Eigen::HouseholderQR<Eigen::MatrixXd>(axes).householderQ() *
         Eigen::MatrixXd::Identity(axes.rows(), axes.cols());
}

}  // namespace

Eigen::VectorXd angles_between(const PmdBasis& a, const PmdBasis& b) {
  (void)places_of(b.joints, a.joints, "basis of " + a.hand);
  const std::vector<Eigen::Index> order = places_of(a.joints, b.joints, "basis of " + b.hand);
  return principal_angles(span_of(a), span_of(b)(order, Eigen::all));
}

Reconstruction reconstruct(const PmdBasis& basis, const PostureTable& postures) {
  const std::vector<Eigen::Index> order =
      places_of(basis.joints, postures.joints, "postures of " + postures.hand);
  const PostureSubspace subspace(basis);
  const Eigen::MatrixXd rows = postures.postures(Eigen::all, order);
  Eigen::MatrixXd missed(rows.rows(), rows.cols());
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    missed.row(row) = subspace.outside(rows.row(row).transpose()).transpose();
  }
  const double all = (rows.rowwise() - rows.colwise().mean()).squaredNorm();
  Reconstruction result;
  result.rms = (missed.colwise().squaredNorm() / static_cast<double>(rows.rows())).cwiseSqrt();
  result.held = all > 0.0 ? 1.0 - missed.squaredNorm() / all : 1.0;
  return result;
}

}  // namespace handway::sampling
