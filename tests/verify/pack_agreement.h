// Verdicts on many runs beside those of the careful run.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "packs/pack_runner.h"
#include "verify/judge.h"

namespace gainsmith::verify {

/// Expects that runs 0, 1, ... of a seed have the verdicts of careful runs, unless they are open: some
/// that hold, some that violate. `near`: by claim, how far scores may be apart, relative and absolute.
/// `most_open`: runs.
inline void expect_agreement(const Setup& setup, std::uint64_t seed,
                             const std::vector<packs::PackVerdict>& verdicts,
                             const std::function<double(std::size_t)>& near,
                             std::size_t most_open) {
  Judge judge(setup);
  std::size_t open = 0, held = 0, violated = 0;
  std::string reasons;
  for (std::uint64_t run = 0; run < verdicts.size(); ++run) {
    const packs::PackVerdict& pack = verdicts[run];
    if (pack.open) {
      ++open;
      reasons += packs::to_string(pack.why) + "; ";
      continue;
    }
    const RunVerdict careful = judge(seed, run);
    EXPECT_EQ(pack.happened, careful.happened) << "run " << run;
    for (std::size_t c = 0; c < pack.findings.size(); ++c) {
      const claims::Finding& finding = careful.findings[c];
      ++(pack.findings[c].violated() ? violated : held);
      EXPECT_EQ(pack.findings[c].sampled, finding.sampled);
      if (finding.undecided()) continue;
      EXPECT_EQ(pack.findings[c].violated(), finding.violated())
          << "run " << run << ", claim " << c << ": " << finding.value << " and " << finding.bound
          << " at t = " << finding.t << ", j = " << finding.j;
      if (!finding.sampled || !std::isfinite(finding.score)) continue;
      EXPECT_NEAR(pack.findings[c].score, finding.score, near(c) * (1 + std::abs(finding.score)))
          << "run " << run << ", claim " << c;
    }
  }
  EXPECT_GT(held, 0U);
  EXPECT_GT(violated, 0U);
  // What is ordinary is decided.
  EXPECT_LE(open, most_open) << reasons;
}

}  // namespace gainsmith::verify
