#include "solver/system/environment.hpp"

#include <stdlib.h>

#include <string>

namespace ashlar {

void set_environment(const char* name, const char* value) {
  ::_putenv((std::string(name) + "=" + value).c_str());
}

}  // namespace ashlar
