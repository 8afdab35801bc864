#include "linear/coordinates.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "expr/program/rewrite.h"
#include "linear/differences.h"
#include "linear/polynomial.h"
#include "numbers/types/degree.h"

namespace gainsmith::linear {

namespace {

using Eigen::Index;
using expr::Op;
using expr::Program;
using expr::Shape;
using Wide = numbers::MatrixOf<Decimal100>;

Program zero_program(Shape shape) {
  expr::Composer compose({});
  return compose.take(compose.apply(Op::zeros, {}, shape));
}

Program product(const Program& a, const Program& b) {
  expr::Composer compose({});
  const int first = compose.program(a);
  const int second = compose.program(b);
  return compose.take(
      compose.apply(Op::multiply, {first, second}, {a.shape().rows, b.shape().cols}));
}

/// In this order: differences take the place of states, flow and jump are rewritten, the flow is
/// evaluated, images expm(..) x are added, and what nothing needs is dropped.
class Builder {
 public:
  Builder(const SampledSystem& system, numbers::ValuesOf<Decimal100> constants,
          const std::vector<Program>& functions)
      : system_(system),
        functions_(functions),
        pairs_(find_differences(functions, system.layout)),
        in_errors_(pairs_, system.layout) {
    result_.constants = std::move(constants);
    for (const MapEntry& entry : system.flow)
      flows_.emplace(system.layout.slots[entry.slot].name, entry.program);
    for (const MapEntry& entry : system.jump)
      jumps_.emplace(system.layout.slots[entry.slot].name, entry.program);
  }

  Coordinates build() {
    add_coordinates();
    for (Program& function : functions_) function = in_errors_(function);
    find_flow();
    add_images();
    result_.functions = std::move(functions_);
    keep_needed(result_);
    mark_clocks(result_);
    return std::move(result_);
  }

 private:
  void add(const std::string& name, Coordinate coordinate) {
    const Shape shape = coordinate.start.shape();
    result_.layout.slots.push_back({name, shape, result_.layout.size});
    result_.layout.size += shape.size();
    result_.list.push_back(std::move(coordinate));
    names_.insert(name);
  }

  /// The states that no difference replaces, then the differences. A coordinate that a jump keeps
  /// has no jump.
  void add_coordinates() {
    result_.layout.timer = system_.layout.timer;
    for (const hybrid::Slot& slot : system_.layout.slots)
      if (!in_errors_.replaces(slot.name))
        add(slot.name, {expr::input_program(slot.name, slot.shape), {}, {}, false});
    for (const StateDifference& pair : pairs_)
      add(pair.name, {difference(expr::input_program(pair.plus, pair.shape),
                                 expr::input_program(pair.minus, pair.shape)),
                      {},
                      {},
                      false});
    std::map<std::string, const StateDifference*> pair_of;
    for (const StateDifference& pair : pairs_) pair_of[pair.name] = &pair;
    for (std::size_t i = 0; i < result_.list.size(); ++i) {
      const hybrid::Slot& slot = result_.layout.slots[i];
      const auto found = pair_of.find(slot.name);
      const StateDifference* pair = found == pair_of.end() ? nullptr : found->second;
      result_.list[i].flow = map_of(slot, pair, flows_, false);
      result_.list[i].jump = map_of(slot, pair, jumps_, true);
      if (const auto& jump = result_.list[i].jump)
        if (const hybrid::Slot* same = slot_of(*jump); same != nullptr && same->name == slot.name)
          result_.list[i].jump.reset();
    }
  }

  /// A coordinate's entry of the flow or the jump.
  std::optional<Program> map_of(const hybrid::Slot& slot, const StateDifference* pair,
                                const std::map<std::string, Program>& entries, bool keeps) {
    const auto entry = [&](const std::string& name) -> Program {
      const auto found = entries.find(name);
      if (found != entries.end()) return found->second;
      return keeps ? expr::input_program(name, slot.shape) : zero_program(slot.shape);
    };
    if (pair == nullptr) {
      if (!entries.contains(slot.name)) return std::nullopt;
      return in_errors_(entry(slot.name));
    }
    if (!entries.contains(pair->plus) && !entries.contains(pair->minus)) return std::nullopt;
    return in_errors_(difference(entry(pair->plus), entry(pair->minus)));
  }

  /// The flow as linear x + constant, from its values at 0 and at the unit vectors.
  void find_flow() {
    const Index n = result_.layout.size;
    WideMap map{Wide::Zero(n, n), Wide::Zero(n, 1)};
    for (std::size_t i = 0; i < result_.list.size(); ++i) {
      if (!result_.list[i].flow) continue;
      WideFunction entry(*result_.list[i].flow, result_.layout, result_.constants);
      map.set_rows(result_.layout.slots[i], entry);
    }
    map.remove_noise();
    result_.linear = std::move(map.linear);
    result_.constant = std::move(map.constant);
  }

  std::size_t coordinate(const std::string& name) const { return *result_.layout.slot(name); }

  /// Whether the 1 x 1 coordinate has a constant derivative; then `rate` is it.
  bool has_rate(const hybrid::Slot& slot, Decimal100& rate) const {
    if (!slot.shape.is_scalar() || !result_.linear.row(slot.offset).isZero(0)) return false;
    rate = result_.constant(slot.offset, 0);
    return true;
  }

  /// Whether expm(argument) x has the derivative 0.
  bool is_constant(const Program& argument, const hybrid::Slot& x, const hybrid::Slot& s) const {
    Decimal100 rate;
    if (x.shape.cols != 1 || !has_rate(s, rate)) return false;
    const auto moves = [&](const std::string& name) { return name == s.name; };
    const auto degrees = numbers::degrees(argument, moves);
    if (degrees[static_cast<std::size_t>(argument.result)] != 1) return false;
    // The argument K(s) = s N is 0 at s = 0, and r N + M = 0. So (expm(K) x)' = expm(K) (r N + M) x
    // = 0.
    Wide at = Wide::Zero(result_.layout.size, 1);
    WideFunction value(argument, result_.layout, result_.constants);
    Wide sum = -value(at);
    if (!sum.isZero(0)) return false;
    at(s.offset) = Decimal100(1);
    const Index n = x.shape.rows;
    sum = value(at) * rate;
    Wide rows = result_.linear.middleRows(x.offset, n);
    const Wide M = rows.middleCols(x.offset, n);
    rows.middleCols(x.offset, n).setZero();
    if (!rows.isZero(0) || !result_.constant.middleRows(x.offset, n).isZero(0)) return false;
    sum += M;
    remove_noise(sum, largest_of(M));
    return sum.isZero(0);
  }

  /// The clock that the exponential depends on, when nothing else moves in it.
  const hybrid::Slot* clock_of(const Program& exponential) const {
    const hybrid::Slot* clock = nullptr;
    for (const expr::Input& input : exponential.inputs) {
      if (input.name == result_.layout.timer) return nullptr;
      if (!names_.contains(input.name)) continue;
      if (clock != nullptr) return nullptr;
      clock = &result_.layout.slots[coordinate(input.name)];
    }
    return clock;
  }

  static bool is_exponential(const Program& program) {
    return program.code[static_cast<std::size_t>(program.result)].op == Op::matrix_exponential;
  }

  /// The coordinate that a program is, when it is nothing else.
  const hybrid::Slot* slot_of(const Program& program) const {
    if (program.code.size() != 1 || program.code[0].op != Op::input) return nullptr;
    if (!names_.contains(program.inputs[0].name)) return nullptr;
    return &result_.layout.slots[coordinate(program.inputs[0].name)];
  }

  /// The coordinate expm(..) x, made when it is constant along flows; none otherwise.
  std::optional<std::string> image(int exponential, int x) {
    const auto known = images_.find({exponential, x});
    if (known != images_.end()) return known->second;
    std::optional<std::string>& name = images_[{exponential, x}];
    const Program& map = polynomials_.atom(exponential);
    const hybrid::Slot* argument = slot_of(polynomials_.atom(x));
    if (!is_exponential(map) || argument == nullptr) return name;
    const hybrid::Slot* clock = clock_of(map);
    if (clock == nullptr) return name;
    Program inside = map;
    inside.result = map.code[static_cast<std::size_t>(map.result)].operands[0];
    if (!is_constant(replace_inputs(inside, {}), *argument, *clock)) return name;
    name = "constant " + std::to_string(images_.size());
    const hybrid::Slot slot = *argument;
    const hybrid::Slot time = *clock;
    const Coordinate& from = result_.list[coordinate(slot.name)];
    const Coordinate& ticks = result_.list[coordinate(time.name)];
    Coordinate made;
    // w = expm(K(s)) x at the start and, with s+ and x+, after a jump. It has no flow.
    made.start = product(replace_inputs(map, {{time.name, ticks.start}}), from.start);
    const auto after = [](const Coordinate& coordinate, const hybrid::Slot& of) {
      return coordinate.jump ? *coordinate.jump : expr::input_program(of.name, of.shape);
    };
    made.jump = product(replace_inputs(map, {{time.name, after(ticks, time)}}), after(from, slot));
    add(*name, std::move(made));
    return name;
  }

  /// The chain with expm(..) x and x' expm(..)' replaced.
  bool replace_images(Chain& chain) {
    bool changed = false;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const bool turned = chain[i].transposed;
      if (turned != chain[i + 1].transposed) continue;
      const int exponential = chain[turned ? i + 1 : i].atom;
      const int x = chain[turned ? i : i + 1].atom;
      const auto name = image(exponential, x);
      if (!name) continue;
      const hybrid::Slot& slot = result_.layout.slots[coordinate(*name)];
      const Polynomial whole = polynomials_.of(expr::input_program(*name, slot.shape));
      const Word& word = whole.terms.begin()->first;
      chain[i] = {word.chain.empty() ? word.scalars.front() : word.chain.front().atom, turned};
      chain.erase(chain.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      changed = true;
    }
    return changed;
  }

  /// Rewrites the functions that contain an expm, and widens the flow by rows and columns of zeros.
  /// A function with too many words stays as it is.
  void add_images() {
    for (Program& function : functions_) {
      if (std::none_of(function.code.begin(), function.code.end(),
                       [](const auto& one) { return one.op == Op::matrix_exponential; }))
        continue;
      try {
        const Polynomial whole = polynomials_.of(function);
        Polynomial other{whole.shape, {}};
        bool changed = false;
        for (const auto& [original, coefficient] : whole.terms) {
          Word word = original;
          for (Chain& chain : word.inner)
            if (replace_images(chain)) changed = true;
          if (replace_images(word.chain)) changed = true;
          std::sort(word.inner.begin(), word.inner.end());
          other.terms[word] += coefficient;
        }
        if (changed) function = polynomials_.program(other);
      } catch (const std::length_error&) {
      }
    }
    const Index n = result_.layout.size;
    const Index before = result_.linear.rows();
    result_.linear.conservativeResize(n, n);
    result_.linear.bottomRows(n - before).setConstant(Decimal100(0));
    result_.linear.rightCols(n - before).setConstant(Decimal100(0));
    result_.constant.conservativeResize(n, 1);
    result_.constant.bottomRows(n - before).setConstant(Decimal100(0));
  }

  const SampledSystem& system_;
  std::vector<Program> functions_;
  std::vector<StateDifference> pairs_;
  ErrorRewriting in_errors_;
  std::map<std::string, Program> flows_;
  std::map<std::string, Program> jumps_;
  std::set<std::string> names_;
  std::map<std::pair<int, int>, std::optional<std::string>> images_;
  Polynomials polynomials_;
  Coordinates result_;
};

}  // namespace

Coordinates make_coordinates(const SampledSystem& system, numbers::ValuesOf<Decimal100> constants,
                             const std::vector<Program>& functions) {
  return Builder(system, std::move(constants), functions).build();
}

std::optional<WideMap> affine_jump(const Coordinates& coordinates) {
  const Index n = coordinates.layout.size;
  WideMap map{Wide::Identity(n, n), Wide::Zero(n, 1)};
  const auto moves = [&](const std::string& name) { return coordinates.layout.moves(name); };
  for (std::size_t i = 0; i < coordinates.list.size(); ++i) {
    const auto& jump = coordinates.list[i].jump;
    if (!jump) continue;
    const auto degrees = numbers::degrees(*jump, moves);
    if (degrees[static_cast<std::size_t>(jump->result)] == numbers::kNotAffine ||
        jump->uses(coordinates.layout.timer))
      return std::nullopt;
    WideFunction entry(*jump, coordinates.layout, coordinates.constants);
    map.set_rows(coordinates.layout.slots[i], entry);
  }
  map.remove_noise();
  return map;
}

}  // namespace gainsmith::linear
