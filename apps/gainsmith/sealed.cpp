#include "gainsmith/sealed.h"

#include <utility>

#include "base/error.h"
#include "base/hash.h"

namespace gainsmith::app {

namespace {

constexpr const char* kSeal = "sha256";

}  // namespace

std::string sealed(io::Json document) {
  document[kSeal] = sha256(io::to_text(document));
  return io::to_text(document);
}

io::Json unsealed(const std::string& text, const std::string& file, const std::string& what) {
  io::Json document = io::parse_json(text, file);
  const auto seal = document.is_object() ? document.find(kSeal) : document.end();
  if (seal == document.end() || !seal->is_string()) throw InputError({file}, "expected " + what);
  const std::string said = seal->get<std::string>();
  document.erase(kSeal);
  if (sha256(io::to_text(document)) != said)
    throw InputError({file}, "this file is damaged: what it says does not match its sha256");
  return document;
}

}  // namespace gainsmith::app
