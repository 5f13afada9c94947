# Finds the C library of HDF5, as Debian has it beside others for MPI, as Hdf5Serial::hdf5. Programs are linked with the
# static library where there is one: the shared one loads thirty others (curl and what that needs), which takes longer
# than the start of the program. Modules cannot be: it is not position-independent.
find_path(HDF5SERIAL_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(HDF5SERIAL_LIBRARY NAMES hdf5_serial hdf5)
find_library(HDF5SERIAL_STATIC_LIBRARY NAMES libhdf5_serial.a)
find_library(HDF5SERIAL_SZ_LIBRARY sz)
find_package(ZLIB QUIET)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Hdf5Serial DEFAULT_MSG HDF5SERIAL_LIBRARY HDF5SERIAL_INCLUDE_DIR)
if(Hdf5Serial_FOUND AND NOT TARGET Hdf5Serial::hdf5)
  add_library(Hdf5Serial::hdf5 INTERFACE IMPORTED)
  target_include_directories(Hdf5Serial::hdf5 SYSTEM INTERFACE "${HDF5SERIAL_INCLUDE_DIR}")
  if(HDF5SERIAL_STATIC_LIBRARY AND HDF5SERIAL_SZ_LIBRARY AND ZLIB_FOUND)
    set(hdf5serial_is_program "$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>")
    target_link_libraries(Hdf5Serial::hdf5 INTERFACE
      "$<IF:${hdf5serial_is_program},${HDF5SERIAL_STATIC_LIBRARY};${HDF5SERIAL_SZ_LIBRARY};ZLIB::ZLIB;dl;m,${HDF5SERIAL_LIBRARY}>")
  else()
    target_link_libraries(Hdf5Serial::hdf5 INTERFACE "${HDF5SERIAL_LIBRARY}")
    if(WIN32) # a static library without compression by szip
      target_link_libraries(Hdf5Serial::hdf5 INTERFACE ZLIB::ZLIB)
    endif()
  endif()
endif()
mark_as_advanced(HDF5SERIAL_INCLUDE_DIR HDF5SERIAL_LIBRARY HDF5SERIAL_STATIC_LIBRARY HDF5SERIAL_SZ_LIBRARY)
