// The files are embedded by the assembler: a megabyte as a C++ literal costs the compiler minutes and memory, and
// literals longer than 64 KiB need not be supported. The macros ASHLAR_VIEW_* are paths set by CMake.
#include "apps/program/view/view_assets.hpp"

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

ASHLAR_EMBED(ashlar_view_page, ASHLAR_VIEW_PAGE)
ASHLAR_EMBED(ashlar_view_style, ASHLAR_VIEW_STYLE)
ASHLAR_EMBED(ashlar_view_script, ASHLAR_VIEW_SCRIPT)
ASHLAR_EMBED(ashlar_view_three, ASHLAR_VIEW_THREE)
ASHLAR_EMBED(ashlar_view_orbit_controls, ASHLAR_VIEW_ORBIT_CONTROLS)
ASHLAR_EMBED(ashlar_view_segments_geometry, ASHLAR_VIEW_SEGMENTS_GEOMETRY)
ASHLAR_EMBED(ashlar_view_line_material, ASHLAR_VIEW_LINE_MATERIAL)
ASHLAR_EMBED(ashlar_view_line_segments, ASHLAR_VIEW_LINE_SEGMENTS)
ASHLAR_EMBED(ashlar_view_chart, ASHLAR_VIEW_CHART)

// The text between the symbols of an embedded file.
#define ASHLAR_EMBEDDED(name) \
  std::string_view(name##_begin, static_cast<std::size_t>(name##_end - name##_begin))

namespace ashlar {

ViewAssets view_assets() {
  return {ASHLAR_EMBEDDED(ashlar_view_page),
          ASHLAR_EMBEDDED(ashlar_view_style),
          ASHLAR_EMBEDDED(ashlar_view_script),
          {ASHLAR_EMBEDDED(ashlar_view_three), ASHLAR_EMBEDDED(ashlar_view_orbit_controls),
           ASHLAR_EMBEDDED(ashlar_view_segments_geometry), ASHLAR_EMBEDDED(ashlar_view_line_material),
           ASHLAR_EMBEDDED(ashlar_view_line_segments), ASHLAR_EMBEDDED(ashlar_view_chart)}};
}

}  // namespace ashlar
