# The public headers of the installed library: those that the umbrella headers include, and what these
# include. All others are internal. Includes of this project become <ashlar/...>, so that a user needs one
# include path, that of the installation. Run with -D: SOURCE (the project's folder), OUTPUT (a folder that is
# emptied), UMBRELLAS (headers, relative to SOURCE; installed without their folder and without "_library").
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${OUTPUT}")

# Where a header is found below include/ashlar: geometry/geometry.hpp is <ashlar/geometry.hpp>,
# apps/scene/scene_library.hpp is <ashlar/scene.hpp>, apps/scene/model/scene.hpp is <ashlar/scene/model/scene.hpp>.
function(installed_path header result)
  if(header IN_LIST UMBRELLAS)
    get_filename_component(header "${header}" NAME)
    string(REPLACE "_library.hpp" ".hpp" header "${header}")
  endif()
  string(REGEX REPLACE "^apps/" "" header "${header}")
  set(${result} "${header}" PARENT_SCOPE)
endfunction()

set(open ${UMBRELLAS})
set(public)
while(open)
  list(POP_FRONT open header)
  if(header IN_LIST public)
    continue()
  endif()
  list(APPEND public "${header}")
  file(STRINGS "${SOURCE}/${header}" includes REGEX "^#include \"")
  list(TRANSFORM includes REPLACE "^#include \"(.*)\".*$" "\\1")
  list(APPEND open ${includes})
endwhile()

foreach(header IN LISTS public)
  file(READ "${SOURCE}/${header}" text)
  string(REGEX MATCHALL "#include \"[^\"\n]*\"" includes "${text}")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "^#include \"(.*)\"$" "\\1" name "${include}")
    installed_path("${name}" name)
    string(REPLACE "${include}" "#include <ashlar/${name}>" text "${text}")
  endforeach()
  installed_path("${header}" name)
  file(WRITE "${OUTPUT}/ashlar/${name}" "${text}")
endforeach()
