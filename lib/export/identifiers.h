// Names that a language accepts.
#pragma once

#include <set>
#include <string>

namespace gainsmith::exports {

enum class Language { c, matlab, python };

/// Whether a word means something in the language itself, or is a name that the written code uses:
/// `float`, `lambda`, `end`; `range`, `pow`, `gs3`.
bool is_reserved(Language language, const std::string& word);

/// Names of one scope, each given once.
class Identifiers {
 public:
  /// `taken`: names that the file uses itself.
  explicit Identifiers(Language language, const std::set<std::string>& taken = {})
      : language_(language), taken_(taken) {}

  /// What is no letter, digit or underscore becomes an underscore. A name that begins
  /// otherwise than with a letter gets an x before it, one that is reserved or taken an underscore
  /// behind it.
  std::string operator()(const std::string& name);

 private:
  Language language_;
  std::set<std::string> taken_;
};

}  // namespace gainsmith::exports
