#include "linear/system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linear/graph.h"
#include "linear/proof.h"
#include "linear/tolerances.h"

namespace gainsmith::linear {

namespace {

using Eigen::Index;
using model::ClaimKind;
using numbers::times;

/// The factors of all forms of all claims, as functions of the timer.
class Factors {
 public:
  explicit Factors(const LinearModel& model)
      : zero_(Wide::Zero(model.coordinates->layout.size, 1)) {
    for (const LinearClaim& claim : model.claims)
      for (const LinearForm& form : claim.value) {
        functions_.emplace_back();
        if (form.factor)
          functions_.back().emplace(*form.factor, model.coordinates->layout,
                                    model.coordinates->constants);
      }
  }

  std::vector<Decimal100> operator()(const Decimal100& tau) {
    std::vector<Decimal100> values;
    for (auto& function : functions_)
      values.push_back(function ? (*function)(zero_, tau)(0) : Decimal100(1));
    return values;
  }

 private:
  Wide zero_;
  std::vector<std::optional<WideFunction>> functions_;
};

/// The upper triangle of a form, elements beside the diagonal doubled.
void append_form(const Wide& Q, std::vector<Decimal100>& values) {
  for (Index j = 0; j < Q.cols(); ++j)
    for (Index i = 0; i <= j; ++i)
      values.push_back(i == j ? Q(i, j) : Decimal100(Q(i, j) + Q(j, i)));
}

void append_rows(const Wide& M, Index rows, std::vector<Decimal100>& values) {
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < M.cols(); ++j) values.push_back(M(i, j));
}

/// The range of the jump is another one at some length.
struct RangeVaries {};

/// Functions of lengths in 100 digits. RangeVaries where they have none.
class Functions {
 public:
  explicit Functions(const LinearModel& model)
      : model_(model),
        factors_(model),
        at_0_(factors_(Decimal100(0))),
        flow_(model.A, flow_costs(model), model.longest()) {}

  Factors& factors() { return factors_; }
  const std::vector<Decimal100>& at_0() const { return at_0_; }

  /// Of a flow from x = X z and the jump at its end: M; of each claim F; of what is compared at jumps
  /// F_end; of costs C. In this order.
  std::vector<Decimal100> of_flow(const Wide& X, const Decimal100& s, bool first) {
    const WideFlow::Values flow = flow_(s);
    const Wide end = times<Decimal100>(flow.E, X);
    const auto D = model_.D(s, first);
    if (!D) throw RangeVaries();
    std::vector<Decimal100> values;
    append_rows(times<Decimal100>(*D, end), rows(*D), values);
    const std::vector<Decimal100> g = factors_(s);
    std::size_t k = 0;
    for (std::size_t c = 0; c < model_.claims.size(); ++c) {
      const LinearClaim& claim = model_.claims[c];
      append_form(moved(X, sum(claim, g, k)), values);
      if (is_compared(claim)) append_form(moved(end, sum(claim, at_0_, k)), values);
      k += claim.value.size();
      if (claim.kind == ClaimKind::cost) append_form(cost(c, X, end, flow, true), values);
    }
    return values;
  }

  /// Of a flow from x = X z without a jump: the end of x; of costs C.
  std::vector<Decimal100> of_rest(const Wide& X, const Decimal100& s) {
    const WideFlow::Values flow = flow_(s);
    const Wide end = times<Decimal100>(flow.E, X);
    std::vector<Decimal100> values;
    append_rows(end, rows(end), values);
    for (std::size_t c = 0; c < model_.claims.size(); ++c)
      if (model_.claims[c].kind == ClaimKind::cost)
        append_form(cost(c, X, end, flow, false), values);
    return values;
  }

  /// Of each claim that is compared at jumps, and of `below`, F.
  std::vector<Decimal100> of_length(const Wide& X, const Decimal100& s) {
    const std::vector<Decimal100> g = factors_(s);
    std::vector<Decimal100> values;
    std::size_t k = 0;
    for (const LinearClaim& claim : model_.claims) {
      if (is_compared(claim) || is_bounded(claim)) append_form(moved(X, sum(claim, g, k)), values);
      k += claim.value.size();
    }
    return values;
  }

  /// Rows of a map of [x; 1] that are not those of the constant.
  Index rows(const Wide& map) const { return map.rows() - (model_.constant ? 1 : 0); }

 private:
  /// sum_k g_k Q_k of one claim, with g from number `first` on.
  Wide sum(const LinearClaim& claim, const std::vector<Decimal100>& g, std::size_t first) const {
    Wide Q = Wide::Zero(model_.A.rows(), model_.A.rows());
    for (std::size_t k = 0; k < claim.value.size(); ++k) Q += claim.value[k].Q * g[first + k];
    return Q;
  }
  /// X'W X of the flow cost, and end'Q end of the jump cost, with end = E X just before the jump.
  Wide cost(std::size_t c, const Wide& X, const Wide& end, const WideFlow::Values& flow,
            bool jump) const {
    Wide C = Wide::Zero(X.cols(), X.cols());
    std::size_t k = 0;
    for (std::size_t before = 0; before < c; ++before)
      if (model_.claims[before].flow_cost) ++k;
    if (model_.claims[c].flow_cost) C += moved(X, flow.W[k]);
    if (jump && model_.claims[c].jump_cost) C += moved(end, *model_.claims[c].jump_cost);
    return C;
  }
  static std::vector<Wide> flow_costs(const LinearModel& model) {
    std::vector<Wide> forms;
    for (const LinearClaim& claim : model.claims)
      if (claim.flow_cost) forms.push_back(*claim.flow_cost);
    return forms;
  }

  const LinearModel& model_;
  Factors factors_;
  std::vector<Decimal100> at_0_;
  WideFlow flow_;
};

/// Whether all that must not increase falls along flows; marks what falls at jumps too.
bool all_fall(LinearModel& model, Functions& functions) {
  const auto factors = [&](double from, double to) {
    return make_wide_table(from, to,
                           [&](const Decimal100& tau) { return functions.factors()(tau); });
  };
  // Along a flow the timer is in [0, longest]; just after a jump it is in [low, high].
  const auto along = factors(0, model.longest());
  const auto after = factors(model.low, model.high);
  if (!along || !after) return false;
  const auto D = model.D(Decimal100(model.high), false);
  if (!D) return false;
  const Wide J = times<Decimal100>(model.B, *D);
  std::size_t k = 0;
  for (LinearClaim& claim : model.claims) {
    std::vector<FallingTerm> terms;
    for (const LinearForm& form : claim.value) terms.push_back({form.Q, k++});
    if (claim.kind != ClaimKind::nonincreasing) continue;
    if (!falls_along_flows(terms, model.A, *along)) return false;
    claim.falls = !model.jump->varies() && falls_at_jumps(terms, J, *after, functions.at_0());
  }
  return true;
}

/// How much |M|, its largest elements, makes of an error in one flow: its Perron root.
double growth_of(const LengthTable& step, std::size_t rank, std::size_t columns) {
  // Power iteration on a nonnegative matrix, from ones.
  std::vector<double> error(rank, 1), next(rank);
  double growth = 0;
  constexpr int iterations = 60;
  for (int k = 0; k < iterations; ++k) {
    for (std::size_t i = 0; i < rank; ++i) {
      next[i] = 0;
      for (std::size_t j = 0; j < rank; ++j)
        next[i] += step.functions[i * columns + j].size * error[j];
    }
    growth = rank == 0 ? 0 : *std::max_element(next.begin(), next.end());
    if (!(growth > 0)) return 0;
    for (std::size_t i = 0; i < rank; ++i) error[i] = next[i] / growth;
  }
  return growth;
}

/// So many that errors grow by kMostGrowth at most, and kMostFlowsOfBlock at most.
std::int64_t flows_of_block(double growth) {
  if (growth <= 1) return kMostFlowsOfBlock;
  const double flows = std::log(kMostGrowth) / std::log(growth);
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::min(flows, 1e3)), 1,
                                  kMostFlowsOfBlock);
}

std::optional<PieceTable> pieces(double from, double to, double shortest,
                                 const WideFunctions& functions) {
  try {
    return make_piece_table(from, to, shortest, functions);
  } catch (const RangeVaries&) {
    return std::nullopt;
  }
}

/// One piece over the range; none where the functions need more.
std::optional<LengthTable> table(double from, double to, const WideFunctions& functions) {
  const auto one = pieces(from, to, to, functions);
  return one ? std::optional(one->whole) : std::nullopt;
}

}  // namespace

std::unique_ptr<const LinearSystem> make_linear_system(LinearModel given) {
  auto system = std::make_unique<LinearSystem>();
  system->model = std::move(given);
  LinearModel& model = system->model;
  Functions functions(model);
  if (!all_fall(model, functions)) return nullptr;
  system->rank = model.jump_rows.size();
  system->carried = system->rank * (system->rank + 2);
  for (const LinearClaim& claim : model.claims) {
    const std::size_t count = is_compared(claim) ? kComparedNumbers + (claim.tolerance > 0 ? 1 : 0)
                              : claim.kind == ClaimKind::cost ? kCostNumbers
                              : is_bounded(claim)             ? kPeakNumbers
                                                              : 0;
    system->claims.push_back({system->carried, count});
    system->carried += count;
  }
  const double norm = flow_norm(model.A, model.longest());
  // |A| times the first piece is kLongestPiece at most.
  const double shortest = model.longest() * (norm > kLongestPiece ? kLongestPiece / norm : 1);
  auto first = pieces(model.first_low, model.first_high, shortest,
                      [&](const Decimal100& s) { return functions.of_flow(model.S, s, true); });
  const auto step = table(model.low, model.high, [&](const Decimal100& s) {
    return functions.of_flow(model.B, s, false);
  });
  auto rest = pieces(0, model.high, shortest,
                     [&](const Decimal100& s) { return functions.of_rest(model.B, s); });
  const auto length = table(model.low, model.high,
                            [&](const Decimal100& s) { return functions.of_length(model.B, s); });
  const auto left =
      table(0, model.high, [&](const Decimal100& tau) { return functions.factors()(tau); });
  if (!first || !step || !rest || !length || !left) return nullptr;
  system->flows_of_block =
      flows_of_block(growth_of(*step, system->rank, static_cast<std::size_t>(model.B.cols())));
  add_code({*first, *step, *rest, *length, *left}, *system);
  system->first_table = std::move(*first);
  system->rest_table = std::move(*rest);
  return system;
}

}  // namespace gainsmith::linear
