# Provides the target mysim (crosscheck's own libraries) to adapters that are built against a tree of their engine.
#   CROSSCHECK_LIBRARIES   folder of the libraries: a build folder, or lib/crosscheck of an installation
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CROSSCHECK_LIBRARIES "" CACHE PATH "the folder of libmysim.a and libprotocol.a")
find_package(Eigen3 3.4...5 QUIET NO_MODULE)
if(NOT Eigen3_FOUND)  # Eigen 3.4 does not understand ranges of versions
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
endif()
find_package(fmt REQUIRED)
find_package(Threads REQUIRED)

get_filename_component(CROSSCHECK_SOURCE ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
add_library(mysim INTERFACE)
target_include_directories(mysim INTERFACE ${CROSSCHECK_SOURCE})
# same flags as crosscheck's own libraries: a fused multiply-add would change results
target_compile_options(mysim INTERFACE -ffp-contract=off -fno-math-errno)
target_link_libraries(mysim INTERFACE
  ${CROSSCHECK_LIBRARIES}/libprotocol.a ${CROSSCHECK_LIBRARIES}/libmysim.a Eigen3::Eigen fmt::fmt)
