// The search for the face that the equations of a program force Y on.
#pragma once

#include <Eigen/Eigenvalues>
#include <vector>

#include "sdp/core/iterate.h"

namespace gainsmith::sdp {

/// y_eliminated = weights y_kept says that U'y = 0.
struct Kernel {
  std::vector<Eigen::Index> eliminated, kept;
  Matrix<double> weights;
};

/// The search for d and U of face.h in the working problem: where X of a point has eigenvalues far
/// above all others, U is near their eigenvectors and d near x. Both are made exact.
class Exposure {
 public:
  explicit Exposure(const Data& data)
      : data_(data), image_(data.layout), off_(data.layout), moved_(data.layout) {
    c_ = Vector<double>::Map(data.c.data(), data.m());
  }

  /// From X and x of a point; true when d and U were found.
  bool find(const Iterate<double>& point);

  const Vector<DoubleDouble>& direction() const { return d_; }
  const Kernel& kernel(std::size_t b) const { return kernels_[b]; }
  bool on(Eigen::Index k) const { return on_[k] != 0; }

 private:
  bool guess(const Iterate<double>& point, double threshold);
  bool solve(const Vector<double>& x);
  void correct(double rest);
  bool exposes();
  void take_off_face(Blocks<DoubleDouble>& m) const;
  void take_off_face(Blocks<double>& m) const;

  const Data& data_;
  Vector<double> c_, step_;
  Vector<DoubleDouble> d_;
  Blocks<DoubleDouble> image_;  ///< A*(d)
  Blocks<double> off_, moved_;  ///< its part off the face, and that of a direction
  std::vector<Eigen::SelfAdjointEigenSolver<Matrix<double>>> spectra_;  ///< of X
  std::vector<Kernel> kernels_;                                         ///< by dense block
  std::vector<Matrix<double>> range_;                                   ///< U
  Vector<double> on_;  ///< 1 where a linear entry is in U
};

}  // namespace gainsmith::sdp
