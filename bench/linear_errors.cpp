// Runs of a linear sampled plant as packs make them, beside 31 digits: linear_errors GAINS [RUNS].
//
// Of each run the value of each claim at its end, and whether its error is within the bound that the
// pack gives. The other side shares the model in 100 digits and the draws, and nothing else: the flow
// is a Taylor series, run by run. Exit code 1: an error is beyond its bound.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "base/parallel.h"
#include "gainsmith/load.h"
#include "linear/wide_function.h"
#include "verify/pack_judge.h"

namespace gainsmith {
namespace {

using D = DoubleDouble;
using Quad = numbers::MatrixOf<D>;
using Eigen::Index;

Quad rounded(const linear::Wide& x) {
  return x.unaryExpr([](const Decimal100& one) { return as<D>(one); });
}

D form(const Quad& Q, const Quad& x) {
  D sum(0);
  for (Index i = 0; i < x.rows(); ++i)
    for (Index j = 0; j < x.rows(); ++j) sum += x(i) * Q(i, j) * x(j);
  return sum;
}

Quad product(const Quad& M, const Quad& x) {
  Quad y = Quad::Zero(M.rows(), 1);
  for (Index i = 0; i < M.rows(); ++i)
    for (Index j = 0; j < M.cols(); ++j) y(i) += M(i, j) * x(j);
  return y;
}

class Reference {
 public:
  explicit Reference(const linear::LinearModel& model)
      : model_(model),
        A_(rounded(model.A)),
        B_(rounded(model.B)),
        S_(rounded(model.S)),
        J_(rounded(*model.D(Decimal100(model.high), false))) {
    for (const linear::LinearClaim& claim : model.claims) {
      flow_.push_back(claim.flow_cost ? rounded(*claim.flow_cost) : Quad());
      jump_.push_back(claim.jump_cost ? rounded(*claim.jump_cost) : Quad());
    }
  }

  /// By claim: the value as its finding has it.
  std::vector<D> run(std::uint64_t seed, std::uint64_t run) {
    const hybrid::System& system = *model_.sampled->dynamics;
    const hybrid::Scenario& scenario = *model_.scenario;
    const Eigen::VectorXd start = hybrid::draw_start(system, scenario, seed, run);
    Quad xi = Quad::Constant(static_cast<Index>(model_.drawn.size()) + (model_.constant ? 1 : 0), 1,
                             D(1));
    for (std::size_t k = 0; k < model_.drawn.size(); ++k)
      xi(static_cast<Index>(k)) =
          D(start(system.layout.slots[model_.drawn[k].variable].offset + model_.drawn[k].element));
    Quad x = product(S_, xi);
    hybrid::EventClocks clocks(system, scenario, seed, run);
    cost_.assign(model_.claims.size(), D(0));
    double t = 0;
    while (clocks.is_due(0, scenario.horizon)) {
      flow(x, clocks.length(0));
      for (std::size_t c = 0; c < jump_.size(); ++c)
        if (jump_[c].size() > 0) cost_[c] += form(jump_[c], x);
      x = product(B_, product(J_, x));
      t = clocks.due(0);
      clocks.advance(0, t);
      if (t >= scenario.horizon) break;
    }
    const double rest = t >= scenario.horizon ? 0 : scenario.horizon - t;
    flow(x, rest);
    std::vector<D> after = values(x, clocks.length(0) - rest);
    for (std::size_t c = 0; c < after.size(); ++c) {
      const linear::LinearClaim& claim = model_.claims[c];
      if (claim.kind == model::ClaimKind::cost) after[c] = cost_[c];
      if (claim.squared) after[c] = sqrt(after[c]);
    }
    return after;
  }

 private:
  std::vector<D> values(const Quad& x, double left) {
    std::vector<D> all;
    const linear::Wide zero = linear::Wide::Zero(model_.coordinates->layout.size, 1);
    for (const linear::LinearClaim& claim : model_.claims) {
      D& sum = all.emplace_back(0);
      for (const linear::LinearForm& one : claim.value) {
        D factor(1);
        if (one.factor) {
          linear::WideFunction function(*one.factor, model_.coordinates->layout,
                                        model_.coordinates->constants);
          factor = as<D>(function(zero, Decimal100(left))(0));
        }
        sum += factor * form(rounded(one.Q), x);
      }
    }
    return all;
  }

  void flow(Quad& x, double length) {
    double norm = 0;
    for (Index j = 0; j < A_.cols(); ++j) {
      double sum = 0;
      for (Index i = 0; i < A_.rows(); ++i) sum += std::abs(static_cast<double>(A_(i, j)));
      norm = std::max(norm, sum);
    }
    const int steps = std::max(1, static_cast<int>(std::ceil(2 * norm * length)));
    const D h = D(length) / D(steps);
    constexpr int kTerms = 24;  // 0.5^24/24! is below 1e-31
    for (int step = 0; step < steps; ++step) {
      std::vector<Quad> terms{x};  // of rising powers of time, times h^k
      for (int k = 1; k < kTerms; ++k) terms.emplace_back(product(A_, terms.back()) * (h / D(k)));
      for (std::size_t c = 0; c < flow_.size(); ++c) {
        if (flow_[c].size() == 0) continue;
        std::vector<Quad> turned;
        for (const Quad& one : terms) turned.push_back(product(flow_[c], one));
        for (int power = 0; power < kTerms; ++power) {
          D sum(0);
          for (int k = 0; k <= power; ++k)
            for (Index i = 0; i < x.rows(); ++i)
              sum += terms[static_cast<std::size_t>(k)](i) *
                     turned[static_cast<std::size_t>(power - k)](i);
          cost_[c] += sum * (h / D(power + 1));
        }
      }
      x = terms.back();
      for (int k = kTerms - 2; k >= 0; --k) x += terms[static_cast<std::size_t>(k)];
    }
  }

  const linear::LinearModel& model_;
  Quad A_, B_, S_, J_;
  std::vector<Quad> flow_, jump_;
  std::vector<D> cost_;
};

struct Sum {
  std::uint64_t open = 0, beyond = 0, values = 0;
  double largest = 0;  ///< part of a bound that an error takes
};

int compare(const std::string& file, std::uint64_t runs) {
  const app::LoadedGains loaded = app::load_run(file);
  const auto setup = verify::make_setup(loaded.stated, loaded.gains);
  const auto linear = verify::make_linear_packs(*setup);
  if (!linear || linear->model.jump->varies()) {
    std::cerr << file << ": no linear plant with a jump of constant coefficients\n";
    return 2;
  }
  constexpr std::uint64_t kBlock = 1024;
  std::vector<Sum> sums((runs + kBlock - 1) / kBlock);
  parallel_for(sums.size(), 0, [&](std::size_t block) {
    const std::uint64_t first = block * kBlock, last = std::min(runs, first + kBlock);
    const auto verdicts = packs::LinearRunner(*linear).run(1, first, last);
    Reference reference(linear->model);
    Sum& sum = sums[block];
    for (std::uint64_t run = first; run < last; ++run) {
      const packs::PackVerdict& pack = verdicts[run - first];
      if (pack.open) {
        ++sum.open;
        continue;
      }
      const std::vector<D> truth = reference.run(1, run);
      for (std::size_t c = 0; c < truth.size(); ++c) {
        const claims::Finding& claim = pack.findings[c];
        if (claim.violated() && linear->model.claims[c].kind == model::ClaimKind::nonincreasing)
          continue;
        const double error = std::abs(static_cast<double>(D(claim.value) - truth[c]));
        ++sum.values;
        if (!(error <= claim.rounding)) ++sum.beyond;
        if (claim.rounding > 0) sum.largest = std::max(sum.largest, error / claim.rounding);
      }
    }
  });
  Sum all;
  for (const Sum& one : sums) {
    all.open += one.open;
    all.beyond += one.beyond;
    all.values += one.values;
    all.largest = std::max(all.largest, one.largest);
  }
  fmt::print(
      "{}: {} runs, {} left open; {} values, {} beyond their bounds; an error takes at most {:.2g} "
      "of its bound\n",
      file, runs, all.open, all.values, all.beyond, all.largest);
  return all.beyond == 0 ? 0 : 1;
}

}  // namespace
}  // namespace gainsmith

int main(int count, char** arguments) {
  if (count < 2) {
    std::cerr << "linear_errors GAINS [RUNS]\n";
    return 2;
  }
  return gainsmith::compare(arguments[1],
                            count > 2 ? std::strtoull(arguments[2], nullptr, 10) : 100000);
}
