// The values of a run in 31 digits, beside those in double by which its events are found.
//
//   flows    steps of the method of Gauss with 16 stages (ode/gauss_stages.h), whose ends are of order 32
//   jumps    the maps in 31 digits (jump_maps.h)
//   times    an event is found in double. Where its guard has come to 0 along the flow, or its clock
//            strikes, the values are moved along the flow to the time at which that is so in 31 digits
//
// Every number of a text enters as its decimals; what is drawn is the double that it is.
//
// A step solves K_i = f(x + h sum_j a_ij K_j), i = 1, ..., 16. First fixed-point iteration in
// double finds K to 16 digits; then each correction d = r + h J (d A') of the residual r in 31
// digits adds some 7 digits, with J by differences in double. The last two of the Legendre
// coefficients of x' on the step say how long a step may be.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "hybrid/scenario.h"
#include "simulate/event_watch.h"
#include "simulate/function_31.h"
#include "simulate/last_places.h"
#include "simulate/vector_field.h"

namespace gainsmith::simulate {

/// Of the last places of a double: those of 31 digits.
constexpr double k31LastPlaces = 0x1p-52;

class State31 {
 public:
  /// Whether runs may be made so: all constants, and where they start, are known.
  static bool may_run(const hybrid::System& system, const hybrid::Scenario& scenario);
  /// Both must outlive it, and may_run.
  State31(const hybrid::System& system, const hybrid::Scenario& scenario);

  /// The start of a run. `values`: in double, with the first noise. `moved`: by which values are
  /// moved in the last of their 31 digits; it must outlive the run.
  void begin(std::uint64_t run, const Eigen::VectorXd& values, const hybrid::EventClocks& clocks,
             const LastPlaces* moved);
  const Constants31& constants() const { return constants_; }
  const Values31& values() const { return x_; }
  /// Noise and branches are what they are in double.
  void adopt(const Eigen::VectorXd& values);
  /// Noise is drawn anew within a flow, or measured data have a row: what is given is what it is in
  /// double. `arrives`: just now, so that the values go to that time.
  void adopt_given(const Eigen::VectorXd& values, bool arrives);

  /// A flow begins, from these values on.
  void begin_flow(VectorField& field, const Eigen::VectorXd& values);
  /// A step of the flow to a time: its last terms, of what they may be. Infinite: there is none.
  double step(double to);
  /// All values along the step, in double, one column for each of its parts in [0, 1].
  numbers::Matrix along(const Eigen::VectorXd& parts) const;
  /// The step is taken, up to a time on it.
  void arrive(double to);

  /// An event is due: goes to the time at which it is. `by_flow`: the flow has led to it. Where that
  /// time is not certain, a perturbed run is moved by the last places of a double.
  void meet(std::size_t event, EventWatch& watch, const Eigen::VectorXd& values,
            const hybrid::EventClocks& clocks, bool by_flow);
  /// The same of a switch whose branch changes along the flow.
  void meet_switch(std::size_t which, Eigen::Index element);
  /// After the jump of an event: all values.
  void jumped(std::size_t event, const Values31& after, const hybrid::EventClocks& clocks);

 private:
  /// x' of one variable, by its text.
  struct Rate {
    std::size_t variable = 0;
    Function31 value;
    bool rests = false;  ///< its component is frozen
  };
  /// t, since(event) or event.left: a line of slope 1 or -1.
  struct Clock {
    Eigen::Index element = 0;
    model::Dynamics::VariableKind kind{};
    std::size_t event = 0;
  };
  using Guard = std::function<DoubleDouble()>;

  void add_clocks(std::size_t event);
  Values31 start_of(std::uint64_t run, const Eigen::VectorXd& values);
  /// x' of all elements: 0 of what rests, 1 or -1 of clocks.
  void rates(const Values31& x, Values31& rate);
  /// Whether the time of the event is certain in 31 digits; then the values are those there.
  bool goes_to(std::size_t event, EventWatch& watch, const Eigen::VectorXd& values,
               const hybrid::EventClocks& clocks, bool by_flow);
  /// Moves states of a perturbed run by `part` of the last places of a double.
  void move(double part);
  void blur() { move(1); }
  bool solve_in_double();
  double residual(Matrix31& residual);
  void correct(const Matrix31& residual);
  /// The time of a clock in 31 digits that is nearest to the rounded one.
  DoubleDouble due(std::size_t event, double rounded) const;
  void fill_clocks(const hybrid::EventClocks& clocks);
  /// Along the flow by a small time, by the midpoint rule: the error is of order by^3.
  void shift(const DoubleDouble& by);
  /// Newton steps to the root of a guard along the flow, by differences. False where none is near.
  bool shift_to_root(const Guard& guard);

  const hybrid::System* system_;
  const hybrid::Scenario* scenario_;
  Constants31 constants_;
  std::vector<Rate> rates_;
  std::vector<Clock> clocks_;
  std::vector<Eigen::Index> adopted_, measured_;  ///< elements that are what they are in double
  std::vector<DoubleDouble> drawn_every_;         ///< of noise
  std::vector<Eigen::Index> moving_;              ///< elements
  std::vector<std::vector<Function31>> guards_;   ///< by event: its crossing, or its comparisons
  std::vector<Function31> switches_;
  std::vector<std::vector<DoubleDouble>> times_;             ///< by event: of `at`
  std::vector<std::optional<DoubleDouble>> period_, first_;  ///< by event, of `every`

  const LastPlaces* moved_ = nullptr;
  VectorField* field_ = nullptr;         ///< of the flow
  std::vector<bool> is_integrated_;      ///< of what moves: by the field
  std::vector<numbers::Matrix> slopes_;  ///< of the rates that the field integrates, by stage
  Values31 x_, end_;
  DoubleDouble t_;
  std::vector<DoubleDouble> since_;  ///< by event: the time of its last jump
  std::vector<double> drawn_first_;  ///< by event: of a clock whose first time is drawn
  double to_ = 0;                    ///< of the step
  DoubleDouble length_;              ///< of the step
  Eigen::VectorXd sizes_;            ///< the largest values so far, by which errors are measured
  double longest_ = 0;               ///< of those that have been taken
  Matrix31 stages_;                  ///< rates of what moves, one column a stage
};

}  // namespace gainsmith::simulate
