# Bullet's room, for any Bullet: add_bullet_worlds(NAME BULLET) creates a library linked to the target BULLET.
set(BULLET_WORLDS_DIR ${CMAKE_CURRENT_LIST_DIR})
function(add_bullet_worlds name bullet)
  list(TRANSFORM BULLET_WORLDS_SOURCES PREPEND ${BULLET_WORLDS_DIR}/)
  add_library(${name} STATIC ${BULLET_WORLDS_SOURCES})
  # Bullet headers trip g++'s maybe-uninitialized check where they are inlined
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_libraries(${name} PUBLIC mysim PRIVATE ${bullet})
endfunction()
set(BULLET_WORLDS_SOURCES
  deformable.cpp
  pbd.cpp
  soft_body.cpp
  worlds.cpp
  bodies.cpp)
