// The box of the ranges of scalar functions on an interval. It holds the curve
//   tau -> (theta_1(tau), ..., theta_N(tau)),   tau in [low, high].
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/error.h"
#include "forall/atoms.h"
#include "model/function.h"

namespace gainsmith::forall {

/// More vertices than this are refused: 2^12, a box of twelve functions, each vertex an inequality
/// of its own.
constexpr std::size_t kMostVertices = 4096;

struct Box {
  std::vector<Atom> atoms;
  std::vector<Range> ranges;                  ///< of each atom
  std::vector<std::vector<double>> vertices;  ///< [vertex][atom], each once
  std::vector<std::string> labels;            ///< "cos(2*tau) = 1, sin(2*tau) = 0", of each vertex

  /// The place of an atom; -1 for another one.
  int find(const Atom& atom) const;
};

/// The box of different atoms on [low, high]; without atoms one vertex, with an empty label.
/// InputError at `place` for more than kMostVertices vertices and for an atom that is too large for
/// double there.
Box box_of(std::vector<Atom> atoms, const std::string& variable, double low, double high,
           const Place& place);

/// The multilinear weights of the vertices v_i of a box of functions theta_k of the variable,
///   alpha_i(tau) = prod_k (theta_k - low_k)/(high_k - low_k)    where v_i is at high_k,
///                         (high_k - theta_k)/(high_k - low_k)   where it is at low_k.
/// They are >= 0 and sum to 1, and theta(tau) = sum_i alpha_i(tau) v_i.
model::Basis weights(const Box& box, const std::string& variable, const Place& place);

/// InputError: the hull has more than kMostVertices vertices.
[[noreturn]] void refuse_vertices(const Place& place);

}  // namespace gainsmith::forall
