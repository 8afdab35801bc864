#include "lanes/series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

namespace gainsmith::lanes {

namespace {

/// Of the size of a difference: where it starts so near to 0 it goes where it leads.
constexpr double kZero = 1e-13;

}  // namespace

void SeriesMachine::Free::operator()(double* slots) const {
  ::operator delete[](slots, std::align_val_t(64));
}

SeriesMachine::SeriesMachine(const SeriesCode& code, const Variant& variant)
    : code_(&code), variant_(&variant) {
  constexpr std::size_t groups = kLanes / kGroup;
  const auto zeros = [](std::size_t count) {
    std::unique_ptr<double[], Free> made(static_cast<double*>(
        ::operator new[](std::max<std::size_t>(count, 1) * sizeof(double), std::align_val_t(64))));
    std::fill_n(made.get(), count, 0.0);
    return made;
  };
  slots_ = zeros(std::max<std::size_t>(code.slots_, 1) * kSlot * groups);
  registers_ = zeros((code.registers_ + 1) * kGroup);  // behind them zeros
  for (const auto& [place, value] : code.constants_) {
    std::fill_n(registers_.get() + place.at * kGroup, kGroup, value);
    for (std::size_t g = 0; g < groups && place.slot != kNoSlot; ++g)
      std::fill_n(group(g) + place.slot * kSlot, kGroup, value);
  }
  for (std::size_t g = 0; g < groups; ++g) {
    Found& of = found_.emplace_back();
    for (const SeriesStep& step : code.still_) of.still.push_back(found(step, g, true));
    for (const SeriesStep& step : code.flow_) {
      of.first.push_back(found(step, g, true));
      of.others.push_back(found(step, g, false));
    }
  }
}

FlowStep SeriesMachine::found(const SeriesStep& step, std::size_t g, bool first) const {
  const auto at = [&](const SeriesPlace& place) { return registers_.get() + place.at * kGroup; };
  const auto slot = [&](const SeriesPlace& place) {
    return place.slot == kNoSlot ? nullptr : group(g) + place.slot * kSlot;
  };
  const auto order = [&](const SeriesPlace& place) {
    return place.rests && !first ? registers_.get() + code_->registers_ * kGroup : at(place);
  };
  const auto whole = [&](const SeriesPlace& place) {
    return place.slot == kNoSlot ? at(place) : slot(place);
  };
  return {step.op,           at(step.out),
          order(step.a),     order(step.b),
          order(step.c),     slot(step.out),
          whole(step.a),     whole(step.b),
          slot(step.beside), step.beside.slot == kNoSlot ? nullptr : at(step.beside)};
}

SeriesMachine::SeriesMachine(SeriesMachine&&) noexcept = default;
SeriesMachine& SeriesMachine::operator=(SeriesMachine&&) noexcept = default;
SeriesMachine::~SeriesMachine() = default;

template <class Visit>
void SeriesMachine::each_group(std::uint32_t active, const Visit& visit) {
  for (std::size_t g = 0; g < kLanes / kGroup; ++g)
    if ((active >> (g * kGroup) & ((1U << kGroup) - 1)) != 0) visit(g);
}

void SeriesMachine::run(const double* values, std::uint32_t active) {
  each_group(active, [&](std::size_t g) {
    double* const slots = group(g);
    for (std::size_t k = 0; k < code_->inputs_; ++k) {
      const SeriesPlace& place = code_->input_places_[k];
      const double* const from = values + k * kLanes + g * kGroup;
      std::copy_n(from, kGroup, registers_.get() + place.at * kGroup);
      if (place.slot != kNoSlot) std::copy_n(from, kGroup, slots + place.slot * kSlot);
    }
    const Found& of = found_[g];
    variant_->flow(of.still.data(), of.still.data(), of.still.size(), 0);
    variant_->flow(of.first.data(), of.others.data(), of.first.size(), kOrder);
  });
}

void SeriesMachine::follow(double* length, std::uint32_t active) {
  each_group(active, [&](std::size_t g) {
    double* const slots = group(g);
    double* const until = length + g * kGroup;
    for (const SeriesCode::Later& one : code_->later_) {
      if (one.branches) {
        std::array<double, kSlot> difference;
        for (std::size_t i = 0; i < kSlot; ++i)
          difference[i] =
              slots[one.more * kSlot + i] - (one.beside_zero ? 0 : slots[one.less * kSlot + i]);
        for (std::size_t l = 0; l < kGroup; ++l) {
          const auto along = pieces::StepPolynomial::of_series(difference.data() + l, kGroup,
                                                               kOrder + 1, until[l]);
          const auto b = along.coefficients();
          const double size = std::max(std::ranges::max(b), -std::ranges::min(b));
          if (!std::isfinite(size)) continue;
          if (const auto share = along.first_change(0, kZero * size)) until[l] *= *share;
        }
      }
      variant_->follow(one.step, until, slots);
    }
  });
}

void SeriesMachine::growth(const std::vector<double>& floor, const double* length,
                           std::uint32_t active, double* last, double* before) const {
  each_group(active, [&](std::size_t g) {
    variant_->series_growth(code_->rows_.data(), code_->rows_.size(), floor.data(),
                            length + g * kGroup, group(g), last + g * kGroup, before + g * kGroup);
  });
}

void SeriesMachine::values(const double* length, std::size_t order, std::uint32_t active,
                           double* out) const {
  each_group(active, [&](std::size_t g) {
    variant_->series_values(code_->rows_.data(), code_->rows_.size(), order, length + g * kGroup,
                            group(g), out + g * kGroup, kLanes);
  });
}

}  // namespace gainsmith::lanes
