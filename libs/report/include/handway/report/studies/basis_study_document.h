#pragma once

#include "handway/report/document/document.h"
#include "handway/report/export.h"
#include "handway/sampling/postures/basis_study.h"

namespace handway::report {

/// Returns the report of a study of a basis: the number of directions that are enough, their
/// stability and their quality for several persons, in mm at the fingertips and in degrees.
/// @param confidence of the intervals, 0 to 1.
[[nodiscard]] HANDWAY_REPORT_EXPORT Document basis_study_document(const sampling::BasisStudy& study,
                                                                  double confidence);

}  // namespace handway::report
