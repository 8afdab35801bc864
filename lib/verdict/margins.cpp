#include "verdict/margins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "forall/worst.h"
#include "lmi/correlation.h"
#include "numbers/dense/dense.h"
#include "verdict/printed_check.h"
#include "verdict/rational_blocks.h"

namespace gainsmith::verdict {

namespace {

/// The smallest margin (lmi/correlation.h) met so far, and the label of its point.
struct Worst {
  double value = std::numeric_limits<double>::infinity();
  std::string point;

  /// Whether it is the worst so far.
  bool meet(double found, const std::string& where) {
    if (found >= value) return false;
    value = found;
    point = where;
    return true;
  }
};

/// A bound of the rounding of B(x), relative to its diagonal: (t + n) eps |D^-1/2 T D^-1/2|_inf
/// with T = sum_i |x_i| |B_i| elementwise, t terms, D = diag(B(x)). Where a diagonal element is not
/// positive, the largest element of its row takes its place.
double rounding_of(const lmi::Block& block, const numbers::Matrix& value,
                   const std::vector<double>& x) {
  numbers::Matrix terms = numbers::Matrix::Zero(block.size, block.size);
  for (const auto& [i, matrix] : block.terms) {
    const double factor = i == 0 ? 1.0 : std::abs(x[static_cast<std::size_t>(i) - 1]);
    for (int k = 0; k < matrix.outerSize(); ++k)
      for (lmi::Sparse::InnerIterator it(matrix, k); it; ++it)
        terms(it.row(), it.col()) += factor * std::abs(it.value());
  }
  numbers::Vector scale(block.size);
  for (int r = 0; r < block.size; ++r) {
    const double size = value(r, r) > 0 ? value(r, r) : value.row(r).cwiseAbs().maxCoeff();
    scale[r] = size > 0 ? 1 / std::sqrt(size) : 0;
  }
  const numbers::Matrix relative = scale.asDiagonal() * terms * scale.asDiagonal();
  const double count = static_cast<double>(block.terms.size()) + block.size;
  return count * std::numeric_limits<double>::epsilon() * relative.rowwise().sum().maxCoeff();
}

/// The largest difference of an element, rounded upward.
double distance(const std::vector<double>& x, const std::vector<Rational>& solution) {
  Rational largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    largest = std::max<Rational>(largest, abs(Rational(printed_fraction(x[i]) - solution[i])));
  return std::nextafter(nearest_double(largest), std::numeric_limits<double>::infinity());
}

}  // namespace

bool all_hold(const Margins& margins) {
  return margins.open.empty() && std::ranges::all_of(margins.margins, &model::Margin::holds);
}

namespace {

/// The margins of one instance, inequality by inequality.
class Checker {
 public:
  Checker(const lmi::Inequalities& of, const lmi::Lmi& lmi, const lmi::Balance& balance,
          const std::vector<double>& x, const CheckOptions& options)
      : of_(of),
        lmi_(lmi),
        balance_(balance),
        x_(x),
        describe_(options.describe),
        values_(of.instance.values),
        printed_(of, x, options.most_pieces, options.solution) {
    if (options.solution != nullptr) result_.solution_within = distance(x, *options.solution);
    for (auto& [name, matrix] : of.unknowns.values(x)) values_[name] = matrix;
  }

  Margins run(double wished) {
    for (std::size_t k = 0; k < of_.statements.size(); ++k) {
      const lmi::Statement& statement = of_.statements[k];
      for (std::size_t c = 0; c < statement.differences.size(); ++c)
        add(k, statement.differences[c], c, statement.stated->comparisons[c].strict ? wished : 0.0);
    }
    return std::move(result_);
  }

 private:
  /// The next inequality: its blocks are the next ones of the same name.
  /// Its margin is the smallest over the imposed points and over the minima that a search finds.
  /// The search is left out where the check of the decimals comes first and holds.
  void add(std::size_t inequality, const expr::Program& difference, std::size_t comparison,
           double wished) {
    const model::Design::Comparison& stated =
        of_.statements[inequality].stated->comparisons[comparison];
    const forall::Domain& domain = of_.statements[inequality].domain;
    model::Margin margin;
    margin.name = stated.name;
    margin.strict = stated.strict;
    margin.required = wished;
    Worst worst;
    double rounding = 0;
    const numbers::Vector rows = rows_of_next();
    const auto meet = [&](const numbers::Matrix& value, const std::string& label) {
      const double reached = lmi::correlation_margin(value);
      if (worst.meet(reached, label))
        margin.smallest_eigenvalue = numbers::smallest_eigenvalue(value);
      return reached >= -rounding;
    };
    for (; at_ < lmi_.blocks.size() && lmi_.blocks[at_].name == margin.name; ++at_) {
      const numbers::Matrix value = lmi_.blocks[at_].value(x_);
      rounding = std::max(rounding, rounding_of(lmi_.blocks[at_], value, x_));
      meet(value, lmi_.blocks[at_].point);
    }
    const std::size_t violations = result_.violations.size();
    const auto meet_point = [&](const forall::Minimum& minimum) {
      const bool holds =
          meet(forall::matrix_at(difference, minimum.point, values_), minimum.point.label);
      if (!domain.empty() && !holds)
        result_.violations.push_back({inequality, minimum.point, false});
    };
    const bool blocks_hold = worst.value >= -rounding;
    std::optional<forall::DomainProof> proof;
    if (!describe_ && blocks_hold) proof = printed_.check(inequality, comparison);
    const bool shown = proof && proof->status == forall::DomainProof::Status::holds;
    if (!shown) {
      const auto meet_minima = [&](forall::Measure measure) {
        for (const forall::Minimum& minimum :
             forall::local_minima(difference, domain, values_, rows, measure))
          meet_point(minimum);
      };
      meet_minima(forall::Measure::eigenvalue);
      if (describe_ && worst.value >= -rounding) meet_minima(forall::Measure::margin);
    }
    margin.reached = worst.value;
    margin.worst_point = worst.point;
    margin.holds = shown || (result_.violations.size() == violations && worst.value >= -rounding &&
                             check(inequality, comparison, margin.name, std::move(proof)));
    margin.fails =
        !margin.holds && (worst.value < -rounding || result_.violations.size() > violations);
    // What is below 0 is then rounding: the decimals hold.
    if (margin.holds) {
      margin.reached = std::max(margin.reached, 0.0);
      margin.smallest_eigenvalue = std::max(margin.smallest_eigenvalue, 0.0);
    }
    result_.margins.push_back(std::move(margin));
  }

  /// The units of the rows of the next block.
  numbers::Vector rows_of_next() const {
    if (at_ == lmi_.blocks.size()) return {};
    numbers::Vector rows(lmi_.blocks[at_].size);
    for (int r = 0; r < rows.size(); ++r) rows[r] = balance_.row(at_, r);
    return rows;
  }

  /// Whether it holds at the printed decimals for all values of its variables; what does not is
  /// noted.
  bool check(std::size_t inequality, std::size_t comparison, const std::string& name,
             std::optional<forall::DomainProof> known) {
    using Status = forall::DomainProof::Status;
    const forall::DomainProof proof =
        known ? std::move(*known) : printed_.check(inequality, comparison);
    if (proof.status == Status::fails) {
      // Points at which it fails by less than double tells would be added without end.
      constexpr double kTells = 1e-13;
      const bool tells = !proof.point || lmi::correlation_margin(forall::matrix_at(
                                             of_.statements[inequality].differences[comparison],
                                             *proof.point, values_)) < -kTells;
      if (tells && !of_.statements[inequality].domain.empty())
        result_.violations.push_back({inequality, *proof.point, true});
      if (!tells)
        leave_open(name, "it fails by less than double tells" +
                             (proof.point->label.empty() ? "" : " at " + proof.point->label));
    }
    if (proof.status == Status::open)
      leave_open(name, (proof.where.empty() ? "" : "not settled for " + proof.where + ": ") +
                           proof.reason);
    return proof.status == Status::holds;
  }

  void leave_open(const std::string& name, const std::string& what) {
    result_.open += (result_.open.empty() ? "" : "; ") + name + ": " + what;
  }

  const lmi::Inequalities& of_;
  const lmi::Lmi& lmi_;
  const lmi::Balance& balance_;
  const std::vector<double>& x_;
  bool describe_;
  numbers::Values values_;
  PrintedCheck printed_;
  std::size_t at_ = 0;
  Margins result_;
};

}  // namespace

Margins compute_margins(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                        const lmi::Balance& balance, double wished, const std::vector<double>& x,
                        const CheckOptions& options) {
  return Checker(of, lmi, balance, x, options).run(wished);
}

}  // namespace gainsmith::verdict
