#include "simulate/vector_field.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/number.h"
#include "hybrid/affine.h"

namespace gainsmith::simulate {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// The programs of what flows and is not steady.
std::vector<const expr::Program*> flowing(const hybrid::System& system) {
  std::vector<const expr::Program*> programs;
  for (const model::Dynamics::Assignment& assignment : system.dynamics.flow)
    if (system.moves[assignment.variable] != hybrid::Moves::steady)
      programs.push_back(&assignment.value.program);
  return programs;
}

bool is_symmetric(const model::Dynamics::Variable& variable) {
  return variable.structure == model::Structure::symmetric;
}

}  // namespace

VectorField::VectorField(const hybrid::System& system)
    : system_(&system),
      together_(hybrid::stacked(flowing(system), system)),
      largest_rate_(system.dynamics.variables.size(), 0) {
  using Kind = model::Dynamics::VariableKind;
  const auto& variables = system.dynamics.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Kind kind = variables[i].kind;
    if (kind != Kind::time && kind != Kind::since && kind != Kind::left) continue;
    clocks_.push_back(i);
    lines_.push_back(
        {system.layout.slots[i].offset, 0, 0, kind == Kind::left ? -1.0 : 1.0, kind == Kind::left});
  }
  for (std::size_t k = 0; k < system.dynamics.flow.size(); ++k) add_flow(k);
  note_inputs(flowing(system));
  for (const model::Dynamics::Component& component : system.dynamics.components)
    frozen_.push_back(component.frozen ? std::optional<hybrid::EventCondition>(
                                             std::in_place, *component.frozen, system)
                                       : std::nullopt);
  is_frozen_.assign(frozen_.size(), false);
}

void VectorField::add_flow(std::size_t flow) {
  const model::Dynamics::Assignment& assignment = system_->dynamics.flow[flow];
  const hybrid::Slot& slot = system_->layout.slots[assignment.variable];
  const bool symmetric = is_symmetric(system_->dynamics.variables[assignment.variable]);
  hybrid::SystemFunction value(assignment.value.program, *system_);
  if (system_->moves[assignment.variable] == hybrid::Moves::steady) {
    steady_.push_back(
        {assignment.variable, std::move(value), static_cast<Index>(lines_.size()), {}});
    for (Index k = 0; k < slot.shape.size(); ++k) lines_.push_back({slot.offset + k});
    return;
  }
  flows_.push_back({assignment.variable, std::move(value), size(), {}});
  if (const auto& free = system_->free_flow[flow]) flows_.back().free.emplace(*free, *system_);
  const Index rows = slot.shape.rows;
  for (Index column = 0; column < slot.shape.cols; ++column)
    for (Index row = symmetric ? column : 0; row < rows; ++row) {
      elements_.push_back(slot.offset + column * rows + row);
      mirrors_.push_back(symmetric ? slot.offset + row * rows + column : elements_.back());
      rate_of_.push_back({flows_.size() - 1,
                          static_cast<std::size_t>(elements_.back() - slot.offset),
                          static_cast<std::size_t>(mirrors_.back() - slot.offset)});
    }
}

void VectorField::note_inputs(const std::vector<const expr::Program*>& programs) {
  std::set<std::size_t> used;
  for (const expr::Program* program : programs)
    for (const expr::Input& input : program->inputs)
      if (const auto at = system_->slot(input.name))
        if (system_->moves[*at] != hybrid::Moves::flows) used.insert(*at);
  for (const std::size_t variable : used)
    if (system_->moves[variable] == hybrid::Moves::steady) add_linear_inputs(variable);
  for (const std::size_t variable : used) {
    if (system_->moves[variable] == hybrid::Moves::steady) continue;
    const hybrid::Slot& slot = system_->layout.slots[variable];
    if (is_affine_in(variable, programs))
      add_linear_inputs(variable);
    else
      for (Index k = 0; k < slot.shape.size(); ++k) resting_inputs_.push_back(slot.offset + k);
  }
}

bool VectorField::is_affine_in(std::size_t variable,
                               const std::vector<const expr::Program*>& programs) const {
  const auto moves = [&](const std::string& name) {
    const auto at = system_->slot(name);
    return at && (*at == variable || system_->moves[*at] != hybrid::Moves::rests ||
                  std::find(linear_.begin(), linear_.end(), *at) != linear_.end());
  };
  return system_->affine && std::ranges::all_of(programs, [&](const expr::Program* program) {
           return hybrid::first_not_affine(*program, moves) == nullptr;
         });
}

void VectorField::add_linear_inputs(std::size_t variable) {
  linear_.push_back(variable);
  const hybrid::Slot& slot = system_->layout.slots[variable];
  const auto clock = std::find(clocks_.begin(), clocks_.end(), variable);
  std::optional<double> rate;
  if (clock != clocks_.end()) rate = lines_[static_cast<std::size_t>(clock - clocks_.begin())].rate;
  const bool rests = system_->moves[variable] == hybrid::Moves::rests;
  for (Index k = 0; k < slot.shape.size(); ++k)
    linear_inputs_.push_back({slot.offset + k, rate, rests});
}

void VectorField::reset() {
  for (Line& line : lines_) line.base = line.time = 0;
  for (std::size_t k = clocks_.size(); k < lines_.size(); ++k) lines_[k].rate = 0;
  std::fill(largest_rate_.begin(), largest_rate_.end(), 0);
}

void VectorField::set_clock(model::Dynamics::VariableKind kind, std::size_t event, double time) {
  for (std::size_t k = 0; k < clocks_.size(); ++k) {
    const auto& variable = system_->dynamics.variables[clocks_[k]];
    if (variable.kind == kind && variable.of == event) lines_[k].time = time;
  }
}

void VectorField::begin(double t, const VectorXd& values) {
  values_ = values;
  for (std::size_t c = 0; c < frozen_.size(); ++c)
    is_frozen_[c] = frozen_[c] && (*frozen_[c])(values);
  for (Entry& entry : steady_) set_steady(entry, t);
  const auto symmetric = [&](const Entry& entry) {
    return is_symmetric(system_->dynamics.variables[entry.variable]);
  };
  if (std::none_of(flows_.begin(), flows_.end(), symmetric)) return;
  const bool known = together_.run(values_);
  for (std::size_t k = 0; k < flows_.size(); ++k)
    if (symmetric(flows_[k]))
      require_symmetric(flows_[k], known ? together_.value(k) : text_of(flows_[k], values_));
}

/// A line goes on as it was where nothing has changed it.
void VectorField::set_steady(Entry& entry, double t) {
  const numbers::Matrix& rate = value_of(entry, values_);
  for (Index k = 0; k < rate.size(); ++k) {
    Line& line = lines_[static_cast<std::size_t>(entry.first + k)];
    const double now = values_(line.element);
    if (line.rate == rate(k) && line.at(t) == now) continue;
    line.base = now;
    line.time = t;
    line.rate = rate(k);
  }
}

void VectorField::require_symmetric(Entry& entry, const numbers::Matrix& rate) {
  double& largest = largest_rate_[entry.variable];
  if (rate.size() > 0) largest = std::max(largest, rate.cwiseAbs().maxCoeff());
  const double asymmetry = rate.size() > 0 ? (rate - rate.transpose()).cwiseAbs().maxCoeff() : 0;
  if (!(asymmetry > hybrid::kMeantEqual * largest)) return;
  const auto found = std::ranges::find(system_->dynamics.flow, entry.variable,
                                       &model::Dynamics::Assignment::variable);
  throw InputError(found->place, "the state " + system_->layout.slots[entry.variable].name +
                                     " is symmetric and its flow is not: elements differ by " +
                                     brief(asymmetry));
}

const numbers::Matrix& VectorField::text_of(Entry& entry, const VectorXd& values) {
  if (!entry.free) return entry.value(values);
  try {
    const numbers::Matrix& value = entry.value(values);
    if (value.allFinite()) return value;
  } catch (const expr::EvaluationError&) {
  }
  return (*entry.free)(values);
}

bool VectorField::is_frozen(std::size_t variable) const {
  const auto& own = system_->dynamics.variables[variable];
  return own.kind == model::Dynamics::VariableKind::state && is_frozen_[own.component];
}

/// The rate of a variable: 0 in a frozen component, of a symmetric one its symmetric part.
const numbers::Matrix& VectorField::value_of(Entry& entry, const VectorXd& values) {
  const auto& variable = system_->dynamics.variables[entry.variable];
  if (is_frozen(entry.variable)) {
    symmetric_ = numbers::Matrix::Zero(variable.shape.rows, variable.shape.cols);
    return symmetric_;
  }
  const numbers::Matrix& value = text_of(entry, values);
  if (!is_symmetric(variable)) return value;
  symmetric_ = (value + value.transpose()) / 2;
  return symmetric_;
}

void VectorField::fill(double t, VectorXd& values) const {
  for (const Line& line : lines_) values(line.element) = line.at(t);
}

void VectorField::fill_clocks(double t, VectorXd& values) const {
  for (std::size_t k = 0; k < clocks_.size(); ++k) values(lines_[k].element) = lines_[k].at(t);
}

VectorXd VectorField::gathered(const VectorXd& values) const {
  VectorXd y(size());
  for (std::size_t k = 0; k < elements_.size(); ++k)
    y(static_cast<Index>(k)) = values(elements_[k]);
  return y;
}

void VectorField::spread(const VectorXd& y, VectorXd& values) const {
  for (std::size_t k = 0; k < elements_.size(); ++k)
    values(elements_[k]) = values(mirrors_[k]) = y(static_cast<Index>(k));
}

void VectorField::rates(VectorXd& rate) {
  if (together_.run(values_)) {
    for (std::size_t k = 0; k < rate_of_.size(); ++k) {
      const Element& element = rate_of_[k];
      const double value = together_.element(element.flow, element.at);
      rate(static_cast<Index>(k)) =
          is_frozen(flows_[element.flow].variable) ? 0
          : element.at == element.mirror
              ? value
              : (value + together_.element(element.flow, element.mirror)) / 2;
    }
    return;
  }
  for (Entry& entry : flows_) {
    const numbers::Matrix& value = value_of(entry, values_);
    const hybrid::Slot& slot = system_->layout.slots[entry.variable];
    for (Index k = entry.first; k < size(); ++k) {
      const Index within = elements_[static_cast<std::size_t>(k)] - slot.offset;
      if (within < 0 || within >= slot.shape.size()) break;
      rate(k) = value(within);
    }
  }
}

void VectorField::rate(double t, const VectorXd& y, VectorXd& rate) {
  spread(y, values_);
  fill(t, values_);
  rates(rate);
}

void VectorField::rate_at(const VectorXd& y, const VectorXd& inputs, VectorXd& rate) {
  const VectorXd before = values_;
  spread(y, values_);
  for (std::size_t k = 0; k < linear_inputs_.size(); ++k)
    values_(linear_inputs_[k].element) = inputs(static_cast<Index>(k));
  rates(rate);
  values_ = before;
}

double VectorField::rate_of(const LinearInput& input) const {
  if (input.rests) return 0;
  const Index element = input.element;
  const auto found = std::ranges::find(lines_, element, &Line::element);
  return found == lines_.end() ? 0 : found->rate;
}

VectorXd VectorField::parameters(const VectorXd& values) const {
  VectorXd result(static_cast<Index>(resting_inputs_.size() + is_frozen_.size()));
  Index k = 0;
  for (const Index element : resting_inputs_) result(k++) = values(element);
  for (const bool frozen : is_frozen_) result(k++) = frozen ? 1 : 0;
  return result;
}

hybrid::DenseStep VectorField::step(double from, double to, const numbers::Matrix& series) const {
  const Index terms = std::max<Index>(series.cols(), lines_.empty() ? 1 : 2);
  hybrid::DenseStep made{from, to, numbers::Matrix::Zero(system_->size, terms)};
  numbers::Matrix& c = made.coefficients;
  c.col(0) = values_.head(system_->size);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const auto row = series.row(static_cast<Index>(k));
    c.row(elements_[k]).head(series.cols()) = row;
    c.row(mirrors_[k]).head(series.cols()) = row;
  }
  set_lines(made);
  return made;
}

void VectorField::set_lines(hybrid::DenseStep& step) const {
  for (const Line& line : lines_) {
    step.coefficients.row(line.element).setZero();  // what rounding has left of higher degrees, too
    step.coefficients(line.element, 0) = (line.at(step.from) + line.at(step.to)) / 2;
    step.coefficients(line.element, 1) = (line.at(step.to) - line.at(step.from)) / 2;
  }
}

hybrid::DenseStep VectorField::until(const hybrid::DenseStep& step, double t) const {
  hybrid::DenseStep made = step.until(t);
  const Index terms = step.coefficients.cols() - 1;
  for (Index k = 0; k < step.coefficients.rows(); ++k)
    if ((step.coefficients.row(k).tail(terms).array() == 0).all())
      made.coefficients.row(k) = step.coefficients.row(k);
  set_lines(made);
  return made;
}

}  // namespace gainsmith::simulate
