// Libraries that are loaded when something needs them.
#pragma once

#include <string>

namespace gainsmith {

/// A shared library, loaded from where the system finds it. It stays until the program ends.
class SharedLibrary {
 public:
  /// `file`: its name with its version, "libnlopt.so.0". `use`: what needs it, for the InputError
  /// where it is not there.
  SharedLibrary(const std::string& file, const std::string& use);

  /// The C function `name`, whose declaration is `Function`. InputError where there is none; a
  /// wrong declaration is undefined behaviour.
  template <typename Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(address(name));
  }

 private:
  void* address(const char* name) const;

  std::string file_;
  void* handle_;
};

}  // namespace gainsmith
