#include "packs/step_polynomial.h"

#include <algorithm>
#include <cmath>

namespace gainsmith::packs {

StepPolynomial::StepPolynomial(Sample start, Sample middle, Sample end, double length) {
  b_[0] = start.value;
  b_[1] = start.value + length * start.rate / 5;
  b_[4] = end.value - length * end.rate / 5;
  b_[5] = end.value;
  const double sum = (32 * middle.value - b_[0] - 5 * b_[1] - 5 * b_[4] - b_[5]) / 10;
  const double difference =
      (3.2 * length * middle.rate + b_[0] + 3 * b_[1] - 3 * b_[4] - b_[5]) / 2;
  b_[2] = (sum - difference) / 2;
  b_[3] = (sum + difference) / 2;
  const double fifth = b_[5] - 5 * b_[4] + 10 * b_[3] - 10 * b_[2] + 5 * b_[1] - b_[0];
  error_ = 0.15 / 32 * std::abs(fifth);
}

double StepPolynomial::operator()(double share) const {
  std::array<double, 6> b = b_;
  for (std::size_t level = 5; level > 0; --level)
    for (std::size_t k = 0; k < level; ++k) b[k] += share * (b[k + 1] - b[k]);
  return b[0];
}

double StepPolynomial::largest() const { return *std::max_element(b_.begin(), b_.end()); }

double StepPolynomial::highest() const {
  constexpr int parts = 16;
  double found = std::max(b_.front(), b_.back());
  for (int k = 1; k < parts; ++k) found = std::max(found, (*this)(static_cast<double>(k) / parts));
  return found;
}

bool StepPolynomial::falls() const {
  for (std::size_t k = 0; k < 5; ++k)
    if (b_[k + 1] > b_[k]) return false;
  return true;
}

double StepPolynomial::root(int side) const {
  double low = 0;
  double high = 1;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    ((*this)(middle)*side > 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace gainsmith::packs
