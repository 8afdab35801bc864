#include "base/progress.h"

namespace gainsmith {

namespace {

// Texts of several threads replace one another: any of them is what is being done.
std::atomic<const char*> current = nullptr;
std::atomic<std::uint64_t> all = 0;
std::atomic<std::uint64_t> done = 0;

}  // namespace

Doing::Doing(const char* what, std::uint64_t of) : shown_(all == 0) {
  if (!shown_) return;
  before_ = current.exchange(what);
  done = 0;
  all = of;
}

Doing::~Doing() {
  if (!shown_) return;
  all = 0;
  current = before_;
}

void Doing::step(std::uint64_t steps) { done += steps; }

std::string Doing::now() {
  const char* const what = current;
  if (what == nullptr) return {};
  const std::uint64_t of = all;
  return of == 0 ? std::string(what)
                 : std::string(what) + " " + std::to_string(done) + "/" + std::to_string(of);
}

}  // namespace gainsmith
