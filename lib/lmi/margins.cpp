#include "lmi/margins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forall/between.h"
#include "forall/worst.h"
#include "numbers/dense.h"

namespace gainsmith::lmi {

namespace {

/// The smallest eigenvalue met so far, and where.
struct Worst {
  double value = std::numeric_limits<double>::infinity();
  std::string point;

  void meet(double found, const std::string& where) {
    // What is no number is worse than any number.
    if (std::isnan(value) || found >= value) return;
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

namespace {

/// The margins of one instance, inequality by inequality.
class Checker {
 public:
  Checker(const Inequalities& of, const Lmi& lmi, const forall::Plan& plan,
          const std::vector<double>& scales, const std::vector<double>& x)
      : of_(of), lmi_(lmi), plan_(plan), scales_(scales), x_(x), values_(of.instance.values) {
    for (auto& [name, matrix] : of.unknowns.values(x)) values_[name] = matrix;
  }

  Margins run(bool homogeneous, double required) {
    double size = 1;
    if (homogeneous) {
      size = 0;
      for (const double value : x_) size = std::max(size, std::abs(value));
    }
    for (std::size_t k = 0; k < of_.statements.size(); ++k) {
      const Statement& statement = of_.statements[k];
      for (std::size_t c = 0; c < statement.differences.size(); ++c)
        add(k, statement.differences[c], statement.stated->comparisons[c], size,
            statement.stated->comparisons[c].strict ? required : 0.0);
    }
    return std::move(result_);
  }

 private:
  static constexpr double kRounding = 1e-11;

  /// The next inequality: its blocks are the next ones of the same name.
  void add(std::size_t inequality, const expr::Program& difference,
           const model::Design::Comparison& comparison, double size, double required) {
    const forall::Domain& domain = of_.statements[inequality].domain;
    model::Margin margin;
    margin.name = comparison.name;
    margin.strict = comparison.strict;
    margin.scale = scales_[at_] * size;
    margin.required = required;
    Worst worst;
    double terms = 0;
    for (; at_ < lmi_.blocks.size() && lmi_.blocks[at_].name == margin.name; ++at_) {
      worst.meet(numbers::smallest_eigenvalue(lmi_.blocks[at_].value(x_)), lmi_.blocks[at_].point);
      terms = std::max(terms, term_size(lmi_.blocks[at_], x_));
    }
    const auto set = [&](double value) {
      margin.smallest_eigenvalue = value;
      margin.reached = margin.scale > 0 ? value / margin.scale : 0.0;
      margin.holds =
          std::isfinite(value) && (comparison.strict ? value > 0 : value >= -kRounding * terms);
    };
    const std::size_t violations = result_.violations.size();
    const auto meet = [&](const forall::Minimum& minimum) {
      worst.meet(minimum.value, minimum.point.label);
      set(minimum.value);
      if (!domain.empty() && !is_kept(margin))
        result_.violations.push_back({inequality, minimum.point});
    };
    const forall::Minima minima = forall::local_minima(difference, domain, values_);
    for (const forall::Minimum& minimum : minima.list) meet(minimum);
    if (result_.violations.size() == violations &&
        plan_.inequalities[inequality].way == model::Way::exchange)
      for (const forall::Minimum& violation :
           look_between(domain, difference, comparison, terms, minima.resolved))
        meet(violation);
    set(worst.value);
    margin.worst_point = worst.point;
    result_.margins.push_back(std::move(margin));
  }

  /// The points that show that the inequality does not hold. What has no known derivatives must
  /// at least have been resolved by the search.
  std::vector<forall::Minimum> look_between(const forall::Domain& domain,
                                            const expr::Program& difference,
                                            const model::Design::Comparison& comparison,
                                            double terms, bool resolved) {
    // What may be 0 is bounded up to a part of its terms that is small for them, and large enough
    // to be reached with few pieces.
    constexpr double kAllowed = 1e-7;
    using Status = forall::DomainBound::Status;
    if (forall::intervals(domain).empty()) return {};
    const auto expand = [&](const forall::Point& fixed, forall::MonomialTable& monomials) {
      return expansion(difference, fixed, monomials);
    };
    forall::DomainBound bound =
        forall::bound_on_domain(expand, domain, comparison.strict ? 0.0 : kAllowed * terms);
    if (bound.status == Status::unknown) {
      result_.searched = true;
      if (!resolved) leave_open(comparison.name, "it grows without end within the interval");
    }
    if (bound.status == Status::open) leave_open(comparison.name, "not settled for " + bound.where);
    return std::move(bound.violations);
  }

  /// The difference as a combination of functions of its variables; none when it is no such.
  std::optional<forall::Expansion> expansion(const expr::Program& difference,
                                             const forall::Point& fixed,
                                             forall::MonomialTable& monomials) const {
    try {
      return expansion_of(evaluate_at(difference, Unknowns{}, monomials, values_, fixed));
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  void leave_open(const std::string& name, const std::string& what) {
    result_.open += (result_.open.empty() ? "" : "; ") + name + ": " + what;
  }

  const Inequalities& of_;
  const Lmi& lmi_;
  const forall::Plan& plan_;
  const std::vector<double>& scales_;
  const std::vector<double>& x_;
  numbers::Values values_;
  std::size_t at_ = 0;
  Margins result_;
};

}  // namespace

Margins compute_margins(const Inequalities& of, const Lmi& lmi, const forall::Plan& plan,
                        const std::vector<double>& scales, bool homogeneous, double required,
                        const std::vector<double>& x) {
  return Checker(of, lmi, plan, scales, x).run(homogeneous, required);
}

}  // namespace gainsmith::lmi
