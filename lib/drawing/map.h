// Maps of quantities over a grid of two scalars, as SVG pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drawing/figure.h"

namespace gainsmith::drawing {

/// The values of a scalar on a grid.
struct GridAxis {
  std::string name;            ///< with its unit
  std::vector<double> values;  ///< ascending
  bool logarithmic = false;
};

/// What a cell without a value is: how it is filled, and the mark in it.
struct CellKind {
  std::string label;
  std::string fill;  ///< "#e8e8e8"
  Mark mark = Mark::none;
};

/// What is at one point of the grid: a value, or a reason why there is none.
struct Cell {
  std::size_t kind = 0;         ///< of MapFigure::kinds
  std::optional<double> value;  ///< finite; by a scale of colours, whatever the kind
};

struct Map {
  std::string title;        ///< the quantity
  std::vector<Cell> cells;  ///< all of the lowest value of `up` first
};

/// Maps one above the other.
struct MapFigure {
  std::string title;
  GridAxis across, up;
  std::vector<CellKind> kinds;
  std::vector<Map> maps;
};

/// The maps, each with a scale of colours beside it where it has values: logarithmic where they are
/// positive and span a factor of 30. The kinds that occur are explained above it. The boundaries of
/// a cell lie midway to its neighbours on the axis. Of more than 400 values of a scalar every
/// second, third ... is shown. Otherwise as svg() of a Figure. std::logic_error for a map that has
/// not one cell a point of the grid.
std::string svg(const MapFigure& figure);

}  // namespace gainsmith::drawing
