// The plant or an observer as read: states, flows, and what happens at events. The records that a
// design holds of them are in dynamics.h.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/declaration.h"
#include "model/dynamics.h"

namespace gainsmith::model {

/// A definition in terms of the states, such as y = C z.
struct Output : Named {
  std::string at{};  ///< the event at which alone it exists; empty: always
};

/// "sample: {every: [T1, T2], first: T1, if: q == 1, lost: 0.1}".
struct EventText {
  std::string name;
  Dynamics::EventKind kind = Dynamics::EventKind::when;
  std::optional<expr::Expression> what;   ///< the condition, or what rises, falls or crosses
  std::vector<expr::Expression> numbers;  ///< the lengths of `every`, the times of `at`
  std::vector<double> rows;               ///< times of `at` that a file says
  std::vector<expr::Expression> first;    ///< a value or the ends of a range
  std::optional<expr::Expression> only_if;
  double lost = 0;
  std::optional<int> lost_in_a_row;
  std::string left{};  ///< the timer's name for what is left of its clock; empty: "NAME.left"
  Place place;
};

/// The event of a timer.
constexpr const char* kTimerEvent = "timer";

/// New values of states, what they are made of, and how often the map runs.
struct PassText {
  std::vector<Let> let;
  std::vector<Named> map;
  bool repeats = false;
  std::optional<expr::Expression> until;
  std::optional<expr::Expression> at_most;
  bool go_on = false;
  Place place;
};

/// What a component does at an event.
struct ReactionText {
  std::string event;
  std::vector<PassText> passes;
  Place place;
};

struct FlowSetText {
  expr::Expression condition;
  std::string say;
  Place place;
};

struct Component {
  std::string name{};                  ///< "plant", "observer" or that of one of several
  std::vector<expr::Index> indices{};  ///< of an observer: it is a family, "for: i in 1..N"
  std::vector<Declaration> states{};
  std::vector<Declaration> modes{};  ///< whole numbers that never flow
  std::vector<Output> outputs{};
  std::vector<Let> let{};
  std::vector<Named> flow{};  ///< derivatives; a state without an entry stays constant
  std::vector<Named> jump{};  ///< as read: what it does when the timer has run down
  std::vector<EventText> events{};
  std::vector<ReactionText> at{};
  std::optional<expr::Expression> frozen{};
  std::vector<FlowSetText> flow_sets{};
  Place place{};
};

struct NoiseText {
  std::string name;
  Dynamics::NoiseKind kind = Dynamics::NoiseKind::normal;
  std::vector<expr::Expression> values;  ///< center and deviation or covariance; or the ends
  bool covariance = false;
  std::string event;  ///< of `new at`
  std::optional<expr::Expression> every;
  /// amplitude*sin(frequency*t + phase), each a value or the ends of a range from which it is drawn
  /// once a run; empty: it is no sinusoid.
  std::vector<std::pair<std::string, std::vector<expr::Expression>>> sinusoid{};
  Place place;
};

}  // namespace gainsmith::model
