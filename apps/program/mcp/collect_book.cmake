# Joins files to one that a program embeds: a line of the record separator (\x1e) and the name of a page, then its text.
#   cmake -DSOURCE=FOLDER -DOUTPUT=FILE -P collect_book.cmake -- PATH...
# Pages are named as the book and its links name them: howto/rock.md of apps/docs, scenes/slope.toml of data.
string(ASCII 30 separator)
set(all "")
set(follows FALSE)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(k RANGE ${last})
  set(path "${CMAKE_ARGV${k}}")
  if(follows)
    string(REGEX REPLACE "^(apps/docs|data)/" "" name "${path}")
    file(READ "${SOURCE}/${path}" text)
    string(APPEND all "${separator}${name}\n${text}")
  elseif("${path}" STREQUAL "--")
    set(follows TRUE)
  endif()
endforeach()
file(WRITE "${OUTPUT}" "${all}")
