// Internal to export: what the writers of observers in several languages have in common.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "export/content.h"
#include "export/scalar_code.h"

namespace gainsmith::exports {

/// What writing adds to besides its text: functions that the text needs, and what is left out.
struct Remarks {
  std::set<std::string> helpers;
  bool library = false;  ///< of C: <math.h> is needed
  std::vector<std::string> notes;

  /// Adds what this code needs.
  void add(const Code& code);
};

/// The order of the maps of an observer and what is left out of them; a language adds the texts.
/// `content` and `observer` must outlive the writer.
class ObserverWriter {
 protected:
  /// `names`: of what the maps read besides states and inputs, which a writer adds.
  ObserverWriter(const Content& content, const Observer& observer, const Dialect& dialect,
                 ElementNames names, Remarks& remarks)
      : content_(content),
        observer_(observer),
        dialect_(dialect),
        names_(std::move(names)),
        remarks_(remarks) {}

  /// The text of a map; nothing, and a note with the consequence, where it has no formula on
  /// numbers.
  std::string attempt(const std::string& what, const std::function<std::string()>& map,
                      const std::string& consequence = "");
  /// Its flow, its exact flow, its maps and its outputs, by attempt().
  std::string maps();
  /// Each gives the text of one map; NoCode where an operation has no formula on numbers.
  virtual std::string rate() = 0;
  virtual std::string flow() = 0;
  virtual std::string jump(const Jump& jump) = 0;
  virtual std::string output(const Output& output) = 0;

  /// The statements of programs; what they need is added to the remarks.
  Code code(const std::vector<expr::Program>& programs);
  static std::vector<expr::Program> programs_of(const std::vector<Assigned>& list);
  static std::vector<expr::Program> programs_of(const Jump& jump);
  /// The inputs that programs read, in the order of the observer.
  std::vector<const Variable*> inputs_read(const std::vector<expr::Program>& programs) const;
  /// The names of the parameters for them, ", u, y".
  std::string parameter_names(const std::vector<expr::Program>& programs) const;

  /// " Units: u [V], dt [s]." of inputs, and of a time where it has a name; nothing without units.
  std::string units_text(const std::vector<const Variable*>& inputs,
                         const std::string& time = "") const;

  /// The constant part of a linear flow: the rates where the states are 0.
  std::vector<expr::Program> rate_at_rest() const;
  /// The elements of the states that have another rate there than 0, with it; `made`: the code of
  /// rate_at_rest().
  std::vector<std::pair<int, std::string>> nonzero_elements(const Code& made) const;

  const Content& content_;
  const Observer& observer_;
  Dialect dialect_;
  ElementNames names_;
  Remarks& remarks_;
  std::vector<std::string> fields_;                ///< names of the states
  std::map<std::string, std::string> parameters_;  ///< names of the inputs, by key

 public:
  virtual ~ObserverWriter() = default;
};

}  // namespace gainsmith::exports
