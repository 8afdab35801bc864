// Scalars above a function and below a number, for all values of an interval.
//
// x > u f(t) for all t in [a, b] and x < u k (x in a unit u of its own) has a solution exactly when
// max f < k, for the maximum is attained. The maxima:
//   spike       1/(1 + (w (t - c))^2) and exp(-(w (t - c))^2) are 1 at t = c
//   wave        sin(w t) is 1 where w t = pi/2, inside the interval
//   hump        t exp(-t) is 1/e at t = 1
//   damped      exp(-t) sin(t) is exp(-pi/4)/sqrt(2) at t = pi/4
//   chebyshev   T_6(t) = 32 t^6 - 48 t^4 + 18 t^2 - 1 is at most 1 on [-1, 1], at its ends and
//               inside
// Two unknowns: x + y (t - c) > u f(t), x < u k: at t = c, where f has its maximum, y does not
// help; with y = 0 it is the problem above.
#include "properties/families.h"

namespace gainsmith::tests::properties {

namespace {

struct Peak {
  std::string text, from, to;
  Exact height;
};

/// 1/e and exp(-pi/4)/sqrt(2) to 20 digits.
const Exact kHump = Exact(boost::multiprecision::cpp_int("36787944117144232160")) * ten_to(-20);
const Exact kDamped = Exact(boost::multiprecision::cpp_int("32239694194483444925")) * ten_to(-20);

Peak drawn_peak(Draw& draw, const std::string& centre) {
  const std::string width = "1e" + std::to_string(draw.between(0, 4));
  const std::string offset = "(" + width + "*(t - " + centre + "))";
  switch (draw.below(6)) {
    case 0:
      return {"1/(1 + " + offset + "^2)", "0", "1", 1};
    case 1:
      return {"exp(-" + offset + "^2)", "0", "1", 1};
    case 2: {
      const std::string w = std::to_string(draw.between(1, 9));
      return {"sin(" + w + "*t)", "0", "2", 1};
    }
    case 3:
      return {"t*exp(-t)", "0", "3", kHump};
    case 4:
      return {"exp(-t)*sin(t)", "0", "3", kDamped};
    default:
      return {"(32*t^6 - 48*t^4 + 18*t^2 - 1)", "-1", "1", 1};
  }
}

Case above(Draw& draw) {
  const std::string centre = decimal(Exact(draw.between(101, 899)) / 1000);
  const Peak peak = drawn_peak(draw, centre);
  const bool two = draw.chance(0.3) && peak.text.find(centre) != std::string::npos;
  const Exact unit = draw.unit();
  const Exact k = peak.height * (1 + draw.small_distance());
  return {"above",
          "method:\n  method: above\n  data: {u: scalar, k: scalar}\n  unknowns: {x: scalar" +
              std::string(two ? ", y: scalar" : "") +
              "}\n  require:\n    above: {forall: \"t in [" + peak.from + ", " + peak.to +
              "]\", that: \"x" + (two ? " + y*(t - " + centre + ")" : "") + " > u*" + peak.text +
              "\"}\n    below: x < u*k\ndata: {u: " + decimal(unit) + ", k: " + decimal(k) + "}\n",
          draw.is_yes(), draw.is_easy()};
}

}  // namespace

std::vector<Family> interval_families() { return {{"above", 6, above}}; }

}  // namespace gainsmith::tests::properties
