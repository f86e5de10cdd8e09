# The native library: static, which our own program and tests use, too, or with VT_SHARED a shared one of the same
# objects. Vitrine::vitrine is what others link.

# Both may end in a shared library of somebody's.
set_target_properties(vitrine_core PROPERTIES POSITION_INDEPENDENT_CODE ON)

# Libraries that read pictures. VitrineConfig.cmake and vitrine.pc name them again, for who links a static Vitrine.
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(OpenEXR 3.1 CONFIG REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
set(picture_libraries PNG::PNG JPEG::JPEG OpenEXR::OpenEXRCore PkgConfig::WEBP)
target_link_libraries(vitrine_core PRIVATE ${picture_libraries})

# What a program in C must link besides: decoders; and since the glTF loader is C++, stdc++ and m with GCC.
set(cxx_libraries ${decoder_libraries} ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES} m)
list(REMOVE_ITEM cxx_libraries ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_DUPLICATES cxx_libraries)
target_link_libraries(vitrine_core PUBLIC ${cxx_libraries})
set(vitrine_library vitrine_core)

if(VT_SHARED)
  add_library(vitrine_shared SHARED $<TARGET_OBJECTS:vitrine_core>)
  target_include_directories(vitrine_shared INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
  target_link_libraries(vitrine_shared PRIVATE $<BUILD_INTERFACE:vitrine_flags> ${picture_libraries} ${cxx_libraries})
  # Before 1.0 each minor version may change the interface, so the name to load by holds it.
  set_target_properties(vitrine_shared PROPERTIES
    OUTPUT_NAME vitrine EXPORT_NAME vitrine LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  if(NOT APPLE)
    # Templates of std are visible whatever the compiler is told; they stay inside.
    set(exports ${PROJECT_SOURCE_DIR}/cmake/exports.map)
    target_link_options(vitrine_shared PRIVATE -Wl,--version-script=${exports})
    set_target_properties(vitrine_shared PROPERTIES LINK_DEPENDS ${exports})
  endif()
  set(vitrine_library vitrine_shared)
endif()
add_library(Vitrine::vitrine ALIAS ${vitrine_library})
