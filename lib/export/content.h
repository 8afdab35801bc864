// What is exported: the gains of a file, and the observers of its design as maps of their own
// states and of what they measure.
//
//   rate     x' = f(x, inputs)       for the states that flow; the others rest
//   jump     x+ = g(x, inputs)       at an event, in one or several passes
//   output   h(x, inputs)            what a text makes of states and inputs alone, such as u: -K*xh
//
// An input is an output of the plant, such as y: C*z, an input u(t), or what a file measures.
// Programs read states and inputs by their `key`.
//
// The state vector of an observer has the elements of its states in their order, the columns of a
// matrix below each other. Where the rate is affine in the states, it is x' = M x + c(inputs), M of
// n x n. The flow over a time T with held inputs is then exact:
//   x(T) = Phi x(0) + Psi c,   Phi = exp(M T),   Psi = integral of exp(M s) ds from 0 to T      (1)
//
// scalar_code writes programs as statements on numbers. observer_writer and shared_text hold what
// the languages share. c_file, matlab_file and python_file write observers; tables writes matrices
// alone. A map without a formula on numbers is left out, and a note of the content says so. No text
// depends on the time or on the machine.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/gains.h"
#include "model/run_texts.h"
#include "model/stated.h"

namespace gainsmith::exports {

/// A state or an input of an observer.
struct Variable {
  std::string key;   ///< "nominal.xh"
  std::string name;  ///< "xh"
  expr::Shape shape;
  std::string unit;  ///< "rad, rad/s": one, or one for each element; empty: the problem states none
};

/// A constant gain, or one coefficient of a polynomial gain.
struct GainMatrix {
  std::string name;
  numbers::Matrix value;
};

/// A gain that depends on a scalar.
struct GainFunction {
  std::string name;
  std::string variable;
  expr::Program program;
  std::string text;  ///< its formula in the matrix language
};

/// A state with its value at the start, of its shape, all numbers.
struct State : Variable {
  numbers::Matrix start;  ///< zeros where the problem draws it, or says nothing
};

/// The new value or the rate of a state.
struct Assigned {
  std::size_t state = 0;
  expr::Program value;
};

/// What an observer does at an event: maps one after the other.
struct Jump {
  std::string event;
  std::vector<std::vector<Assigned>> passes;
  /// The time between two occurrences, where it is always the same.
  std::optional<double> period;
};

/// y = h(x, inputs): an output or signal of which at least one state is read.
struct Output {
  std::string name;
  expr::Program value;
  std::string unit;
};

/// x' = M x + (a function of the inputs): its flow is known exactly while the inputs are held.
struct LinearFlow {
  numbers::Matrix
      M;  ///< over all elements of the states in order, columns of each below each other
};

/// One observer; its programs read nothing but its own states, its inputs and numbers.
struct Observer {
  std::string name;
  std::vector<State> states;
  std::vector<Variable> inputs;
  std::vector<Assigned> rate;
  std::vector<Jump> jumps;
  std::vector<Output> outputs;
  std::optional<LinearFlow> linear;  ///< none: it is not affine, or depends on the time itself

  int size() const;  ///< elements of all states
};

/// What follows where a map of an observer is left out: the end of a note on it.
inline constexpr const char* kWithoutJump =
    "; so the exported observer does not do at that event what the simulated one does, and the "
    "claims that were verified do not cover it";
inline constexpr const char* kWithoutFlow =
    "; so the exported observer does not do between events what the simulated one does, and the "
    "claims that were verified do not cover it";

/// Everything that the writers of files need. They add to `notes` and change nothing else.
struct Content {
  std::string problem, method, version;
  std::string statement_hash, file_hash;  ///< SHA-256
  bool single = false;                    ///< the gains are numbers of single precision
  std::string time_unit;                  ///< empty: the problem states none
  std::vector<model::Margin> margins;
  std::vector<GainMatrix> gains;
  std::vector<GainFunction> functions;
  std::vector<Observer> observers;
  numbers::Values values;          ///< data and parameters, and coefficients of functions
  std::vector<std::string> notes;  ///< what is left out, and why
};

/// Of names, one or one for each element, as the problem states them.
using Units = std::map<std::string, std::vector<std::string>>;

/// Of a gain file whose texts are bound: `stated` and, where something moves, `texts`. `file_text`
/// is hashed.
Content content_of(const model::Gains& gains, const model::Design& design,
                   const model::Stated& stated, const std::optional<model::RunTexts>& texts,
                   const std::string& file_text, const Units& units);

/// The matrices of `gains` and the coefficients of those that are polynomials, "F_0", "F_1";
/// formulas are none of these, and a note says so.
std::vector<GainMatrix> matrices_of(const model::Gains& gains, std::vector<std::string>& notes);

}  // namespace gainsmith::exports
