// Internal to lmi: the elements of all coefficients as balancing uses them.
#pragma once

#include <cstddef>
#include <vector>

#include "lmi/block.h"

namespace gainsmith::lmi {

/// Blocks of one inequality and size share their rows. Elements of the mirror places (r, c) and
/// (c, r) are one with twice the weight; the objective is a row of its own, the last one.
class BalanceElements {
 public:
  struct Element {
    int first = 0;  ///< the two rows, among all
    int second = 0;
    double log = 0;  ///< log2 of the size
  };

  BalanceElements(const std::vector<const Block*>& blocks, int unknowns,
                  const std::vector<double>& objective);

  int rows() const { return rows_; }
  int objective() const { return objective_; }  ///< its row; -1: there is none
  int unknowns() const { return static_cast<int>(starts_.size()) - 2; }
  std::size_t size() const { return elements_.size(); }
  /// The first of a block's rows.
  int first_row(std::size_t block) const { return first_rows_[block]; }

  /// Calls visit(element, weight) for those of unknown i, 0 being the constant, block by block.
  template <class Visit>
  void for_each(int i, Visit visit) const {
    const auto at = static_cast<std::size_t>(i);
    for (std::size_t part = starts_[at]; part < starts_[at + 1]; ++part)
      for (std::size_t k = parts_[part].begin; k < parts_[part + 1].begin; ++k) {
        const Element& e = elements_[k];
        visit(e, e.first == e.second ? parts_[part].weight : 2 * parts_[part].weight);
      }
  }
  /// The elements of unknown i as a range.
  const Element* begin_of(int i) const {
    return elements_.data() + parts_[starts_[static_cast<std::size_t>(i)]].begin;
  }
  const Element* end_of(int i) const { return begin_of(i + 1); }

  /// Those for which stays(i, element).
  template <class Stays>
  BalanceElements with(Stays stays) const {
    BalanceElements result = *this;
    result.elements_.clear();
    for (int i = 0; i <= unknowns(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (std::size_t part = starts_[at]; part < starts_[at + 1]; ++part) {
        result.parts_[part].begin = result.elements_.size();
        for (std::size_t k = parts_[part].begin; k < parts_[part + 1].begin; ++k)
          if (stays(i, elements_[k])) result.elements_.push_back(elements_[k]);
      }
    }
    result.parts_.back().begin = result.elements_.size();
    return result;
  }

 private:
  /// The elements that an unknown has in one block.
  struct Part {
    std::size_t begin = 0;
    double weight = 1;
  };

  int rows_ = 0;
  int objective_ = -1;
  std::vector<int> first_rows_;
  std::vector<Element> elements_;
  std::vector<Part> parts_;          ///< with an end
  std::vector<std::size_t> starts_;  ///< the first part of each unknown, with an end
};

}  // namespace gainsmith::lmi
