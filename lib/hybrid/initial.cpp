#include "hybrid/initial.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/number.h"

namespace gainsmith::hybrid {

namespace {

using model::StartKind;

expr::Program link_start(const model::Formula& formula, std::size_t state, const System& system) {
  expr::Program program = system.link(formula);
  const std::vector<Slot>& slots = system.layout.slots;
  for (const expr::Input& input : program.inputs) {
    const auto later = std::find_if(slots.begin() + static_cast<std::ptrdiff_t>(state), slots.end(),
                                    [&](const Slot& other) { return other.name == input.name; });
    if (later != slots.end() || input.name == system.layout.timer)
      throw InputError(formula.place, "the initial value of " + slots[state].name + " uses " +
                                          input.name +
                                          ", which has no value yet: only states declared before "
                                          "may be used");
  }
  const auto missing = system.missing(program);
  if (!missing.empty()) throw InputError(formula.place, "there is no value for " + missing.front());
  return program;
}

/// A box may be given by scalars for all elements.
numbers::Matrix bound_of(const model::Formula& formula, expr::Shape shape, const System& system) {
  numbers::Matrix bound = system.value(formula);
  if (bound.size() != 1) return bound;
  return numbers::Matrix::Constant(shape.rows, shape.cols, bound(0, 0));
}

StartRule make_rule(const model::Design::Start& start, const System& system) {
  const Slot& slot = system.layout.slots[start.state];
  StartRule rule{start.kind, {}, {}, start.place};
  if (start.kind == StartKind::expression) {
    rule.program = link_start(start.values.front(), start.state, system);
    return rule;
  }
  for (const model::Formula& formula : start.values)
    rule.values.push_back(start.kind == StartKind::box ? bound_of(formula, slot.shape, system)
                                                       : system.value(formula));
  if (start.kind == StartKind::box && (rule.values[0].array() > rule.values[1].array()).any())
    throw InputError(start.place, "the box of " + slot.name + " is empty: low > high");
  if (start.kind == StartKind::ellipsoid) read_ellipsoid(rule, slot.name);
  return rule;
}

/// The box [-1, 1].
StartRule unit_box(expr::Shape shape) {
  const numbers::Matrix ones = numbers::Matrix::Ones(shape.rows, shape.cols);
  return {StartKind::box, {-ones, ones}, {}, {}};
}

}  // namespace

void read_ellipsoid(StartRule& rule, const std::string& state) {
  constexpr double kAsymmetry = 1e-9;
  const numbers::Matrix Q = rule.values[1];
  const double level = rule.values[2](0, 0);
  const auto fail = [&](const std::string& why) {
    throw InputError(rule.place, "the ellipsoid of " + state + ": " + why);
  };
  const double size = Q.size() > 0 ? Q.cwiseAbs().maxCoeff() : 0;
  const double asymmetry = Q.size() > 0 ? (Q - Q.transpose()).cwiseAbs().maxCoeff() : 0;
  if (asymmetry > kAsymmetry * size) fail("its matrix is not symmetric");
  if (!(level >= 0 && std::isfinite(level)))
    fail("its level is " + brief(level) + ": expected a number from 0 on");
  const Eigen::LLT<numbers::Matrix> factors((Q + Q.transpose()) / 2);
  if (!Q.allFinite() || factors.info() != Eigen::Success)
    fail("its matrix is not positive definite");
  const numbers::Matrix unit = numbers::Matrix::Identity(Q.rows(), Q.cols());
  rule.values = {rule.values[0], std::sqrt(level) * factors.matrixU().solve(unit)};
}

Eigen::VectorXd draw_ellipsoid(const StartRule& rule, RandomStream& random) {
  const Eigen::Index n = rule.values[0].size();
  Eigen::VectorXd z(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double u = random.uniform();
    z(k) = std::sqrt(-2 * std::log1p(-u)) * std::cos(2 * std::numbers::pi * random.uniform());
  }
  const double u = random.uniform();
  const double length = z.norm();
  if (length > 0) z *= std::pow(u, 1 / static_cast<double>(n)) / length;
  return rule.values[0].col(0) + rule.values[1] * z;
}

std::vector<StartRule> make_start_rules(const model::Design& design, const System& system) {
  const std::vector<model::Design::Start>& starts = design.campaign.starts;
  std::vector<StartRule> rules;
  for (std::size_t state = 0; state < design.states.size(); ++state) {
    const auto found = std::find_if(starts.begin(), starts.end(),
                                    [&](const auto& start) { return start.state == state; });
    const std::optional<model::Formula>& usual = design.states[state].start;
    if (found != starts.end()) {
      rules.push_back(make_rule(*found, system));
    } else if (usual) {
      rules.push_back(make_rule({state, StartKind::expression, {*usual}, usual->place}, system));
    } else {
      rules.push_back(unit_box(design.states[state].shape));
    }
  }
  return rules;
}

Starts::Starts(const std::vector<StartRule>& rules, const System& system)
    : rules_(&rules), layout_(&system.layout) {
  for (const StartRule& rule : rules)
    if (rule.kind == StartKind::expression)
      expressions_.emplace_back(rule.program, system.layout, system.constants);
}

Eigen::VectorXd Starts::operator()(std::uint64_t run, RandomStream& random) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(layout_->size);
  std::size_t expression = 0;
  for (std::size_t i = 0; i < rules_->size(); ++i) {
    const StartRule& rule = (*rules_)[i];
    const Slot& slot = layout_->slots[i];
    auto part = x.segment(slot.offset, slot.shape.size());
    switch (rule.kind) {
      case StartKind::expression:
        part = expressions_[expression++](x, 0).reshaped();
        break;
      case StartKind::list:
        part = rule.values[run % rule.values.size()].reshaped();
        break;
      case StartKind::ellipsoid:
        part = draw_ellipsoid(rule, random);
        break;
      case StartKind::box: {
        const Eigen::VectorXd low = rule.values[0].reshaped();
        const Eigen::VectorXd high = rule.values[1].reshaped();
        for (Eigen::Index k = 0; k < part.size(); ++k)
          part(k) = low(k) + (high(k) - low(k)) * random.uniform();
        break;
      }
    }
  }
  return x;
}

}  // namespace gainsmith::hybrid
