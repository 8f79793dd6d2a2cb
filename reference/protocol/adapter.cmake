# What adapters that are built against a tree of their engine have in common: the target mysim, the libraries of a build
# of crosscheck.
#   CROSSCHECK_BUILD   that build's folder
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CROSSCHECK_BUILD "" CACHE PATH "the build folder of crosscheck")
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(Threads REQUIRED)

get_filename_component(CROSSCHECK_SOURCE ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
add_library(mysim INTERFACE)
target_include_directories(mysim INTERFACE ${CROSSCHECK_SOURCE})
# as the rooms themselves are compiled: a fused multiply-add would give other numbers
target_compile_options(mysim INTERFACE -ffp-contract=off -fno-math-errno)
target_link_libraries(mysim INTERFACE
  ${CROSSCHECK_BUILD}/reference/libprotocol.a ${CROSSCHECK_BUILD}/mysim/libmysim.a Eigen3::Eigen fmt::fmt)
