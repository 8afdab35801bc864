#include "search/bisect.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>

#include "base/stop.h"

namespace gainsmith::search {

namespace {

/// Works on "outward" = value for the largest, -value for the smallest: yes is sought outward.
class Halving {
 public:
  Halving(const Question& question, const Axis& axis, const BisectOptions& options)
      : question_(question), axis_(axis), options_(options) {}

  Bisection run() {
    if (!(options_.guess ? gallop(std::clamp(*options_.guess, axis_.low, axis_.high)) : spread()))
      return result(false);
    while (const auto value = next())
      if (!ask(*value)) return result(false);
    return result(true);
  }

 private:
  using Answers = std::map<double, Answer>;  ///< by outward

  double sign() const { return options_.largest ? 1.0 : -1.0; }

  /// False, and nothing is asked, when evaluations are used up or everything stops.
  bool ask(double value) {
    if (std::ssize(answers_) >= options_.evaluations) return false;
    try {
      check_stop();
      answers_[sign() * value] = question_(value);
      asked_.push_back(sign() * value);
    } catch (const Stopped&) {
      return false;
    }
    return true;
  }

  /// The first values, and the one that is known.
  bool spread() {
    for (const double value : points_on(axis_, std::max(2, options_.spread)))
      if (!ask(value)) return false;
    const auto& known = options_.known;
    if (!known || *known < axis_.low || *known > axis_.high || answers_.contains(sign() * *known))
      return true;
    return ask(*known);
  }

  /// Steps outward while the answer is yes, inward while it is not, each step four times the last.
  bool gallop(double guess) {
    constexpr double kFirst = 2;  // tolerances
    constexpr double kGrowth = 4;
    if (!ask(guess)) return false;
    const bool outward = answers_.at(sign() * guess) == Answer::yes;
    const double direction = outward ? sign() : -sign();
    const double end = direction > 0 ? axis_.high : axis_.low;
    double value = guess;
    for (double step = kFirst * options_.tolerance.at(guess); value != end; step *= kGrowth) {
      value = std::clamp(guess + direction * step, axis_.low, axis_.high);
      if (!ask(value)) return false;
      if ((answers_.at(sign() * value) == Answer::yes) != outward) break;
    }
    return true;
  }

  /// end() where no answer is yes.
  Answers::const_iterator outermost_yes() const {
    const auto found = std::find_if(answers_.rbegin(), answers_.rend(),
                                    [](const auto& item) { return item.second == Answer::yes; });
    return found == answers_.rend() ? answers_.end() : std::prev(found.base());
  }

  Answers::const_iterator nearest_no(Answers::const_iterator yes) const {
    return std::find_if(yes, answers_.end(),
                        [](const auto& item) { return item.second == Answer::no; });
  }

  /// In units that are powers of two apart the same bits.
  static double geometric_mean(double a, double b) {
    const double ratio = b / a;
    return std::isfinite(ratio) && ratio > 0 ? a * std::sqrt(ratio) : std::sqrt(a) * std::sqrt(b);
  }

  /// The middle of a gap on the axis's scale; none when it is within the tolerance, or too small
  /// for double.
  std::optional<double> middle(double inner, double outer) const {
    if (outer - inner <= options_.tolerance.at(std::min(std::abs(inner), std::abs(outer))))
      return std::nullopt;
    const double a = sign() * inner;
    const double b = sign() * outer;
    const double value = axis_.logarithmic ? geometric_mean(a, b) : a + 0.5 * (b - a);
    if (value == a || value == b) return std::nullopt;
    return value;
  }

  /// The next value to ask: beyond the outermost yes, or below the nearest no when what follows the
  /// yes is undecided.
  std::optional<double> next() const {
    const auto yes = outermost_yes();
    if (yes == answers_.end() || std::next(yes) == answers_.end()) return std::nullopt;
    if (const auto value = middle(yes->first, std::next(yes)->first)) return value;
    const auto no = nearest_no(yes);
    if (no == answers_.end()) return std::nullopt;
    return middle(std::prev(no)->first, no->first);
  }

  /// The bracket of the answers so far.
  Bisection result(bool finished) const {
    Bisection found;
    found.finished = finished;
    for (const double outward : asked_)
      found.samples.push_back(
          {sign() * outward, answers_.at(outward), static_cast<int>(found.samples.size())});
    std::sort(found.samples.begin(), found.samples.end(),
              [](const Sample& a, const Sample& b) { return a.value < b.value; });
    const auto yes = outermost_yes();
    if (yes == answers_.end()) return found;
    found.yes = sign() * yes->first;
    for (auto inner = answers_.begin(); inner != yes; ++inner)
      if (inner->second == Answer::no) found.breaks.push_back(sign() * inner->first);
    const auto no = nearest_no(yes);
    if (no != answers_.end()) found.no = sign() * no->first;
    const auto beyond = std::next(yes);
    if (beyond != no) found.open = {sign() * beyond->first, sign() * std::prev(no)->first};
    return found;
  }

  const Question& question_;
  const Axis& axis_;
  const BisectOptions& options_;
  Answers answers_;
  std::vector<double> asked_;  ///< outward, in order
};

}  // namespace

Bisection bisect(const Question& question, const Axis& axis, const BisectOptions& options) {
  if (!(axis.low < axis.high) || !std::isfinite(axis.low) || !std::isfinite(axis.high) ||
      !(options.tolerance.width > 0) || (options.tolerance.relative && !(axis.low > 0)))
    throw std::invalid_argument(
        "bisect: expected finite low < high and a positive tolerance, and low > 0 if it is "
        "relative");
  return Halving(question, axis, options).run();
}

}  // namespace gainsmith::search
