// Variables of the environment, which libraries read.
#pragma once

namespace ashlar {

/// Sets a variable of this process, whatever it was. Not while other threads read the environment.
void set_environment(const char* name, const char* value);

}  // namespace ashlar
