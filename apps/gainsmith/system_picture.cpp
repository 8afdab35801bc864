#include "gainsmith/system_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gainsmith::app {

namespace {

using model::SystemPicture;
using response::ComplexMatrix;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kFrequency = "frequency, radians per unit of time";

drawing::Curve curve(std::string label, int colour) {
  drawing::Curve made;
  made.label = std::move(label);
  made.colour = colour;
  return made;
}

/// A thin line that explains the others.
drawing::Curve guide(std::vector<double> x, std::vector<double> y) {
  constexpr int kGrey = 7;
  drawing::Curve made;
  made.colour = kGrey;
  made.limit = true;
  made.t = std::move(x);
  made.value = std::move(y);
  return made;
}

void add_margins(const DrawnSystem& drawn, int colour, drawing::Panel& size,
                 drawing::Panel& phase) {
  if (!drawn.margins) return;
  drawing::Curve at_size = points(drawing::Mark::dot, colour), at_phase = at_size;
  const auto phases = response::phase(drawn.sweep, 0, 0);
  // The phase is known but for turns, which the sweep has.
  const auto phase_at = [&](double w, double degrees) {
    const auto& all = drawn.sweep.frequency;
    const auto at = std::lower_bound(all.begin(), all.end(), w) - all.begin();
    const double near =
        phases[static_cast<std::size_t>(std::min<std::ptrdiff_t>(at, std::ssize(all) - 1))];
    return degrees + 360 * std::round((near - degrees) / 360);
  };
  const auto is_shown = [&](double w) {
    return w >= drawn.sweep.frequency.front() && w <= drawn.sweep.frequency.back();
  };
  if (const auto& gain = drawn.margins->gain; gain && is_shown(gain->frequency)) {
    at_size.t.push_back(gain->frequency);
    at_size.value.push_back(-decibels(gain->value));
    at_phase.t.push_back(gain->frequency);
    at_phase.value.push_back(phase_at(gain->frequency, -180));
  }
  if (const auto& lag = drawn.margins->phase; lag && is_shown(lag->frequency)) {
    at_size.t.push_back(lag->frequency);
    at_size.value.push_back(0);
    at_phase.t.push_back(lag->frequency);
    at_phase.value.push_back(phase_at(lag->frequency, lag->value - 180));
  }
  if (at_size.t.empty()) return;
  size.curves.push_back(std::move(at_size));
  phase.curves.push_back(std::move(at_phase));
}

/// A line at a value that the curves of a panel pass.
void add_level(double value, drawing::Panel& panel) {
  double low = kNone, high = kNone;
  for (const drawing::Curve& curve : panel.curves)
    for (const double each : curve.value) {
      low = std::fmin(low, each);
      high = std::fmax(high, each);
    }
  if (!(low < value && value < high)) return;
  const std::vector<double>& t = panel.curves.front().t;
  panel.curves.push_back(guide({t.front(), t.back()}, {value, value}));
}

void add_bode(const std::vector<DrawnSystem>& systems, drawing::Figure& figure) {
  drawing::Panel size, phase;
  size.title = "size";
  size.axis = "dB";
  phase.title = "phase";
  phase.axis = "degrees";
  phase.degrees = true;
  int colour = 0;
  for (const DrawnSystem& drawn : systems) {
    for (Eigen::Index i = 0; i < drawn.system.outputs(); ++i)
      for (Eigen::Index j = 0; j < drawn.system.inputs(); ++j, ++colour) {
        drawing::Curve made = curve(drawn.label + element_label(drawn.system, i, j), colour);
        made.t = drawn.sweep.frequency;
        for (const ComplexMatrix& response : drawn.sweep.response)
          made.value.push_back(decibels(std::abs(response(i, j))));
        size.curves.push_back(made);
        made.label.clear();
        made.value = response::phase(drawn.sweep, i, j);
        phase.curves.push_back(std::move(made));
        add_margins(drawn, colour, size, phase);
      }
  }
  const bool loops = std::ranges::any_of(
      systems, [](const DrawnSystem& drawn) { return drawn.margins.has_value(); });
  if (loops) {
    add_level(0, size);
    add_level(-180, phase);
  }
  figure.axis = kFrequency;
  figure.logarithmic = true;
  figure.panels = {std::move(size), std::move(phase)};
}

void add_singular_values(const std::vector<DrawnSystem>& systems, drawing::Figure& figure) {
  drawing::Panel panel;
  panel.title = "singular values";
  panel.axis = "dB";
  int colour = 0;
  for (const DrawnSystem& drawn : systems) {
    const Eigen::Index count = std::min(drawn.system.inputs(), drawn.system.outputs());
    std::vector<drawing::Curve> curves;
    for (Eigen::Index k = 0; k < count; ++k) {
      curves.push_back(curve(k == 0 ? drawn.label : "", colour));
      curves.back().t = drawn.sweep.frequency;
    }
    for (const ComplexMatrix& response : drawn.sweep.response) {
      const numbers::Vector gains = response::gains_of(response);
      for (Eigen::Index k = 0; k < count; ++k)
        curves[static_cast<std::size_t>(k)].value.push_back(decibels(gains(k)));
    }
    for (drawing::Curve& curve : curves) panel.curves.push_back(std::move(curve));
    if (drawn.peak && std::isfinite(drawn.peak->frequency)) {
      drawing::Curve top = points(drawing::Mark::dot, colour);
      const auto& range = drawn.sweep.frequency;
      if (drawn.peak->frequency >= range.front() && drawn.peak->frequency <= range.back()) {
        top.t = {drawn.peak->frequency};
        top.value = {decibels(drawn.peak->value)};
        panel.curves.push_back(std::move(top));
      }
    }
    ++colour;
  }
  figure.axis = kFrequency;
  figure.logarithmic = true;
  figure.panels = {std::move(panel)};
}

std::vector<double> angles(double from, double to) {
  constexpr int kPoints = 180;
  std::vector<double> all;
  for (int k = 0; k <= kPoints; ++k) all.push_back(from + (to - from) * k / kPoints);
  return all;
}

drawing::Curve unit_circle() {
  std::vector<double> x, y;
  for (const double angle : angles(0, 2 * std::numbers::pi)) {
    x.push_back(std::cos(angle));
    y.push_back(std::sin(angle));
  }
  return guide(std::move(x), std::move(y));
}

/// For positive frequencies in lines, for negative ones in thin dashes. What is far from -1 is left out.
void add_nyquist(const std::vector<DrawnSystem>& systems, drawing::Figure& figure) {
  constexpr double kFar = 3;
  drawing::Panel panel;
  panel.title = "imaginary part";
  panel.across = "real part";
  panel.equal = true;
  panel.curves.push_back(unit_circle());
  int colour = 0;
  for (const DrawnSystem& drawn : systems) {
    drawing::Curve positive = curve(drawn.label, colour++);
    for (const ComplexMatrix& response : drawn.sweep.response) {
      const std::complex<double> l = response(0, 0);
      const bool far = !(std::abs(l) <= kFar);
      positive.t.push_back(far ? kNone : l.real());
      positive.value.push_back(far ? kNone : l.imag());
    }
    drawing::Curve negative = positive;
    negative.label.clear();
    negative.limit = true;
    for (double& value : negative.value) value = -value;
    panel.curves.push_back(std::move(positive));
    panel.curves.push_back(std::move(negative));
  }
  drawing::Curve critical = points(drawing::Mark::cross, 6);
  critical.label = "-1";
  critical.t = {-1};
  critical.value = {0};
  panel.curves.push_back(std::move(critical));
  figure.panels = {std::move(panel)};
}

/// What is far from 0 dB is left out.
void add_nichols(const std::vector<DrawnSystem>& systems, drawing::Figure& figure) {
  constexpr double kFar = 60;  // decibels
  drawing::Panel panel;
  panel.title = "size, dB";
  panel.across = "phase, degrees";
  panel.degrees = true;
  drawing::Curve critical = points(drawing::Mark::cross, 6);
  critical.t = {-180};
  int colour = 0;
  for (const DrawnSystem& drawn : systems) {
    drawing::Curve made = curve(drawn.label, colour++);
    const std::vector<double> phases = response::phase(drawn.sweep, 0, 0);
    for (std::size_t k = 0; k < phases.size(); ++k) {
      const double size = decibels(std::abs(drawn.sweep.response[k](0, 0)));
      if (!(std::abs(size) <= kFar)) continue;
      made.t.push_back(phases[k]);
      made.value.push_back(size);
      // -1 is at each of these phases.
      const double near = -180 + 360 * std::round((phases[k] + 180) / 360);
      if (std::abs(phases[k] - near) < 90 && !std::ranges::count(critical.t, near))
        critical.t.push_back(near);
    }
    panel.curves.push_back(std::move(made));
  }
  critical.label = "-1";
  critical.value.assign(critical.t.size(), 0);
  panel.curves.push_back(std::move(critical));
  figure.panels = {std::move(panel)};
}

void add_time(const std::vector<DrawnSystem>& systems, drawing::Figure& figure) {
  for (const DrawnSystem& drawn : systems)
    if (figure.panels.size() < static_cast<std::size_t>(drawn.system.outputs()))
      figure.panels.resize(static_cast<std::size_t>(drawn.system.outputs()));
  int colour = 0;
  for (const DrawnSystem& drawn : systems)
    for (std::size_t j = 0; j < drawn.time.size(); ++j, ++colour)
      for (Eigen::Index i = 0; i < drawn.system.outputs(); ++i) {
        drawing::Panel& panel = figure.panels[static_cast<std::size_t>(i)];
        panel.title = figure.panels.size() == 1 ? "output" : "y" + std::to_string(i + 1);
        drawing::Curve made = curve(
            drawn.label + (drawn.time.size() > 1 ? " u" + std::to_string(j + 1) : ""), colour);
        const response::TimeResponse& response = drawn.time[j];
        for (std::size_t k = 0; k < response.t.size(); ++k) {
          const double value = response.y(i, static_cast<Eigen::Index>(k));
          // An input that is held.
          if (drawn.system.is_sampled() && k > 0) {
            made.t.push_back(response.t[k]);
            made.value.push_back(made.value.back());
          }
          made.t.push_back(response.t[k]);
          made.value.push_back(value);
        }
        panel.curves.push_back(std::move(made));
      }
  figure.axis = "time";
}

/// Where all poles and zeros lie, and a little more.
struct Ground {
  double left = 0, right = 0, up = 0;
};

Ground ground_of(const std::vector<DrawnSystem>& systems) {
  Ground ground;
  for (const DrawnSystem& drawn : systems)
    for (const response::Matrix* roots : {&drawn.poles, &drawn.zeros})
      for (Eigen::Index k = 0; k < roots->rows(); ++k) {
        ground.left = std::min(ground.left, (*roots)(k, 0));
        ground.right = std::max(ground.right, (*roots)(k, 0));
        ground.up = std::max(ground.up, std::abs((*roots)(k, 1)));
      }
  const double size = std::max({-ground.left, ground.right, ground.up, 1e-300});
  ground.up = std::max(ground.up, size / 4);
  return ground;
}

constexpr double kDampings[] = {0.1, 0.3, 0.5, 0.7, 0.9};

/// Lines of equal damping, and the axes.
void add_guides(const std::vector<DrawnSystem>& systems, bool sampled, drawing::Panel& panel) {
  if (sampled) {
    panel.curves.push_back(unit_circle());
    for (const double damping : kDampings)
      for (const double side : {1.0, -1.0}) {
        std::vector<double> x, y;
        // z = exp(s T), s T = i angle - damping/sqrt(1 - damping^2) angle.
        for (const double angle : angles(0, std::numbers::pi)) {
          const double size = std::exp(-damping / std::sqrt(1 - damping * damping) * angle);
          x.push_back(size * std::cos(angle));
          y.push_back(side * size * std::sin(angle));
        }
        panel.curves.push_back(guide(std::move(x), std::move(y)));
      }
    return;
  }
  const Ground ground = ground_of(systems);
  panel.curves.push_back(guide({0, 0}, {-ground.up, ground.up}));
  if (ground.left == 0) return;
  for (const double damping : kDampings) {
    const double slope = std::sqrt(1 - damping * damping) / damping;
    const double reach = std::min(-ground.left, ground.up / slope);
    for (const double side : {1.0, -1.0})
      panel.curves.push_back(guide({0, -reach}, {0, side * slope * reach}));
  }
}

void add_poles(const std::vector<DrawnSystem>& systems, drawing::Figure& figure) {
  drawing::Panel panel;
  panel.title = "imaginary part; lines of damping 0.1, 0.3, 0.5, 0.7, 0.9";
  panel.across = "real part";
  const bool sampled = std::any_of(systems.begin(), systems.end(), [](const DrawnSystem& system) {
    return system.system.is_sampled();
  });
  panel.equal = sampled;
  add_guides(systems, sampled, panel);
  const auto add_all = [&](bool crosses) {
    int colour = 0;
    for (const DrawnSystem& drawn : systems) {
      const auto add = [&](const response::Matrix& roots, drawing::Mark mark, const char* what) {
        if (roots.rows() == 0) return;
        drawing::Curve made = points(mark, colour);
        made.label = drawn.label + what;
        for (Eigen::Index k = 0; k < roots.rows(); ++k) {
          made.t.push_back(roots(k, 0));
          made.value.push_back(roots(k, 1));
        }
        panel.curves.push_back(std::move(made));
      };
      if (crosses)
        add(drawn.poles, drawing::Mark::cross, " poles");
      else
        add(drawn.zeros, drawing::Mark::ring, " zeros");
      ++colour;
    }
  };
  // A cross is seen on a ring.
  add_all(false);
  add_all(true);
  figure.panels = {std::move(panel)};
}

}  // namespace

std::string element_label(const response::StateSpace& system, Eigen::Index i, Eigen::Index j) {
  if (system.is_single()) return "";
  return " y" + std::to_string(i + 1) + "/u" + std::to_string(j + 1);
}

double decibels(double gain) { return gain > 0 ? 20 * std::log10(gain) : kNone; }

drawing::Curve points(drawing::Mark mark, int colour) {
  drawing::Curve made;
  made.mark = mark;
  made.colour = colour;
  made.joined = false;
  return made;
}

drawing::Figure system_picture(SystemPicture kind, const std::vector<DrawnSystem>& systems) {
  drawing::Figure figure;
  switch (kind) {
    case SystemPicture::bode:
      add_bode(systems, figure);
      break;
    case SystemPicture::singular_values:
      add_singular_values(systems, figure);
      break;
    case SystemPicture::nyquist:
      add_nyquist(systems, figure);
      break;
    case SystemPicture::nichols:
      add_nichols(systems, figure);
      break;
    case SystemPicture::step:
    case SystemPicture::impulse:
      add_time(systems, figure);
      break;
    case SystemPicture::poles:
      add_poles(systems, figure);
      break;
    case SystemPicture::margins:  // over a scalar: system_scan.h
      break;
  }
  return figure;
}

}  // namespace gainsmith::app
