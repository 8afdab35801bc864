#include "base/shared_library.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace gainsmith {
namespace {

TEST(SharedLibrary, GivesFunctionsOrSaysWhatNeedsThem) {
  const SharedLibrary library("libm.so.6", "it is needed");
  double (*const root)(double) = library.function<double(double)>("cbrt");
  EXPECT_NEAR(root(27), 3, 1e-14);
  EXPECT_THROW(library.function<void()>("there_is_no_such_function"), InputError);
  try {
    const SharedLibrary none("libnone.so.7", "a search needs it");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().file, "libnone.so.7");
    EXPECT_NE(error.message().find("a search needs it"), std::string::npos);
  }
}

}  // namespace
}  // namespace gainsmith
