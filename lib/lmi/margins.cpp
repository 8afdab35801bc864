#include "lmi/margins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "expr/compile.h"
#include "lmi/worst.h"

namespace gainsmith::lmi {

namespace {

/// The smallest eigenvalue met so far, and where.
struct Worst {
  double value = std::numeric_limits<double>::infinity();
  std::string point;

  void meet(double found, const std::string& where) {
    if (!(found < value)) return;
    value = found;
    point = where;
  }
};

/// The largest |element| of a term x_i B_i: what cancels in a block is known to rounding of this.
double term_size(const Block& block, const std::vector<double>& x) {
  double size = 0;
  for (const auto& [i, matrix] : block.terms) {
    const double factor = i == 0 ? 1.0 : std::abs(x[static_cast<std::size_t>(i) - 1]);
    size = std::max(size, factor * largest_element(matrix));
  }
  return size;
}

}  // namespace

bool is_kept(const model::Margin& margin) {
  constexpr double kSlack = 0.99;
  return margin.holds && (!margin.strict || margin.reached >= kSlack * margin.required);
}

Check check_margins(const model::Instance& instance, const Lmi& lmi,
                    const std::vector<double>& scales, bool homogeneous, double required,
                    const std::vector<double>& x) {
  constexpr double kRounding = 1e-11;
  double size = 0;
  for (const double value : x) size = std::max(size, std::abs(value));
  expr::Values values = instance.known_values();
  for (auto& [name, matrix] : lmi.unknowns.values(x)) values[name] = matrix;

  Check check;
  std::size_t at = 0;
  for (std::size_t k = 0; k < instance.method->require.size(); ++k) {
    const model::Requirement& requirement = instance.method->require[k];
    const Domain domain = domain_of(instance, requirement);
    for (const auto& relation :
         expr::compile_relations(requirement.that, scope_with(instance, domain))) {
      model::Margin margin;
      margin.name = lmi.blocks[at].name;
      margin.strict = relation.strict;
      margin.scale = scales[at] * (homogeneous ? size : 1.0);
      margin.required = relation.strict ? required : 0.0;
      Worst worst;
      double terms = 0;
      for (; at < lmi.blocks.size() && lmi.blocks[at].name == margin.name; ++at) {
        worst.meet(smallest_eigenvalue(lmi.blocks[at].value(x)), lmi.blocks[at].point);
        terms = std::max(terms, term_size(lmi.blocks[at], x));
      }
      const auto set = [&](double value) {
        margin.smallest_eigenvalue = value;
        margin.reached = margin.scale > 0 ? value / margin.scale : 0.0;
        margin.holds = relation.strict ? value > 0 : value >= -kRounding * terms;
      };
      for (const Minimum& minimum : local_minima(relation.difference, domain, values)) {
        worst.meet(minimum.value, minimum.point.label);
        set(minimum.value);
        if (!domain.empty() && !is_kept(margin)) check.violations.push_back({k, minimum.point});
      }
      set(worst.value);
      margin.worst_point = worst.point;
      check.margins.push_back(std::move(margin));
    }
  }
  return check;
}

}  // namespace gainsmith::lmi
