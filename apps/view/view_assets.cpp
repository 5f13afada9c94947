// The files are taken in by the assembler: a megabyte as a C++ literal takes the compiler minutes and memory,
// and longer literals than 64 KiB need not be accepted at all. The macros ASHLAR_VIEW_* are paths set by
// CMake.
#include "apps/view/view_assets.hpp"

// The spelling  .incbin "  inside the literal is what ccache looks for to know that a file is read.
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
ASHLAR_EMBED(ashlar_view_script_data, ASHLAR_VIEW_SCRIPT_DATA)
ASHLAR_EMBED(ashlar_view_script_scene, ASHLAR_VIEW_SCRIPT_SCENE)
ASHLAR_EMBED(ashlar_view_script_panels, ASHLAR_VIEW_SCRIPT_PANELS)
ASHLAR_EMBED(ashlar_view_script_page, ASHLAR_VIEW_SCRIPT_PAGE)
ASHLAR_EMBED(ashlar_view_three, ASHLAR_VIEW_THREE)
ASHLAR_EMBED(ashlar_view_orbit_controls, ASHLAR_VIEW_ORBIT_CONTROLS)
ASHLAR_EMBED(ashlar_view_chart, ASHLAR_VIEW_CHART)

namespace ashlar {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

ViewAssets view_assets() {
  return {between(ashlar_view_page_begin, ashlar_view_page_end),
          between(ashlar_view_style_begin, ashlar_view_style_end),
          between(ashlar_view_script_data_begin, ashlar_view_script_data_end),
          between(ashlar_view_script_scene_begin, ashlar_view_script_scene_end),
          between(ashlar_view_script_panels_begin, ashlar_view_script_panels_end),
          between(ashlar_view_script_page_begin, ashlar_view_script_page_end),
          between(ashlar_view_three_begin, ashlar_view_three_end),
          between(ashlar_view_orbit_controls_begin, ashlar_view_orbit_controls_end),
          between(ashlar_view_chart_begin, ashlar_view_chart_end)};
}

}  // namespace ashlar
