#include "apps/program/view/view_assets.hpp"

#include "apps/program/embedded_file.hpp"

ASHLAR_EMBED(ashlar_view_page, ASHLAR_VIEW_PAGE)
ASHLAR_EMBED(ashlar_view_style, ASHLAR_VIEW_STYLE)
ASHLAR_EMBED(ashlar_view_script, ASHLAR_VIEW_SCRIPT)
ASHLAR_EMBED(ashlar_view_three, ASHLAR_VIEW_THREE)
ASHLAR_EMBED(ashlar_view_orbit_controls, ASHLAR_VIEW_ORBIT_CONTROLS)
ASHLAR_EMBED(ashlar_view_segments_geometry, ASHLAR_VIEW_SEGMENTS_GEOMETRY)
ASHLAR_EMBED(ashlar_view_line_material, ASHLAR_VIEW_LINE_MATERIAL)
ASHLAR_EMBED(ashlar_view_line_segments, ASHLAR_VIEW_LINE_SEGMENTS)
ASHLAR_EMBED(ashlar_view_chart, ASHLAR_VIEW_CHART)

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
