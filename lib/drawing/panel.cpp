// What is inside and around the frame of one panel: grid, labels, field, bands, curves, marks.
#include "drawing/panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "drawing/band.h"
#include "drawing/drawing.h"
#include "drawing/text.h"

namespace gainsmith::drawing {

namespace {

/// From the frame to the labels beside it, in pixels.
constexpr double to_labels = 7;

std::string power_of_ten(int factor) {
  return (factor < 0 ? "\xE2\x88\x92" : "") + std::to_string(std::abs(factor));
}

/// "10" and its power raised; empty for the power 0.
std::string raised(std::string_view text, std::string_view power) {
  std::string element = escaped(text);
  if (!power.empty())
    element +=
        fmt::format(R"(<tspan dy="-5" font-size="{}">{}</tspan>)", power_size, escaped(power));
  return element;
}

std::string label_at(double x, double y, const Tick& tick, std::string_view anchor) {
  return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", pixels(x), pixels(y),
                     anchor, raised(tick.text, tick.power));
}

/// What labels are to be multiplied by, at the end of the axis.
Tick factor_label(int factor) {
  return {0,
          "\xC3\x97"
          "10",
          power_of_ten(factor)};
}

/// Lines at the ticks, and paler ones between them on a logarithmic axis.
std::string grid(const Axis& time, const Axis& values, const Box& box) {
  std::string strong, light;
  const auto across = [&](double share) {
    return "M" + pixels(box.left) + "," + pixels(box.bottom() - share * box.height) + "h" +
           pixels(box.width);
  };
  for (const double share : values.between) light += across(share);
  for (const double share : time.between)
    light += "M" + pixels(box.left + share * box.width) + "," + pixels(box.top) + "v" +
             pixels(box.height);
  for (const Tick& tick : values.ticks) strong += across(tick.share);
  for (const Tick& tick : time.ticks)
    strong += "M" + pixels(box.left + tick.share * box.width) + "," + pixels(box.top) + "v" +
              pixels(box.height);
  std::string text;
  if (!light.empty())
    text += fmt::format("<path fill=\"none\" stroke=\"#f0f0f0\" d=\"{}\"/>\n", light);
  text += fmt::format("<path fill=\"none\" stroke=\"#dcdcdc\" d=\"{}\"/>\n", strong);
  return text;
}

std::string frame(const Box& box) {
  return fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#606060\"/>\n",
      pixels(box.left), pixels(box.top), pixels(box.width), pixels(box.height));
}

/// Labels, factor and name at the left of a frame.
std::string beside(const std::string& quantity, const Axis& values, const Box& box) {
  std::string text;
  for (const Tick& tick : values.ticks)
    text += label_at(box.left - to_labels, box.bottom() - tick.share * box.height + 4, tick, "end");
  if (values.factor != 0)
    text += label_at(box.left - to_labels, box.top - 8, factor_label(values.factor), "end");
  if (!quantity.empty()) {
    const std::string name = shortened(quantity, label_size, box.height + 30);
    text +=
        text_at(0, 0, name,
                fmt::format(R"-( text-anchor="middle" transform="translate(20,{}) rotate(-90)")-",
                            pixels(box.top + box.height / 2)));
  }
  return text;
}

std::string circle(const Point& at, std::string_view radius, std::string_view fill) {
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", pixels(at.x),
                     pixels(at.y), radius, fill);
}

/// Of its vertical, in tenths of a pixel.
int length(const JumpTrace& jump) { return std::abs(jump.after.y - jump.before.y); }

/// Open where a jump begins and filled where it ends. Of short jumps, whose circles would overlap,
/// none, and none at all where most of the jumps that one sees are short.
std::string circles(const std::vector<JumpTrace>& jumps, std::string_view colour) {
  // In tenths of a pixel: jumps that one sees, and those on which two circles of radius 2 fit.
  constexpr int seen = 20, clear = 45;
  const auto longer = [&](int least) {
    return std::count_if(jumps.begin(), jumps.end(),
                         [&](const JumpTrace& jump) { return length(jump) >= least; });
  };
  if (2 * longer(clear) <= longer(seen)) return {};
  std::string text;
  for (const JumpTrace& jump : jumps)
    if (length(jump) >= clear) text += circle(jump.before, "2", "white");
  for (const JumpTrace& jump : jumps)
    if (length(jump) >= clear) text += circle(jump.after, "2", colour);
  return fmt::format("<g stroke=\"{}\">\n{}</g>\n", colour, text);
}

/// A mark at each sample that the axes show.
std::string marks(const Curve& curve, const Axis& time, const Axis& values, const Box& box) {
  std::string text;
  if (curve.mark == Mark::none) return text;
  for (std::size_t k = 0; k < curve.t.size(); ++k)
    if (time.shows(curve.t[k]) && values.shows(curve.value[k]))
      text += mark_at(curve.mark, box.left + time.share(curve.t[k]) * box.width,
                      box.bottom() - values.share(curve.value[k]) * box.height, curve.colour);
  return text;
}

/// Of a curve in a plane: a dot at its start, a ring at its end.
std::string end_marks(const Curve& curve, const Axis& across, const Axis& values, const Box& box) {
  Curve both = curve;
  std::string text;
  if (curve.limit) return text;
  for (const auto& [mark, k] :
       {std::pair(Mark::dot, std::size_t{0}), std::pair(Mark::ring, curve.t.size() - 1)}) {
    if (curve.t.empty()) break;
    both.t = {curve.t[k]};
    both.value = {curve.value[k]};
    both.mark = mark;
    text += marks(both, across, values, box);
  }
  return text;
}

/// Jumps as thin dots, flows in the style of the curve, samples alone as filled circles.
std::string lines(const Trace& trace, const Style& style) {
  std::string jumps, flows, text;
  for (const JumpTrace& jump : trace.jumps) jumps += path({jump.before, jump.after});
  for (const Polyline& flow : trace.flows) flows += path(flow);
  if (!jumps.empty())
    text += fmt::format(
        "<path fill=\"none\" stroke=\"{}\" stroke-width=\"0.9\" stroke-dasharray=\"1 2\" "
        "d=\"{}\"/>\n",
        colour_name(style.colour), jumps);
  if (!flows.empty())
    text += fmt::format("<path {} stroke-linejoin=\"round\" d=\"{}\"/>\n", stroke(style), flows);
  // Beside lines a sample alone is a piece of one, between jumps that are nearer than a pixel.
  const char* const radius = trace.flows.empty() ? "2" : "0.9";
  for (const Point& dot : trace.dots) text += circle(dot, radius, colour_name(style.colour));
  return text;
}

/// Arrows on a grid of about 30 pixels, each with its middle at its place. The length is 22 cbrt(s
/// / s_max) pixels with the speed s on the picture: slow ones are drawn larger, so that their
/// directions are seen. Where a rate is 0 or not finite there is none.
std::string field_of(const Panel& panel, const Axis& across, const Axis& up, const Box& box) {
  // In pixels: cells of the grid, the fastest arrow, its two barbs.
  constexpr double spacing = 30, longest = 22, head = 4;
  struct Arrow {
    double x, y, right, down, speed;
  };
  std::vector<Arrow> arrows;
  double fastest = 0;
  const int columns = static_cast<int>(box.width / spacing),
            rows = static_cast<int>(box.height / spacing);
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < rows; ++k) {
      const double x = box.left + (i + 0.5) * box.width / columns;
      const double y = box.top + (k + 0.5) * box.height / rows;
      const auto [rate_across, rate_up] =
          panel.field(across.low + (across.high - across.low) * (x - box.left) / box.width,
                      up.low + (up.high - up.low) * (box.bottom() - y) / box.height);
      const double right = rate_across * box.width / (across.high - across.low);
      const double down = -rate_up * box.height / (up.high - up.low);
      const double speed = std::hypot(right, down);
      if (!std::isfinite(speed) || speed == 0) continue;
      arrows.push_back({x, y, right / speed, down / speed, speed});
      fastest = std::max(fastest, speed);
    }
  std::string lines;
  for (const Arrow& arrow : arrows) {
    const double length = longest * std::cbrt(arrow.speed / fastest);
    const double x = arrow.right * length, y = arrow.down * length;
    const auto barb = [&](double side) {
      return "l" + pixels(-head * (arrow.right - side * arrow.down)) + "," +
             pixels(-head * (arrow.down + side * arrow.right));
    };
    lines += "M" + pixels(arrow.x - x / 2) + "," + pixels(arrow.y - y / 2) + "l" + pixels(x) + "," +
             pixels(y) + barb(0.5) + "M" + pixels(arrow.x + x / 2) + "," + pixels(arrow.y + y / 2) +
             barb(-0.5);
  }
  return lines.empty() ? lines
                       : fmt::format("<path fill=\"none\" stroke=\"#b8b8b8\" d=\"{}\"/>\n", lines);
}

}  // namespace

double label_width(const Axis& axis) {
  const auto width = [](const Tick& tick) {
    return text_width(tick.text, label_size) + text_width(tick.power, power_size);
  };
  double widest = axis.factor != 0 ? width(factor_label(axis.factor)) : 0;
  for (const Tick& tick : axis.ticks) widest = std::max(widest, width(tick));
  return widest + to_labels;
}

/// Value 0 is in the topmost row: the axis runs downwards, from -0.5 to n - 0.5.
Axis axis_of_rows(const std::vector<std::string>& rows) {
  Axis axis;
  const auto count = static_cast<double>(rows.size());
  axis.low = count - 0.5;
  axis.high = -0.5;
  for (std::size_t k = 0; k < rows.size(); ++k)
    axis.ticks.push_back({axis.share(static_cast<double>(k)), rows[k], {}});
  return axis;
}

std::string framed(const std::string& name, const Axis& values, const Box& box) {
  return frame(box) + beside(name, values, box);
}

std::string drawn(const Panel& panel, const Axis& time, const Axis& values, const Box& box) {
  std::string text = grid(time, values, box) + framed(panel.axis, values, box);
  if (panel.field) text += field_of(panel, time, values, box);
  for (const Band& band : panel.bands) text += drawn(band, time, values, box);
  std::vector<Trace> traces;
  bool few_jumps = !panel.across, anything = !panel.bands.empty();
  for (const Curve& curve : panel.curves) {
    traces.push_back(panel.across ? trace_in_plane(curve, time, values, box)
                                  : trace(curve, time, values, box));
    few_jumps = few_jumps && curve.jumps.size() <= single_jumps;
    anything = anything || !traces.back().flows.empty() || !traces.back().dots.empty();
  }
  if (!anything)
    return text + text_at(box.left + box.width / 2, box.top + box.height / 2 + 4, "no data",
                          R"( text-anchor="middle" fill="#8a8a8a")");
  const std::vector<Style> styles = styles_of(panel);
  for (std::size_t k = 0; k < traces.size(); ++k)
    if (panel.curves[k].joined) text += lines(traces[k], styles[k]);
  if (few_jumps)
    for (std::size_t k = 0; k < traces.size(); ++k)
      text += circles(traces[k].jumps, colour_name(panel.curves[k].colour));
  for (const Curve& curve : panel.curves)
    text += panel.across && !panel.bars && curve.joined ? end_marks(curve, time, values, box)
                                                        : marks(curve, time, values, box);
  return text;
}

std::string drawn_beside(const Axis& scale, const Box& box) {
  std::string text = frame(box);
  for (const Tick& tick : scale.ticks)
    text += label_at(box.right() + to_labels, box.bottom() - tick.share * box.height + 4, tick,
                     "start");
  if (scale.factor != 0)
    text += label_at(box.left, box.top - 8, factor_label(scale.factor), "start");
  return text;
}

std::string drawn_below(const Axis& time, const std::string& name, const Box& box) {
  std::string text;
  for (const Tick& tick : time.ticks)
    text += label_at(box.left + tick.share * box.width, box.bottom() + 17, tick, "middle");
  if (time.factor != 0)
    text += label_at(box.right(), box.bottom() + 36, factor_label(time.factor), "end");
  text += text_at(box.left + box.width / 2, box.bottom() + 36,
                  shortened(name, label_size, box.width - 100), R"( text-anchor="middle")");
  return text;
}

}  // namespace gainsmith::drawing
