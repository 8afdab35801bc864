#include "gainsmith/interruptible.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "gainsmith/terminal.h"

namespace gainsmith::app {

namespace {

std::string message(std::uint64_t done, std::uint64_t all) {
  const std::string text = fmt::format("interrupted after {} of {} runs", done, all);
  if (done == 0) return text;
  return text + fmt::format("; --runs {} gives a verdict in the time that was spent", done);
}

}  // namespace

verify::Report interruptible_campaign(const model::Instance& instance, const model::Gains& gains,
                                      verify::CampaignOptions options) {
  std::uint64_t most = 0;
  std::uint64_t runs = 0;
  options.progress = [&, show = std::move(options.progress)](std::uint64_t done,
                                                             std::uint64_t all) {
    most = std::max(most, done);
    runs = all;
    if (show) show(done, all);
    if (done < all && interrupted()) throw Interrupted("");
  };
  try {
    return verify::run_campaign(instance, gains, options);
  } catch (const Interrupted&) {
    throw Interrupted(message(most, runs));
  }
}

}  // namespace gainsmith::app
