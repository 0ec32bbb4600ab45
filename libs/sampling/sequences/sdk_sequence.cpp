#include "handway/sampling/sequences/sdk_sequence.h"

#include <cmath>
#include <stdexcept>

namespace handway::sampling {
namespace {

int smallest_prime_factor(int n) {
  for (int factor = 2; factor * factor <= n; ++factor) {
    if (n % factor == 0) {
      return factor;
    }
  }
  return n;
}

Eigen::MatrixXi kronecker(const Eigen::MatrixXi& A, const Eigen::MatrixXi& B) {
  Eigen::MatrixXi product(A.rows() * B.rows(), A.cols() * B.cols());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      product.block(i * B.rows(), j * B.cols(), B.rows(), B.cols()) = A(i, j) * B;
    }
  }
  return product;
}

}  // namespace

Eigen::MatrixXi sdk_matrix(int d) {
  if (d < 1) {
    throw std::invalid_argument("the SDK sequence has at least one dimension");
  }
  if (d == 1) {
    return Eigen::MatrixXi::Ones(1, 1);
  }
  if (d == 2) {
    return (Eigen::MatrixXi(2, 2) << 1, 0, 1, 1).finished();
  }
  if (d == 3) {
    return (Eigen::MatrixXi(3, 3) << 1, 0, 0, 0, 1, 0, 1, 1, 1).finished();
  }
  const int p = smallest_prime_factor(d);
  if (p == d) {
    return sdk_matrix(d + 1).topLeftCorner(d, d);
  }
  return kronecker(sdk_matrix(p), sdk_matrix(d / p));
}

SdkSequence::SdkSequence(int dimension, int levels) : levels_(levels) {
  if (levels < 1 || levels > 52) {
    throw std::invalid_argument("the SDK sequence has 1 to 52 partition levels");
  }
  const Eigen::MatrixXi T = sdk_matrix(dimension);
  rows_.resize(static_cast<std::size_t>(dimension));
  for (int i = 0; i < dimension; ++i) {
    for (int j = 0; j < dimension; ++j) {
      if (T(i, j) != 0) {
        rows_[static_cast<std::size_t>(i)].push_back(j);
      }
    }
  }
}

double SdkSequence::side() const { return std::ldexp(1.0, -levels_); }

Eigen::VectorXd SdkSequence::corner(std::uint64_t index) const {
  constexpr int kIndexBits = 64;
  const int d = dimension();
  Eigen::VectorXd coordinates = Eigen::VectorXd::Zero(d);
  double weight = 0.5;
  for (int level = 0; level < levels_ && level * d < kIndexBits; ++level, weight /= 2.0) {
    for (int i = 0; i < d; ++i) {
      std::uint64_t bit = 0;
      for (const int column : rows_[static_cast<std::size_t>(i)]) {
        const int position = level * d + column;
        bit ^= position < kIndexBits ? (index >> position) & 1u : 0u;
      }
      coordinates[i] += weight * static_cast<double>(bit);
    }
  }
  return coordinates;
}

Eigen::VectorXd SdkSequence::centre(std::uint64_t index) const {
  return corner(index).array() + side() / 2.0;
}

}  // namespace handway::sampling
