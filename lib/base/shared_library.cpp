#include "base/shared_library.h"

#include <dlfcn.h>

#include "base/error.h"

namespace gainsmith {

SharedLibrary::SharedLibrary(const std::string& file, const std::string& use)
    : file_(file), handle_(::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr)
    throw InputError({file}, std::string("cannot be loaded (") + ::dlerror() + "); " + use);
}

void* SharedLibrary::address(const char* name) const {
  void* const found = ::dlsym(handle_, name);
  if (found == nullptr) throw InputError({file_}, std::string("has no function ") + name);
  return found;
}

}  // namespace gainsmith
