// What is exported, as the text of a file. Nothing in it depends on the time or on the machine.
#pragma once

#include <string>
#include <vector>

#include "export/content.h"

namespace gainsmith::exports {

/// One header in C99: constants, states as structures, functions without memory of their own.
/// `name` precedes all names. Elements of vectors and matrices are indexed as in C, rows first.
///
///   NAME_rate(state, inputs, rate)     the right-hand side of the flow
///   NAME_flow(state, inputs, dt)       of a linear flow: its exact solution while the inputs are
///                                      held, by Taylor's series over steps h with |M|_1 h <= 1,
///                                      to rounding
///   NAME_flow_period(state, inputs)    the same over the time between two occurrences of an event,
///                                      where that is always the same: one product of matrices
///   NAME_jump(state, inputs)           the map at an event; of several NAME_jump_EVENT
///   NAME_OUTPUT(state, inputs)         an output
///   NAME_GAIN(variable, out)           a gain that is a function
///
/// A map that C has no formula for is left out, with a note.
std::string c_file(Content& content, const std::string& name);

/// A function NAME() of MATLAB and Octave that gives a structure: the gains by their names, and for
/// each observer start, rate, flow, jump and outputs as handles. Handles take the states as a
/// structure. The flow uses expm of [M, c; 0, 0] dt.
std::string matlab_file(Content& content, const std::string& name);

/// A module of Python with NumPy arrays: the gains by their names, and a class for each observer.
/// Its flow and jumps change the states in place; its flow uses Taylor's series as in C.
std::string python_file(Content& content, const std::string& name);

/// Equations with bmatrix, six significant digits; to be included where amsmath is loaded.
std::string latex_file(const Content& content, const std::vector<GainMatrix>& matrices);

/// A MAT-file of level 5 (MathWorks, MAT-File Format), not compressed, little-endian: the matrices
/// as double, by their names.
std::string mat_file(const std::vector<GainMatrix>& matrices);

/// Rows on lines, elements with commas between them, in decimals that read back as the same double.
std::string csv_text(const numbers::Matrix& matrix);

}  // namespace gainsmith::exports
