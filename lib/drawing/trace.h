// What a curve leaves on its panel.
#pragma once

#include <vector>

#include "drawing/axis.h"
#include "drawing/figure.h"
#include "drawing/thinning.h"

namespace gainsmith::drawing {

/// A place on the picture, in pixels.
struct Box {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

/// A jump from its value before to that after; verticals of several have their two ends.
struct JumpTrace {
  Point before;
  Point after;
};

/// Lines of two points at least, jumps that are a tenth of a pixel long at least, and dots for
/// samples that no line touches.
struct Trace {
  std::vector<Polyline> flows;
  std::vector<JumpTrace> jumps;
  std::vector<Point> dots;
};

/// Up to this many jumps of a curve are each drawn; of more, those in one column of pixels are one
/// vertical.
constexpr std::size_t single_jumps = 60;

/// The curve on a panel that fills the box.
Trace trace(const Curve& curve, const Axis& time, const Axis& values, const Box& box);

/// The curve in a plane, where t is another quantity. Jumps that begin and end in the same pixels
/// are one; of more than 2,000 others none is drawn.
Trace trace_in_plane(const Curve& curve, const Axis& across, const Axis& values, const Box& box);

}  // namespace gainsmith::drawing
