#include "roadmap/neighbours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>

namespace handway::planning {
namespace {

using testing::ElementsAre;
using testing::FieldsAre;
using testing::IsEmpty;

constexpr double kAnywhere = std::numeric_limits<double>::infinity();

Eigen::VectorXd at(double x) { return Eigen::VectorXd::Constant(1, x); }

// Finds the neighbours by linear search.
std::vector<Neighbour> by_brute_force(const std::vector<Eigen::VectorXd>& points,
                                      const Eigen::VectorXd& point, std::size_t most, double radius,
                                      const std::function<bool(int)>& wanted) {
  std::vector<Neighbour> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = (points[i] - point).norm();
    if (distance <= radius && (!wanted || wanted(static_cast<int>(i)))) {
      all.emplace_back(distance, static_cast<int>(i));
    }
  }
  std::ranges::sort(all);
  all.resize(std::min(most, all.size()));
  return all;
}

TEST(Neighbours, AreListedTheNearestFirst) {
  Neighbours neighbours;
  for (const auto& [number, x] : {std::pair(0, 0.5), std::pair(1, 0.1), std::pair(2, 0.9)}) {
    neighbours.add(number, at(x));
  }
  EXPECT_THAT(neighbours.nearest(at(0), 2), ElementsAre(FieldsAre(0.1, 1), FieldsAre(0.5, 0)));
  EXPECT_THAT(neighbours.nearest(at(0), 9, 0.5), ElementsAre(FieldsAre(0.1, 1), FieldsAre(0.5, 0)))
      << "the radius counts as near";
  EXPECT_THAT(neighbours.nearest(at(0), 1, kAnywhere, [](int number) { return number != 1; }),
              ElementsAre(FieldsAre(0.5, 0)));
  EXPECT_THAT(neighbours.nearest(at(5), 9, 1.0), IsEmpty());
  EXPECT_THAT(Neighbours().nearest(at(5), 9), IsEmpty());
}

TEST(Neighbours, OfEquallyFarPointsTheLowerNumberComesFirst) {
  Neighbours neighbours(4);
  for (int number = 99; number >= 0; --number) {
    neighbours.add(number, at(number % 2 == 0 ? 1.0 : -1.0));
  }
  EXPECT_THAT(neighbours.nearest(at(0), 3),
              ElementsAre(FieldsAre(1.0, 0), FieldsAre(1.0, 1), FieldsAre(1.0, 2)));
  EXPECT_THAT(neighbours.nearest(at(1), 2, 0.0), ElementsAre(FieldsAre(0.0, 0), FieldsAre(0.0, 2)));
}

TEST(Neighbours, AreNearAcrossTheSeamOfAPeriodicCoordinate) {
  Neighbours neighbours(4, geometric::Periods(Eigen::Vector2d(1.0, 0.0)));
  for (int i = 0; i < 40; ++i) {
    neighbours.add(i, Eigen::Vector2d(0.025 * i + 3.0, 0.0));
  }
  EXPECT_THAT(neighbours.nearest(Eigen::Vector2d(-0.01, 0.0), 2),
              ElementsAre(FieldsAre(testing::DoubleNear(0.01, 1e-12), 0),
                          FieldsAre(testing::DoubleNear(0.015, 1e-12), 39)));
  EXPECT_THAT(neighbours.nearest(Eigen::Vector2d(0.0, 1.0), 1),
              ElementsAre(FieldsAre(testing::DoubleNear(1.0, 1e-12), 0)));
}

// Points as random as those of a search, on a coarse grid (many duplicates, many equally far), and
// some of each many times.
TEST(Neighbours, AreThoseOfALookAtEveryPoint) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const int dimension : {1, 2, 6, 19}) {
    for (const double grid : {0.0, 0.25}) {
      const auto draw = [&] {
        return Eigen::VectorXd::NullaryExpr(dimension,
                                            [&] {
                                              return grid > 0.0
                                                         ? grid * std::floor(uniform(random) / grid)
                                                         : uniform(random);
                                            })
            .eval();
      };
      Neighbours neighbours(8);
      std::vector<Eigen::VectorXd> points;
      for (int i = 0; i < 700; ++i) {
        const bool is_twin = i % 10 == 9;  // of one that came before
        points.push_back(is_twin ? Eigen::VectorXd(*std::next(points.begin(), i / 2)) : draw());
        neighbours.add(i, points.back());
        const Eigen::VectorXd point = i % 3 == 0 ? points.back() : draw();
        const double radius = i % 4 == 0 ? 0.5 * uniform(random) : kAnywhere;
        const auto wanted = [&](int number) { return i % 5 != 0 || number % 2 == 0; };
        const int most = 1 + i % 12;
        ASSERT_EQ(neighbours.nearest(point, most, radius, wanted),
                  by_brute_force(points, point, static_cast<std::size_t>(most), radius, wanted))
            << dimension << " dimensions, " << i + 1 << " points";
      }
    }
  }
}

}  // namespace
}  // namespace handway::planning
