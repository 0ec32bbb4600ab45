#include "features/glove/mapping_comparison.h"

#include "handway/device/glove/hand_mapper.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/principal_components.h"

#include <algorithm>
#include <cstddef>

namespace handway::gui {
namespace {

constexpr Eigen::Index kMostCompared = 4;

sampling::PrincipalComponents components_of(const std::vector<device::GloveAngles>& frames,
                                            const device::HandMapper& mapper,
                                            const std::vector<std::string>& left_out) {
  const Eigen::VectorXd range = (mapper.upper() - mapper.lower()).cwiseMax(1e-12);
  Eigen::MatrixXd postures(static_cast<Eigen::Index>(frames.size()), range.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    postures.row(static_cast<Eigen::Index>(i)) =
        (mapper.posture(frames[i]) - mapper.lower()).cwiseQuotient(range).transpose();
  }
  std::vector<int> out;
  for (std::size_t j = 0; j < mapper.joints().size(); ++j) {
    if (std::ranges::count(left_out, mapper.joints()[j]) > 0) {
      out.push_back(static_cast<int>(j));
    }
  }
  return sampling::principal_components(postures, out);
}

}  // namespace

MappingComparison compare_mappings(const std::vector<device::GloveAngles>& frames,
                                   const device::HandMapping& a, const device::HandMapping& b,
                                   const geometric::RobotModel& model,
                                   const std::vector<std::string>& left_out) {
  const device::HandMapper mapper_a(a, model);
  const device::HandMapper mapper_b(b, model);
  const sampling::PrincipalComponents of_a = components_of(frames, mapper_a, left_out);
  const sampling::PrincipalComponents of_b = components_of(frames, mapper_b, left_out);
  MappingComparison result{of_a.shares, of_b.shares, {}};
  if (mapper_a.joints() == mapper_b.joints()) {
    const Eigen::Index count =
        std::min({kMostCompared, of_a.directions.cols(), of_b.directions.cols()});
    result.angles.resize(count);
    for (Eigen::Index k = 1; k <= count; ++k) {
      result.angles[k - 1] =
          sampling::principal_angles(of_a.directions.leftCols(k), of_b.directions.leftCols(k))
              .maxCoeff();
    }
  }
  return result;
}

}  // namespace handway::gui
