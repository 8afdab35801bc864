// Results as text for people.
#pragma once

#include <string>

#include "model/gains.h"
#include "model/instance.h"
#include "numbers/matrix.h"

namespace gainsmith::app {

/// "[0.85, -0.84; 1, 0]", six significant digits; a 1 x 1 matrix without brackets.
std::string matrix_text(const numbers::Matrix& matrix);

/// "-1 +- 2i, -3": rows of real and imaginary parts as eig(M) has them, pairs once.
std::string eigenvalues_text(const numbers::Matrix& rows);

/// "688.572  (the optimum is at least 688.571)"; empty without objective.
std::string objective_line(const model::Gains& gains);

/// Why the solver stopped, as far as a verdict has to do with it.
std::string solver_line(const model::Gains& gains);

/// Verdict, objective with the price of the margin, gains, margins, bounds, certificate.
std::string synthesis_summary(const model::Gains& gains);

/// What the verdict rests on, and what stopped it, indented; empty when there is nothing to say.
std::string message_lines(const model::Gains& gains);

/// Which margins are a little below the one asked for, and what decided; empty where the message
/// says it, or none is.
std::string margins_note(const model::Gains& gains);

/// objective_line() as a line of the summary; empty without objective.
std::string objective_text(const model::Gains& gains);

/// One line: "yes, objective 688.572".
std::string verdict_line(const model::Gains& gains);

}  // namespace gainsmith::app
