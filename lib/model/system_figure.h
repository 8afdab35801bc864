// Pictures of linear systems: of the plant, a loop or a closed loop, by their matrices.
//
//   {bode: L}              size and phase of each element of H over the frequency
//   {singular values: S}   of H over the frequency
//   {nyquist: L}           H in the complex plane, one input and one output
//   {step: T}, {impulse: T}  each output over time, for each input
//   {poles: T}             poles and zeros in the complex plane
//
// Several systems: [L, T], or with labels {open: L, closed: T}; `over: [a, b]` is the range of the
// frequency in radians per unit of time, or of the time.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "expr/ast.h"
#include "model/formula.h"

namespace gainsmith::model {

enum class SystemPicture { bode, singular_values, nyquist, step, impulse, poles };

/// The key of each.
std::string to_string(SystemPicture kind);

/// As read.
struct SystemFigureText {
  struct System {
    std::string label;
    expr::Expression text;
  };
  std::string name;
  SystemPicture kind = SystemPicture::bode;
  std::vector<System> systems;
  std::optional<std::pair<expr::Expression, expr::Expression>> over;
  Place place;
};

/// As bound: programs over data, parameters, gains and unknowns.
struct SystemFigure {
  struct System {
    std::string label;
    expr::Program matrix;               ///< [A, B; C, D]
    int states = 0;                     ///< its first rows and columns
    std::optional<expr::Program> step;  ///< the sampling time; none: continuous
    Place place;
  };
  std::string name;
  SystemPicture kind = SystemPicture::bode;
  std::vector<System> systems;
  std::optional<std::pair<Formula, Formula>> over;
  Place place;
};

}  // namespace gainsmith::model
