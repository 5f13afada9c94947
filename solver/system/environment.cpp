#include "solver/system/environment.hpp"

#include <cstdlib>

namespace ashlar {

void set_environment(const char* name, const char* value) {
  setenv(name, value, 1);
}

}  // namespace ashlar
