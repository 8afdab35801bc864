#include "support/reference_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/number.h"

namespace gainsmith::tests {

namespace {

constexpr int kDegree = 24;

}  // namespace

hybrid::DenseStep dense_step(double from, double to, const ReferenceRun::Values& values) {
  const double angle = std::numbers::pi / kDegree;
  numbers::Matrix samples(values(from).size(), kDegree + 1);
  for (int k = 0; k <= kDegree; ++k) {
    const double z = std::cos(angle * k);
    const double t = k == 0 ? to : k == kDegree ? from : from + (to - from) * (1 + z) / 2;
    samples.col(k) = values(t);
  }
  samples.col(0) *= 0.5;
  samples.col(kDegree) *= 0.5;
  hybrid::DenseStep step{from, to, numbers::Matrix::Zero(samples.rows(), kDegree + 1)};
  for (int i = 0; i <= kDegree; ++i)
    for (int k = 0; k <= kDegree; ++k)
      step.coefficients.col(i) += 2.0 / kDegree * std::cos(angle * i * k) * samples.col(k);
  step.coefficients.col(0) *= 0.5;
  step.coefficients.col(kDegree) *= 0.5;
  return step;
}

ReferenceRun::ReferenceRun(const Eigen::VectorXd& start, double horizon) : x_(start) {
  trajectory_.start = start;
  trajectory_.horizon = horizon;
}

ReferenceRun& ReferenceRun::flow(double to, const Values& values, int steps) {
  hybrid::FlowPiece piece;
  piece.j = j_;
  piece.start = x_;
  const double from = t_;
  for (int k = 1; k <= steps; ++k) {
    const double until = k == steps ? to : from + (to - from) * k / steps;
    piece.steps.push_back(dense_step(t_, until, values));
    t_ = until;
  }
  x_ = values(to);
  piece.end = x_;
  trajectory_.parts.emplace_back(std::move(piece));
  return *this;
}

ReferenceRun& ReferenceRun::draw(Eigen::Index element, double value) {
  x_(element) = value;
  return *this;
}

ReferenceRun& ReferenceRun::jump(std::size_t event, const Eigen::VectorXd& after, bool lost) {
  trajectory_.parts.emplace_back(hybrid::JumpPoint{t_, j_, event, lost, x_, after});
  x_ = after;
  ++j_;
  return *this;
}

hybrid::Trajectory ReferenceRun::end(hybrid::Ending ending, const std::string& message) const {
  hybrid::Trajectory result = trajectory_;
  result.ending = ending;
  result.end = t_;
  result.message = message;
  return result;
}

Eigen::Index place_of(const model::Dynamics& dynamics, const std::string& variable) {
  Eigen::Index place = 0;
  for (const model::Dynamics::Variable& one : dynamics.variables) {
    if (one.name == variable) return place;
    place += one.shape.size();
  }
  throw std::logic_error("no variable " + variable);
}

std::size_t event_of(const model::Dynamics& dynamics, const std::string& name) {
  for (std::size_t e = 0; e < dynamics.events.size(); ++e)
    if (dynamics.events[e].name == name) return e;
  throw std::logic_error("no event " + name);
}

std::string to_text(const std::vector<judge::Fault>& faults) {
  std::string text;
  for (const judge::Fault& fault : faults)
    text += "part " + std::to_string(fault.part) + ", t = " + decimal17(fault.t) + ": " +
            fault.what + " (" + brief(fault.size) + " > " + brief(fault.allowed) + ")\n";
  return text;
}

bool has_fault(const std::vector<judge::Fault>& faults, std::size_t part, const std::string& what) {
  return std::any_of(faults.begin(), faults.end(), [&](const judge::Fault& fault) {
    return fault.part == part && fault.what.find(what) != std::string::npos;
  });
}

Eigen::VectorXd column_of(std::initializer_list<double> values) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

}  // namespace gainsmith::tests
