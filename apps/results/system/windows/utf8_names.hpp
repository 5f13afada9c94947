// Names of files are UTF-8 in this program. The standard library of GCC 12 writes them so, but reads them by mbrtowc of the
// C library, which takes one byte for one letter; the versions of these functions here are linked instead.
#pragma once

namespace ashlar {

/// Called once, so that they are linked.
void use_utf8_names();

}  // namespace ashlar
