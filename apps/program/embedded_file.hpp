// Files embedded in the program by the assembler: a megabyte as a C++ literal costs the compiler minutes and memory, and
// literals longer than 64 KiB need not be supported. Paths are macros set by CMake, with the file as OBJECT_DEPENDS.
#pragma once

#include <string_view>

/// The section of constants, by the name that the format of the program gives it.
#ifdef _WIN32
#define ASHLAR_CONSTANTS ".section .rdata,\"dr\"\n"
#define ASHLAR_BACK ".text\n"
#else
#define ASHLAR_CONSTANTS ".pushsection .rodata\n"
#define ASHLAR_BACK ".popsection\n"
#endif

/// Embeds a file, at namespace scope of a source. @param name of its symbols, unique in the program
// ccache recognises embedded files by the spelling  .incbin "  inside the literal.
#define ASHLAR_EMBED(name, path)                  \
  __asm__(ASHLAR_CONSTANTS #name                  \
          "_begin:\n"                             \
          ".incbin \"" path "\"\n" #name          \
          "_end:\n"                               \
          ".global " #name                        \
          "_begin\n"                              \
          ".global " #name "_end\n" ASHLAR_BACK); \
  extern "C" {                                    \
  extern const char name##_begin[];               \
  extern const char name##_end[];                 \
  }

/// Text of an embedded file.
#define ASHLAR_EMBEDDED(name) \
  std::string_view(name##_begin, static_cast<std::size_t>(name##_end - name##_begin))
