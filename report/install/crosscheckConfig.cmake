# find_package(crosscheck): mysim as a library, and the header for external engines.
#   crosscheck::mysim      the library behind <crosscheck/mysim.h>
#   crosscheck::protocol   the header <crosscheck_engine.h>, which has no dependencies
#   crosscheck_SCENES      the folder of the shipped scenes
include(CMakeFindDependencyMacro)
find_dependency(fmt)
find_dependency(Threads)
get_filename_component(crosscheck_PREFIX ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
set(crosscheck_SCENES ${crosscheck_PREFIX}/share/crosscheck/experiments/scenes)
if(NOT TARGET crosscheck::mysim)
  add_library(crosscheck::mysim STATIC IMPORTED)
  set_target_properties(crosscheck::mysim PROPERTIES
    IMPORTED_LOCATION ${crosscheck_PREFIX}/lib/crosscheck/libmysim.a
    INTERFACE_INCLUDE_DIRECTORIES ${crosscheck_PREFIX}/include
    INTERFACE_COMPILE_FEATURES cxx_std_20
    INTERFACE_LINK_LIBRARIES "fmt::fmt;Threads::Threads")
  add_library(crosscheck::protocol INTERFACE IMPORTED)
  set_target_properties(crosscheck::protocol PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${crosscheck_PREFIX}/include/crosscheck)
endif()
