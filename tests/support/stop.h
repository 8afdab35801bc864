// A stop (base/stop.h) within one test.
#pragma once

#include "base/stop.h"

namespace gainsmith::tests {

/// Nothing is stopped after it; `now`: everything is until then.
class StopInTest {
 public:
  explicit StopInTest(bool now = false) { stop_requested = now; }
  ~StopInTest() { stop_requested = false; }
  StopInTest(const StopInTest&) = delete;
  StopInTest& operator=(const StopInTest&) = delete;
};

}  // namespace gainsmith::tests
