#include "handway/report/studies/basis_study_document.h"

#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <cstddef>

namespace handway::report {
namespace {

using geometric::kDegree;
using geometric::kMillimetre;
using sampling::BasisStudy;

Estimate estimate(const sampling::Interval& interval, double unit, int decimals) {
  return {fixed(interval.mean / unit, decimals), interval.low / unit, interval.high / unit};
}

std::string enough_text(const BasisStudy& study) {
  std::string text;
  for (const double error : sampling::kReportedErrors) {
    const int directions = study.enough_for(error);
    text += fmt::format("{} for {:g} mm: ", text.empty() ? "Enough" : ";", error / kMillimetre);
    text += directions < 0 ? "all PMDs are not enough" : fmt::format("{} PMDs", directions);
  }
  return text + '.';
}

void add_reconstruction(Document& document, const BasisStudy& study, double confidence) {
  document.push_back(Heading{3, "Number of PMDs"});
  document.push_back(Paragraph{
      fmt::format("Fingertip error for postures not used for the basis, mm ({:.0f} % confidence).",
                  100.0 * confidence)});
  document.push_back(Paragraph{enough_text(study)});
  Table table{{"PMDs", {"mean", "mm"}, {"95 % below", "mm"}, {"variance", "%"}}};
  for (const sampling::ReconstructionError& error : study.reconstruction) {
    table.rows.push_back({error.directions, estimate(error.fingertip, kMillimetre, 1),
                          fixed(error.most / kMillimetre, 1), fixed(100.0 * error.variance, 1)});
  }
  document.push_back(std::move(table));
}

// Columns for the spaces of the first 1, 2, … directions.
void add_direction_columns(Table& table, std::size_t count) {
  for (std::size_t k = 1; k <= count; ++k) {
    table.columns.emplace_back(k == 1 ? std::string("PMD 1") : fmt::format("1 to {}", k), "°");
  }
}

void add_stability(Document& document, const BasisStudy& study) {
  document.push_back(Heading{3, "Stability"});
  document.push_back(
      Paragraph{"Largest angle between the first directions of a part of the recording and of all "
                "of it."});
  Table table{{{"recorded", "s"}}};
  add_direction_columns(table, study.stability.back().angles.size());
  for (const sampling::BasisStability& stability : study.stability) {
    std::vector<Cell> row = {fixed(stability.seconds, 1)};
    for (const sampling::Interval& angle : stability.angles) {
      row.emplace_back(estimate(angle, kDegree, 0));
    }
    table.rows.push_back(std::move(row));
  }
  document.push_back(std::move(table));
}

void add_persons(Document& document, const BasisStudy& study) {
  document.push_back(Heading{3, "Persons"});
  document.push_back(Paragraph{
      "Fingertip error of each recording with its own basis and with that of the others."});
  Table errors{{"", {"own basis", "mm"}, {"the others'", "mm"}}};
  Table angles{{""}};
  add_direction_columns(angles, study.persons.front().angles.size());
  for (const sampling::PersonFit& person : study.persons) {
    errors.rows.push_back({person.name, estimate(person.own, kMillimetre, 1),
                           estimate(person.others, kMillimetre, 1)});
    std::vector<Cell> row = {person.name};
    for (const double angle : person.angles) {
      row.emplace_back(fixed(angle / kDegree, 1));
    }
    angles.rows.push_back(std::move(row));
  }
  errors.rows.push_back(
      {"a new person (estimate)", Number{}, estimate(study.newcomer, kMillimetre, 1)});
  document.push_back(std::move(errors));
  document.push_back(Paragraph{"Largest angle between its first directions and the others'."});
  document.push_back(std::move(angles));
}

}  // namespace

Document basis_study_document(const BasisStudy& study, double confidence) {
  Document document;
  add_reconstruction(document, study, confidence);
  if (!study.stability.empty()) {
    add_stability(document, study);
  }
  if (!study.persons.empty()) {
    add_persons(document, study);
  }
  return document;
}

}  // namespace handway::report
