// Pictures of linear systems: of the plant, a loop or a closed loop, by their matrices.
//
//   {bode: L}              size and phase of each element of H over the frequency
//   {singular values: S}   of H over the frequency
//   {nyquist: L}           H in the complex plane, one input and one output
//   {nichols: L}           size over phase, one input and one output
//   {step: T}, {impulse: T}  each output over time, for each input
//   {poles: T}             poles and zeros in the complex plane
//   {margins: L, scan: {r: [0.1, 10]}}  over the values of a scalar, one input and one output
//
// Several systems: [L, T], or with labels {open: L, closed: T}; `over: [a, b]` is the range of the
// frequency in radians per unit of time, or of the time. `scan: {r: [low, high]}` designs anew for
// values of a scalar: a locus of poles, curves. `plant.P` is P with the plant's values of the
// uncertain data: bands, or clouds of poles.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "expr/text/ast.h"
#include "model/formula.h"
#include "model/range.h"

namespace gainsmith::model {

enum class SystemPicture { bode, singular_values, nyquist, nichols, step, impulse, poles, margins };

/// What a picture is computed over.
enum class PictureRange { frequency, time, none };

struct SystemPictureKind {
  SystemPicture kind;
  std::string_view key;
  PictureRange over;
  bool single;  ///< of one input and one output alone
};

/// All kinds, in the order of SystemPicture.
inline constexpr std::array kSystemPictures = {
    SystemPictureKind{SystemPicture::bode, "bode", PictureRange::frequency, false},
    SystemPictureKind{SystemPicture::singular_values, "singular values", PictureRange::frequency,
                      false},
    SystemPictureKind{SystemPicture::nyquist, "nyquist", PictureRange::frequency, true},
    SystemPictureKind{SystemPicture::nichols, "nichols", PictureRange::frequency, true},
    SystemPictureKind{SystemPicture::step, "step", PictureRange::time, false},
    SystemPictureKind{SystemPicture::impulse, "impulse", PictureRange::time, false},
    SystemPictureKind{SystemPicture::poles, "poles", PictureRange::none, false},
    SystemPictureKind{SystemPicture::margins, "margins", PictureRange::none, true}};

constexpr const SystemPictureKind& kind_of(SystemPicture picture) {
  return kSystemPictures[static_cast<std::size_t>(picture)];
}
inline std::string to_string(SystemPicture picture) { return std::string(kind_of(picture).key); }

/// As read.
struct SystemFigureText {
  struct System {
    std::string label;
    expr::Expression text;
  };
  std::string name;
  SystemPicture kind = SystemPicture::bode;
  std::vector<System> systems;
  std::optional<std::pair<expr::Expression, expr::Expression>> over;
  std::optional<ScalarRange> scan;
  std::string title;  ///< empty: the name
  Place place;
};

/// As bound: programs over data, parameters, gains and unknowns.
struct SystemFigure {
  struct System {
    std::string label;
    expr::Program matrix;               ///< [A, B; C, D]
    int states = 0;                     ///< its first rows and columns
    std::optional<expr::Program> step;  ///< the sampling time; none: continuous
    Place place;
  };
  std::string name;
  SystemPicture kind = SystemPicture::bode;
  std::vector<System> systems;
  std::optional<std::pair<Formula, Formula>> over;
  std::optional<Range> scan;
  std::string title;
  bool varies = false;  ///< it reads uncertain data of the plant (Design::varied)
  Place place;
};

}  // namespace gainsmith::model
