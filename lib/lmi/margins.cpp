#include "lmi/margins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "expr/compile.h"
#include "lmi/prove.h"
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

namespace {

/// The margins of one instance, inequality by inequality.
class Checker {
 public:
  Checker(const model::Instance& instance, const Lmi& lmi, const Plan& plan,
          const std::vector<double>& scales, const std::vector<double>& x)
      : instance_(instance),
        lmi_(lmi),
        plan_(plan),
        scales_(scales),
        x_(x),
        values_(instance.known_values()) {
    for (auto& [name, matrix] : lmi.unknowns.values(x)) values_[name] = matrix;
  }

  Check run(bool homogeneous, double required) {
    double size = 1;
    if (homogeneous) {
      size = 0;
      for (const double value : x_) size = std::max(size, std::abs(value));
    }
    for (std::size_t k = 0; k < instance_.method->require.size(); ++k) {
      const model::Requirement& requirement = instance_.method->require[k];
      const Domain domain = domain_of(instance_, requirement);
      for (const auto& relation :
           expr::compile_relations(requirement.that, scope_with(instance_, domain)))
        add(k, domain, relation, size, relation.strict ? required : 0.0);
    }
    return std::move(check_);
  }

 private:
  static constexpr double kRounding = 1e-11;

  /// The next inequality: its blocks are the next ones of the same name.
  void add(std::size_t requirement, const Domain& domain, const expr::CompiledRelation& relation,
           double size, double required) {
    model::Margin margin;
    margin.name = lmi_.blocks[at_].name;
    margin.strict = relation.strict;
    margin.scale = scales_[at_] * size;
    margin.required = required;
    Worst worst;
    double terms = 0;
    for (; at_ < lmi_.blocks.size() && lmi_.blocks[at_].name == margin.name; ++at_) {
      worst.meet(smallest_eigenvalue(lmi_.blocks[at_].value(x_)), lmi_.blocks[at_].point);
      terms = std::max(terms, term_size(lmi_.blocks[at_], x_));
    }
    const auto set = [&](double value) {
      margin.smallest_eigenvalue = value;
      margin.reached = margin.scale > 0 ? value / margin.scale : 0.0;
      margin.holds = relation.strict ? value > 0 : value >= -kRounding * terms;
    };
    const std::size_t violations = check_.violations.size();
    const auto meet = [&](const Minimum& minimum) {
      worst.meet(minimum.value, minimum.point.label);
      set(minimum.value);
      if (!domain.empty() && !is_kept(margin))
        check_.violations.push_back({requirement, minimum.point});
    };
    const Minima minima = local_minima(relation.difference, domain, values_);
    for (const Minimum& minimum : minima.list) meet(minimum);
    if (check_.violations.size() == violations &&
        plan_.requirements[requirement].way == model::Way::exchange)
      for (const Minimum& violation : prove(margin.name, domain, relation, terms, minima.resolved))
        meet(violation);
    set(worst.value);
    margin.worst_point = worst.point;
    check_.margins.push_back(std::move(margin));
  }

  /// The points that show that the inequality does not hold. What has no known derivatives must
  /// at least have been resolved by the search.
  std::vector<Minimum> prove(const std::string& name, const Domain& domain,
                             const expr::CompiledRelation& relation, double terms, bool resolved) {
    // What may be 0 is proved up to a part of its terms that is small for them, and large enough
    // to be reached with few pieces.
    constexpr double kAllowed = 1e-7;
    using Status = DomainProof::Status;
    if (intervals(domain).empty()) return {};
    DomainProof proof = prove_on_domain(relation.difference, domain, values_,
                                        relation.strict ? 0.0 : kAllowed * terms);
    if (proof.status == Status::unknown) {
      check_.searched = true;
      if (!resolved) leave_open(name, "it grows without end within the interval");
    }
    if (proof.status == Status::open) leave_open(name, "not settled for " + proof.where);
    return std::move(proof.violations);
  }

  void leave_open(const std::string& name, const std::string& what) {
    check_.open += (check_.open.empty() ? "" : "; ") + name + ": " + what;
  }

  const model::Instance& instance_;
  const Lmi& lmi_;
  const Plan& plan_;
  const std::vector<double>& scales_;
  const std::vector<double>& x_;
  numbers::Values values_;
  std::size_t at_ = 0;
  Check check_;
};

}  // namespace

Check check_margins(const model::Instance& instance, const Lmi& lmi, const Plan& plan,
                    const std::vector<double>& scales, bool homogeneous, double required,
                    const std::vector<double>& x) {
  return Checker(instance, lmi, plan, scales, x).run(homogeneous, required);
}

}  // namespace gainsmith::lmi
