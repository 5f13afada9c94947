// Files embedded in the program by the assembler: a megabyte as a C++ literal costs the compiler minutes and memory, and
// literals longer than 64 KiB need not be supported. Paths are macros set by CMake, with the file as OBJECT_DEPENDS.
#pragma once

#include <string_view>

/// Embeds a file, at namespace scope of a source. @param name of its symbols, unique in the program
// ccache recognises embedded files by the spelling  .incbin "  inside the literal.
#define ASHLAR_EMBED(name, path)         \
  __asm__(".pushsection .rodata\n" #name \
          "_begin:\n"                    \
          ".incbin \"" path "\"\n" #name \
          "_end:\n"                      \
          ".global " #name               \
          "_begin\n"                     \
          ".global " #name               \
          "_end\n"                       \
          ".popsection\n");              \
  extern "C" {                           \
  extern const char name##_begin[];      \
  extern const char name##_end[];        \
  }

/// Text of an embedded file.
#define ASHLAR_EMBEDDED(name) \
  std::string_view(name##_begin, static_cast<std::size_t>(name##_end - name##_begin))
