// Why no gains can be found: a mode of the plant that its output does not show, or that its input
// does not reach.
//
// (A, C), n x n and p x n, is detectable exactly when [A - lambda I; C] has rank n at every lambda
// with Re lambda >= 0, and stabilisability of (A, B) is that of (A', B') (Hautus 1969). It is
// enough to test the eigenvalues of A, by singular values in balanced units.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "forall/domain.h"
#include "model/instance.h"
#include "numbers/matrix.h"

namespace gainsmith::design {

/// An eigenvalue lambda of A, Re lambda >= 0 or, of x+ = A x, |lambda| >= 1, at which [A - lambda
/// I; C] loses rank: v is the direction, (A - lambda I) v = 0 and C v = 0 up to rounding.
struct HiddenMode {
  std::complex<double> eigenvalue;
  numbers::Vector direction;  ///< real part of v, or its imaginary part where that is larger
  double residual = 0;        ///< the smallest singular value over the largest
  double accuracy = 0;        ///< how far the eigenvalue may be from that of A
};

enum class Modes { not_decaying, not_shrinking, all };  ///< the second of x+ = A x

/// The hidden mode that is farthest right, in balanced units; none when (A, C) is detectable, or of
/// all modes observable, as far as double tells.
std::optional<HiddenMode> hidden_mode(const numbers::Matrix& A, const numbers::Matrix& C,
                                      Modes modes = Modes::not_decaying);

/// The same for the data A (n x n) and C (p x n) of a design that declares them so, as a sentence;
/// or of (A', B') for the data B, B2 (n x m) through which gains drive the plant; or the mode of A
/// that grows most, of a plant whose only state moves by A alone in a design without gains. Empty
/// without one.
std::string hidden_mode_text(const model::Instance& instance);

/// The same of the plant's linearisation by its state x, where its output y = h(x) is one of the
/// design's signals, at a point of the box x_1, x_2, ... of a domain. A search: none found does not
/// say that there is none.
std::string hidden_mode_text(const model::Instance& instance, const forall::Domain& domain);

/// Of a design with the data A and C or C2, or A and B or B2: the slowest modes that no gain moves,
/// as sentences; empty without one.
std::vector<std::string> fixed_mode_texts(const model::Instance& instance);

}  // namespace gainsmith::design
