// Taylor series in time of a flow over lanes, and of values along it (series_steps.h).
//
// A SeriesCode is made once and read by all threads; a SeriesMachine has the coefficients of one of
// them. Two parts: the flow x' = f(x), order by order, and what follows from its series, node by
// node, so that a branch knows all orders of what it depends on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lanes/series_steps.h"
#include "lanes/steps.h"
#include "numbers/scalar_graph.h"
#include "pieces/step_polynomial.h"

namespace gainsmith::lanes {

class SeriesCode {
 public:
  /// Input rows[k] of `inputs` moves at the rate of the node rates[k], the others rest. `followed`: the
  /// nodes whose series are asked for. None where an operation has no recurrence.
  static std::optional<SeriesCode> make(const numbers::ScalarGraph& graph, std::size_t inputs,
                                        const std::vector<int>& rows, const std::vector<int>& rates,
                                        const std::vector<int>& followed);

  std::size_t rows() const { return rows_.size(); }
  std::size_t followed() const { return followed_.size(); }

 private:
  friend class SeriesMachine;
  class Maker;
  /// A step after the flow, and the differences (slots) at whose zeros it changes its branch.
  struct Later {
    SeriesStep step;
    std::uint32_t more = 0, less = 0;  ///< slots: the branch changes where these are equal
    bool branches = false;
    bool beside_zero = false;  ///< it changes where `more` is 0
  };

  std::size_t inputs_ = 0;
  std::size_t registers_ = 0, slots_ = 0;
  std::vector<SeriesPlace> input_places_;  ///< by input
  std::vector<std::pair<SeriesPlace, double>> constants_;
  std::vector<SeriesStep> still_, flow_;
  std::vector<Later> later_;
  std::vector<std::uint32_t> rows_, followed_;  ///< slots
};

class SeriesMachine {
 public:
  /// The code must outlive it. `variant`: for tests.
  explicit SeriesMachine(const SeriesCode& code, const Variant& variant = lanes::variant());
  SeriesMachine(SeriesMachine&&) noexcept;
  SeriesMachine& operator=(SeriesMachine&&) noexcept;
  ~SeriesMachine();

  /// The series of the flow of all lanes of groups in which one of `active` is, from the values of
  /// all inputs, input k of lane l at values[k*kLanes + l].
  void run(const double* values, std::uint32_t active);
  /// What follows from it up to `length` of each lane, which become shorter where a branch changes
  /// before.
  void follow(double* length, std::uint32_t active);
  /// By lane, of the rows: see SeriesGrowth.
  void growth(const std::vector<double>& floor, const double* length, std::uint32_t active,
              double* last, double* before) const;
  /// The values of row k of lane l after length[l], by terms up to `order`: out[k*kLanes + l].
  void values(const double* length, std::size_t order, std::uint32_t active, double* out) const;
  /// A row, or what is followed, over a step.
  pieces::StepPolynomial row(std::size_t k, std::size_t lane, double length) const {
    return pieces::StepPolynomial::of_series(at(code_->rows_[k], lane), kGroup, kOrder + 1, length);
  }
  pieces::StepPolynomial followed(std::size_t k, std::size_t lane, double length) const {
    return pieces::StepPolynomial::of_series(at(code_->followed_[k], lane), kGroup, kOrder + 1,
                                             length);
  }

 private:
  const double* at(std::uint32_t slot, std::size_t lane) const {
    return group(lane / kGroup) + slot * kSlot + lane % kGroup;
  }
  double* group(std::size_t g) const { return slots_.get() + g * code_->slots_ * kSlot; }
  template <class Visit>
  static void each_group(std::uint32_t active, const Visit& visit);

  struct Free {
    void operator()(double* slots) const;
  };
  /// Of a group: at order 0, and at others.
  struct Found {
    std::vector<FlowStep> still, first, others;
  };
  FlowStep found(const SeriesStep& step, std::size_t g, bool first) const;
  const SeriesCode* code_;
  const Variant* variant_;
  std::unique_ptr<double[], Free> slots_, registers_;  ///< slots of the groups behind each other
  std::vector<Found> found_;                           ///< by group
};

}  // namespace gainsmith::lanes
