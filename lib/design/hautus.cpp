#include "design/hautus.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "base/named.h"
#include "base/number.h"
#include "expr/program/evaluate.h"
#include "forall/minima.h"
#include "numbers/dense/dense.h"
#include "numbers/types/dual.h"
#include "numerics/balance.h"

namespace gainsmith::design {

namespace {

constexpr double kRank = 1e-11;    // relative, of [A - lambda I; C] with rows of size 1
constexpr double kStable = 1e-12;  // of |A|: an eigenvalue on the axis is known to that

/// 2n x 2n or 2(n+p) x 2n: the complex matrix X + iY as [X, -Y; Y, X].
numbers::Matrix real_form(const numbers::Matrix& X, const numbers::Matrix& Y) {
  numbers::Matrix whole(2 * X.rows(), 2 * X.cols());
  whole << X, -Y, Y, X;
  return whole;
}

/// [A - lambda I; C] in real form, 2 (n + p) x 2 n.
numbers::Matrix hautus_matrix(const numbers::Matrix& A, const numbers::Matrix& C,
                              std::complex<double> lambda) {
  const Eigen::Index n = A.rows();
  numbers::Matrix X(n + C.rows(), n);
  X << A - lambda.real() * numbers::Matrix::Identity(n, n), C;
  numbers::Matrix Y = numbers::Matrix::Zero(n + C.rows(), n);
  Y.topRows(n) = -lambda.imag() * numbers::Matrix::Identity(n, n);
  return real_form(X, Y);
}

/// With the digits that are known, one at least; what may as well be 0 says to what.
std::string known_part(double value, double accuracy) {
  constexpr int kDigits = 4;
  if (value == 0) return "0";
  const double digits = std::ceil(std::log10(std::abs(value) / accuracy));
  if (!(digits >= 1)) return "0 (to " + brief(accuracy, 1) + ")";
  return brief(value, static_cast<int>(std::min<double>(digits, kDigits)));
}

/// "0.25 +- 3i".
std::string eigenvalue_text(const HiddenMode& mode) {
  const double imaginary = mode.eigenvalue.imag();
  return known_part(mode.eigenvalue.real(), mode.accuracy) +
         (imaginary > 0 ? " +- " + known_part(imaginary, mode.accuracy) + "i" : "");
}

/// "[1; 0; -0.5]": what is below `nothing` is 0.
std::string direction_text(const HiddenMode& mode, double nothing = kRank) {
  std::string text;
  for (const double element : mode.direction)
    text += (text.empty() ? "[" : "; ") + brief(std::abs(element) < nothing ? 0 : element, 4);
  return text + "]";
}

bool is_declared(const model::Design& design, const std::string& name, bool square) {
  return std::any_of(design.data.begin(), design.data.end(), [&](const auto& datum) {
    return datum.name == name && (!square || datum.shape.rows == datum.shape.cols);
  });
}

/// The largest element of each row.
numbers::Vector row_sizes(const numbers::Matrix& C) {
  return C.cols() == 0 ? numbers::Vector::Zero(C.rows())
                       : numbers::Vector(C.cwiseAbs().rowwise().maxCoeff());
}

/// The smallest singular value of [A - lambda I; C] over its largest.
double hautus_residual(const numbers::Matrix& A, const numbers::Matrix& C,
                       std::complex<double> lambda) {
  const numbers::Vector s = numbers::singular_values(hautus_matrix(A, C, lambda));
  return s.tail(1)(0) / s(0);
}

/// An eigenvalue of a Jordan block is known to the root of rounding: a part that may be 0 is 0,
/// where the rank is lost there too.
std::complex<double> snapped(const numbers::Matrix& A, const numbers::Matrix& C,
                             std::complex<double> lambda) {
  constexpr double kRoot = 1e-6;  // of |A|
  const auto part = [](double x) { return kStable < std::abs(x) && std::abs(x) < kRoot ? 0 : x; };
  const std::complex<double> axis(part(lambda.real()), part(lambda.imag()));
  return axis != lambda && hautus_residual(A, C, axis) <= kRank ? axis : lambda;
}

/// Of the largest size, with its sign.
double largest(const numbers::Vector& v) {
  Eigen::Index at = 0;
  v.cwiseAbs().maxCoeff(&at);
  return v(at);
}

/// Modes that decay are of no interest to what asks for the others.
bool is_left_out(std::complex<double> lambda, double accuracy, Modes which) {
  return which == Modes::not_decaying    ? lambda.real() < -accuracy
         : which == Modes::not_shrinking ? std::abs(lambda) < 1 - accuracy
                                         : false;
}

/// The eigenvalues of A (n x n) in the upper half plane that are asked for, with what the output C
/// (p x n) shows of them; the rows of C in units of `sizes`. A is divided by its largest row sum.
/// The direction is the last right singular vector of [A - lambda I; C], its largest element 1.
std::vector<HiddenMode> modes_of(const numbers::Matrix& A, const numbers::Matrix& C,
                                 const numbers::Vector& sizes, Modes which) {
  const Eigen::Index n = A.rows();
  if (n == 0 || !A.allFinite() || !C.allFinite()) return {};
  const double size = A.cwiseAbs().rowwise().sum().maxCoeff();
  if (size == 0) return {};
  numbers::Matrix rows = C;
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    if (sizes(i) > 0) rows.row(i) /= sizes(i);
  std::vector<HiddenMode> modes;
  const numbers::ComplexVector eigenvalues = numbers::eigenvalues(A / size);
  for (const std::complex<double>& found : eigenvalues) {
    if (found.imag() < 0) continue;
    const std::complex<double> lambda = snapped(A / size, rows, found);
    if (is_left_out(lambda * size, kStable * size, which)) continue;
    const numbers::Svd svd = numbers::full_svd(hautus_matrix(A / size, rows, lambda));
    numbers::Vector v = svd.V.col(2 * n - 1).head(n);
    const numbers::Vector imaginary = svd.V.col(2 * n - 1).tail(n);
    if (imaginary.norm() > v.norm()) v = imaginary;
    modes.push_back({lambda * size, v / largest(v), svd.s.tail(1)(0) / svd.s(0), kStable * size});
  }
  return modes;
}

/// The one farthest right of those that the output does not show.
std::optional<HiddenMode> hidden_among(const std::vector<HiddenMode>& modes, double tells) {
  std::optional<HiddenMode> found;
  for (const HiddenMode& mode : modes)
    if (mode.residual <= tells && (!found || mode.eigenvalue.real() > found->eigenvalue.real()))
      found = mode;
  return found;
}

/// A formula of the plant and its slope by the state, everything else that moves being 0.
/// Slopes by automatic differentiation (numbers/types/dual.h).
class Linearised {
 public:
  Linearised(Linearised&&) = delete;  // the evaluator reads the members

  Linearised(const expr::Program& program, const std::string& state, const model::Instance& of)
      : evaluator_(program), state_(state) {
    for (const expr::Input& input : program.inputs) {
      if (input.name == state) continue;
      const auto value = of.values.find(input.name);
      const numbers::Matrix fixed = value != of.values.end()
                                        ? value->second
                                        : numbers::Matrix::Zero(input.shape.rows, input.shape.cols);
      evaluator_.fix(input.name, others_.emplace_back(numbers::constant_dual<double>(fixed)));
    }
    evaluator_.set(state_, at_);
  }

  /// Empty where there is none.
  numbers::Matrix slope(const numbers::Vector& x) {
    at_ = numbers::variable_dual<double>(x);
    try {
      const numbers::Matrix slope = evaluator_.run().slope;
      return slope.cols() == x.size() && slope.allFinite() ? slope : numbers::Matrix();
    } catch (const expr::EvaluationError&) {
      return {};
    }
  }

 private:
  expr::Evaluator<numbers::DualNumbers<double>> evaluator_;
  std::string state_;
  numbers::Dual<double> at_;
  std::deque<numbers::Dual<double>> others_;
};

/// The box of a state in a domain; empty ends where the domain does not give it.
struct StateBox {
  std::vector<double> low, high;

  StateBox(const forall::Domain& domain, const std::string& state, int size) {
    for (int k = 1; k <= size; ++k)
      for (const forall::Variable* axis : forall::intervals(domain))
        if (axis->name == state + "_" + std::to_string(k)) {
          low.push_back(axis->low);
          high.push_back(axis->high);
        }
    if (std::ssize(low) != size) low = high = {};
  }

  /// The point of the diagonal of the box at this fraction, 0 its lowest corner.
  std::vector<double> at(double part) const {
    std::vector<double> x = low;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += part * (high[k] - low[k]);
    return x;
  }
};

/// A plant x' = f(x), y = h(x), linearised at points of a box.
class Linearisation {
 public:
  Linearisation(const expr::Program& f, const expr::Program& h, const std::string& state,
                const model::Instance& of, const StateBox& box)
      : plant_(f, state, of), output_(h, state, of) {
    for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0})
      if (const auto C = output_.slope(column(box.at(part))); C.size() > 0)
        sizes_ = sizes_.size() == 0 ? row_sizes(C) : sizes_.cwiseMax(row_sizes(C)).eval();
  }

  /// Of A = df/dx and C = dh/dx at a point, n x n and p x n; empty where one has no value.
  std::vector<HiddenMode> modes(const std::vector<double>& at) {
    const numbers::Matrix A = plant_.slope(column(at)), C = output_.slope(column(at));
    if (A.size() == 0 || C.rows() != sizes_.size()) return {};
    return modes_of(A, C, sizes_, Modes::not_decaying);
  }

 private:
  static numbers::Vector column(const std::vector<double>& at) {
    return numbers::Vector::Map(at.data(), std::ssize(at));
  }

  Linearised plant_, output_;
  numbers::Vector sizes_;  ///< of the rows of C
};

}  // namespace

std::optional<HiddenMode> hidden_mode(const numbers::Matrix& A, const numbers::Matrix& C,
                                      Modes modes) {
  // Balanced coordinates: D^-1 A D and C D, with powers of two in D.
  const std::vector<int> units = numerics::units(A.cwiseAbs(), C.cwiseAbs());
  numbers::Vector D(A.rows());
  for (Eigen::Index i = 0; i < D.size(); ++i)
    D(i) = std::ldexp(1, units[static_cast<std::size_t>(i)]);
  const numbers::Matrix scaled = C * D.asDiagonal();
  auto found = hidden_among(modes_of(D.cwiseInverse().asDiagonal() * A * D.asDiagonal(), scaled,
                                     row_sizes(scaled), modes),
                            kRank);
  if (found) {
    found->direction.array() *= D.array();
    found->direction /= largest(found->direction);
  }
  return found;
}

namespace {

/// The data A and `name`, with as many columns or rows; none where one is missing.
std::optional<std::pair<numbers::Matrix, numbers::Matrix>> pair_of(const model::Instance& instance,
                                                                   const std::string& name) {
  const auto A = instance.values.find("A");
  const auto other = instance.values.find(name);
  if (A == instance.values.end() || other == instance.values.end()) return std::nullopt;
  if (!is_declared(*instance.design, "A", true) || !is_declared(*instance.design, name, false))
    return std::nullopt;
  return std::pair(A->second, other->second);
}

/// Whether the plant's state flows by a gain through `input`.
bool is_driven(const model::Design& design, const std::string& input) {
  if (!design.dynamics || design.states.empty()) return false;
  const auto uses = [&](const expr::Program& flow) {
    return flow.uses(input) && std::any_of(design.gains.begin(), design.gains.end(),
                                           [&](const auto& gain) { return flow.uses(gain.name); });
  };
  const auto& flow = design.dynamics->flow;
  return std::any_of(flow.begin(), flow.end(), [&](const auto& each) {
    return design.dynamics->variables[each.variable].name == design.states.front().name &&
           uses(each.value.program);
  });
}

/// Whether the output y shows the state through C; C2 may be a matrix of something else.
bool is_shown(const model::Design& design, const std::string& name) {
  if (name == "C") return true;
  if (!design.dynamics) return false;
  const auto& signals = design.dynamics->signals;
  return std::any_of(signals.begin(), signals.end(), [&](const auto& signal) {
    return signal.name == "y" && signal.value.program.uses(name);
  });
}

std::string unseen_mode_text(const HiddenMode& mode, const std::string& output) {
  return "the output does not show a mode of the plant that does not decay: eigenvalue " +
         eigenvalue_text(mode) + " in the direction " + direction_text(mode) +
         ", where [A - lambda*I; " + output +
         "] loses rank (Hautus); no gain changes it, so another output is needed";
}

/// A mode that no input reaches, of a plant that gains drive.
std::string unreached_mode_text(const model::Instance& instance) {
  for (const char* name : {"B", "B2"}) {
    const auto pair = is_driven(*instance.design, name) ? pair_of(instance, name) : std::nullopt;
    if (!pair || pair->second.rows() != pair->first.rows()) continue;
    if (const auto mode = hidden_mode(pair->first.transpose(), pair->second.transpose()))
      return "the input does not reach a mode of the plant that does not decay: eigenvalue " +
             eigenvalue_text(*mode) + " in the combination " + direction_text(*mode) +
             " of the states, where [A - lambda*I, " + name +
             "] loses rank (Hautus); no gain changes it, so another input is needed";
  }
  return "";
}

/// The equation of the only state of a plant: its flow, or its new value at the only event.
const expr::Program* state_equation(const model::Dynamics& dynamics, bool& jumps) {
  jumps = dynamics.flow.empty();
  if (dynamics.flow.size() == 1) return &dynamics.flow.front().value.program;
  if (!jumps || dynamics.reactions.size() != 1) return nullptr;
  const auto& passes = dynamics.reactions.front().passes;
  return passes.size() == 1 && passes.front().map.size() == 1
             ? &passes.front().map.front().value.program
             : nullptr;
}

/// A mode of a plant x' = A x or x+ = A x that nothing here is designed to move.
std::string own_mode_text(const model::Instance& instance) {
  const model::Design& design = *instance.design;
  const auto A = instance.values.find("A");
  if (!design.gains.empty() || !design.dynamics || design.states.size() != 1 ||
      A == instance.values.end() || !is_declared(design, "A", true) || A->second.size() == 0)
    return "";
  bool jumps = false;
  const expr::Program* const equation = state_equation(*design.dynamics, jumps);
  if (equation == nullptr || !equation->functions.empty()) return "";
  const std::string& state = design.states.front().name;
  const numbers::Matrix slope =
      Linearised(*equation, state, instance).slope(numbers::Vector::Zero(A->second.rows()));
  if (slope.size() == 0 || slope != A->second) return "";
  const numbers::Matrix nothing(0, slope.cols());
  std::optional<HiddenMode> found;
  for (const HiddenMode& mode : modes_of(slope, nothing, {}, Modes::all)) {
    const auto growth = [&](const HiddenMode& of) {
      return jumps ? std::abs(of.eigenvalue) - 1 : of.eigenvalue.real();
    };
    if (growth(mode) >= -mode.accuracy && (!found || growth(mode) > growth(*found))) found = mode;
  }
  if (!found) return "";
  return "a mode of the plant does not decay: eigenvalue " + eigenvalue_text(*found) +
         " of A in the direction " + direction_text(*found) +
         "; the design has no gain that changes it";
}

}  // namespace

std::string hidden_mode_text(const model::Instance& instance) {
  const model::Design& design = *instance.design;
  if (std::string own = own_mode_text(instance); !own.empty()) return own;
  if (std::string unreached = unreached_mode_text(instance); !unreached.empty()) return unreached;
  if (design.states.empty()) return "";
  for (const std::string name : {"C", "C2"}) {
    const auto pair = is_shown(design, name) ? pair_of(instance, name) : std::nullopt;
    if (!pair || pair->first.cols() != pair->second.cols()) continue;
    const bool jumps = design.dynamics && design.dynamics->flow.empty();
    if (const auto mode = hidden_mode(pair->first, pair->second,
                                      jumps ? Modes::not_shrinking : Modes::not_decaying))
      return unseen_mode_text(*mode, name);
  }
  return "";
}

std::string hidden_mode_text(const model::Instance& instance, const forall::Domain& domain) {
  constexpr double kTells = 1e-8;  // points come from a search
  const model::Design& design = *instance.design;
  if (!design.dynamics || design.states.empty()) return "";
  const model::Dynamics& dynamics = *design.dynamics;
  const std::string& state = design.states.front().name;
  const expr::Shape shape = design.states.front().shape;
  const auto flow = std::find_if(dynamics.flow.begin(), dynamics.flow.end(), [&](const auto& each) {
    return dynamics.variables[each.variable].name == state;
  });
  const model::Dynamics::Signal* output = find_named(dynamics.signals, "y");
  if (shape.cols != 1 || flow == dynamics.flow.end() || output == nullptr) return "";
  if (!flow->value.program.functions.empty() || !output->value.program.functions.empty()) return "";
  const StateBox box(domain, state, shape.rows);
  if (box.low.empty()) return "";
  Linearisation plant(flow->value.program, output->value.program, state, instance, box);
  std::vector<std::vector<double>> points = {box.at(0.5), box.at(0), box.at(1)};
  const auto residual = [&](const std::vector<double>& at) {
    double least = 1;
    for (const HiddenMode& mode : plant.modes(at)) least = std::min(least, mode.residual);
    return least;
  };
  if (box.low.size() > 1)
    for (auto& found : forall::local_minima(residual, box.low, box.high))
      points.push_back(std::move(found.at));
  for (const std::vector<double>& at : points) {
    const auto mode = hidden_among(plant.modes(at), kTells);
    if (!mode) continue;
    std::string label;
    for (std::size_t k = 0; k < at.size(); ++k) {
      const bool nothing = std::abs(at[k]) <= kTells * (box.high[k] - box.low[k]);
      label += (k > 0 ? ", " : "") + state + "_" + std::to_string(k + 1) + " = " +
               brief(nothing ? 0 : at[k]);
    }
    return "the output does not show a mode of the plant that does not decay, linearised at " +
           label + ": eigenvalue " + eigenvalue_text(*mode) + " in the direction " +
           direction_text(*mode, kTells) +
           " (Hautus); no gain changes it, so another output is needed, or a box without this "
           "point";
  }
  return "";
}

std::vector<std::string> fixed_mode_texts(const model::Instance& instance) {
  std::vector<std::string> texts;
  const auto a = instance.values.find("A");
  if (a == instance.values.end() || !is_declared(*instance.design, "A", true)) return texts;
  const numbers::Matrix& A = a->second;
  for (const std::string name : {"C", "C2", "B", "B2"}) {
    const auto other = instance.values.find(name);
    if (other == instance.values.end()) continue;
    const bool input = name[0] == 'B';
    const numbers::Matrix own = input ? A.transpose() : A;
    const numbers::Matrix by = input ? other->second.transpose() : other->second;
    if (by.cols() != own.cols()) continue;
    if (const auto mode = hidden_mode(own, by, Modes::all))
      texts.push_back(
          "no gain moves the mode " + eigenvalue_text(*mode) + ": " + name +
          (input ? " does not reach the combination " : " does not show the direction ") +
          direction_text(*mode) + (input ? " of the states" : ""));
  }
  return texts;
}

}  // namespace gainsmith::design
