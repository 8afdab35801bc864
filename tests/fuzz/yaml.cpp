// A problem and its method are read and bound, or refused with an InputError at a place inside the
// text.
//
// Behind a line "---" stands a method of the problem's own, in whatever name the problem asks for;
// without one the methods of the program are there.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "bind/bind.h"
#include "fuzz/places.h"
#include "fuzz/readers.h"
#include "io/yaml/problem_yaml.h"
#include "methods/methods.h"

namespace gainsmith::io {
namespace {

const std::string kFile = "fuzz.yaml";
constexpr std::string_view kBetween = "\n---\n";

/// Everything that is done with a problem before it is solved.
void bind(const model::Problem& problem) { bind::bind(problem); }

struct Texts {
  std::string problem;
  std::optional<std::string> method;
};

Texts split(std::string_view text) {
  const std::size_t at = text.find(kBetween);
  if (at == std::string_view::npos) return {std::string(text), std::nullopt};
  return {std::string(text.substr(0, at + 1)), std::string(text.substr(at + kBetween.size()))};
}

void run(const Texts& texts) {
  const MethodLibrary library{
      [&](const std::string& name) { return texts.method ? texts.method : methods::find(name); },
      methods::names()};
  bind(parse_problem(texts.problem, kFile, library));
}

}  // namespace
}  // namespace gainsmith::io

bool gainsmith::fuzz::read_yaml(std::string_view bytes) {
  const io::Texts texts = io::split(bytes);
  try {
    io::run(texts);
    return true;
  } catch (const InputError& error) {
    const bool about_the_whole_file = error.place() == Place{io::kFile};
    if (!about_the_whole_file) require_place(error, io::kFile, texts.problem);
    return false;
  }
}
