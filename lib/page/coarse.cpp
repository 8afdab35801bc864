#include "page/coarse.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "report/drawing.h"

namespace gainsmith::page {

namespace {

using report::Point;
using report::Polyline;

/// Reads "M12,3.4l1,2 3-4" in tenths of a pixel.
class PathReader {
 public:
  explicit PathReader(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}

  /// None where the path is made of anything else.
  std::optional<std::vector<Polyline>> lines() {
    std::vector<Polyline> found;
    while (at_ != end_) {
      if (!accept('M')) return std::nullopt;
      const std::optional<Point> start = point();
      if (!start || !accept('l')) return std::nullopt;
      Polyline line = {*start};
      while (at_ != end_ && *at_ != 'M') {
        const std::optional<Point> step = point();
        if (!step) return std::nullopt;
        line.push_back({line.back().x + step->x, line.back().y + step->y});
      }
      if (line.size() < 2) return std::nullopt;
      found.push_back(std::move(line));
    }
    return found;
  }

 private:
  bool accept(char c) {
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }

  std::optional<Point> point() {
    const std::optional<int> x = tenths();
    const std::optional<int> y = tenths();
    return x && y ? std::optional(Point{*x, *y}) : std::nullopt;
  }

  std::optional<int> tenths() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == ',')) ++at_;
    double pixels = 0;
    const auto read = std::from_chars(at_, end_, pixels, std::chars_format::fixed);
    if (read.ec != std::errc() || std::abs(pixels) > 1e6) return std::nullopt;
    at_ = read.ptr;
    return static_cast<int>(std::lround(10 * pixels));
  }

  const char* at_;
  const char* end_;
};

}  // namespace

std::string coarse(std::string_view svg, double tolerance) {
  constexpr std::string_view kPath = " d=\"";
  std::string text;
  for (;;) {
    const std::size_t found = svg.find(kPath);
    const std::size_t begin = found == std::string_view::npos ? svg.size() : found + kPath.size();
    text += svg.substr(0, begin);
    svg.remove_prefix(begin);
    if (svg.empty()) return text;
    const std::size_t end = std::min(svg.find('"'), svg.size());
    if (const auto lines = PathReader(svg.substr(0, end)).lines())
      for (const Polyline& line : *lines) text += report::path(report::coarser(line, 10 * tolerance));
    else
      text += svg.substr(0, end);
    svg.remove_prefix(end);
  }
}

}  // namespace gainsmith::page
