// The Schur complement in double for directions in wide arithmetic.
#pragma once

#include <memory>

#include "sdp/schur/schur.h"

namespace gainsmith::sdp {

/// B^-1, about. In wide arithmetic B is assembled and factored in double as long as that is enough:
/// the residuals of refinement have all digits, so its steps give the direction all the same
/// (iterative refinement in several precisions, Carson, Higham 2018). Where they get nowhere, B
/// follows in T, there and at every later point: its condition only grows. In double, and where B
/// costs little beside a step of refinement, this is Schur.
template <typename T>
class MixedSchur {
 public:
  MixedSchur(const Data& data, unsigned threads);

  /// B at (X^-1, Y), which must stay as they are until the next call; in T where it
  /// `must_be_exact`.
  void assemble(const Blocks<T>& inverse_X, const Blocks<T>& Y, bool must_be_exact);
  bool factorise();

  /// Is B in double while T is wider?
  bool rounded() const { return rounded_; }
  /// B in T instead; false when it is in T or cannot be factored.
  bool widen();

  /// From now on B is in T: the points to come are those at which an arithmetic narrower than T
  /// ended.
  void stay_wide() { widened_ = true; }

  void solve(const Vector<T>& r, Vector<T>& x);

 private:
  const Data& data_;
  unsigned threads_;
  std::unique_ptr<Schur<T>> schur_;  ///< in T, once it is wanted
  /// In double, when T is not.
  struct Narrow {
    Narrow(const Data& data, unsigned threads)
        : schur(data, threads), inverse_X(data.layout), Y(data.layout), r(data.m()), x(data.m()) {}
    Schur<double> schur;
    Blocks<double> inverse_X, Y;
    Vector<double> r, x;
  };
  std::unique_ptr<Narrow> narrow_;
  const Blocks<T>* inverse_X_ = nullptr;
  const Blocks<T>* Y_ = nullptr;
  bool rounded_ = false, widened_ = false;
};

}  // namespace gainsmith::sdp
