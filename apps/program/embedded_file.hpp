// Files embedded in the program by the assembler: a megabyte as a C++ literal costs the compiler minutes and memory, and
// literals longer than 64 KiB need not be supported. Paths are macros set by CMake, with the file as OBJECT_DEPENDS.
#pragma once

#include <string_view>

/// The section of constants, by the name that the format of the program gives it. In WebAssembly each file has a section of
/// its own, symbols have sizes, and a symbol at the very end of a section has none.
#if defined(_WIN32)
#define ASHLAR_CONSTANTS(name) ".section .rdata,\"dr\"\n"
#define ASHLAR_SIZES(name)
#define ASHLAR_BACK ".text\n"
#elif defined(__wasm__)
#define ASHLAR_CONSTANTS(name) ".section .rodata." #name ",\"\",@\n"
#define ASHLAR_SIZES(name) \
  ".int8 0\n.size " #name "_begin, " #name "_end - " #name "_begin\n.size " #name "_end, 1\n"
#define ASHLAR_BACK ".text\n"
#else
#define ASHLAR_CONSTANTS(name) ".pushsection .rodata\n"
#define ASHLAR_SIZES(name)
#define ASHLAR_BACK ".popsection\n"
#endif

#define ASHLAR_LABEL(name) ".globl " #name "\n" #name ":\n"

/// Embeds a file, at namespace scope of a source. @param name of its symbols, unique in the program
// ccache recognises embedded files by the spelling  .incbin "  inside the literal.
#define ASHLAR_EMBED(name, path)                                                                   \
  __asm__(ASHLAR_CONSTANTS(name) ASHLAR_LABEL(name##_begin) ".incbin \"" path "\"\n" ASHLAR_LABEL( \
      name##_end) ASHLAR_SIZES(name) ASHLAR_BACK);                                                 \
  extern "C" {                                                                                     \
  extern const char name##_begin[];                                                                \
  extern const char name##_end[];                                                                  \
  }

/// Text of an embedded file.
#define ASHLAR_EMBEDDED(name) \
  std::string_view(name##_begin, static_cast<std::size_t>(name##_end - name##_begin))
