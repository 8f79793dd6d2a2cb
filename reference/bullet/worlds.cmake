# add_bullet_worlds(NAME BULLET): creates a library of Bullet's worlds, linked to the target BULLET.
set(BULLET_WORLDS_DIR ${CMAKE_CURRENT_LIST_DIR})
function(add_bullet_worlds name bullet)
  list(TRANSFORM BULLET_WORLDS_SOURCES PREPEND ${BULLET_WORLDS_DIR}/)
  add_library(${name} STATIC ${BULLET_WORLDS_SOURCES})
  # g++'s maybe-uninitialized check fails where Bullet's headers are inlined
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_libraries(${name} PUBLIC mysim PRIVATE ${bullet})
endfunction()
set(BULLET_WORLDS_SOURCES
  deformable.cpp
  pbd.cpp
  soft_body.cpp
  worlds.cpp
  bodies.cpp)
