# What `cmake --install` and `cpack` put where; the components are vitrine_program, vitrine_runtime (a shared library)
# and vitrine_development.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Vitrine)
install(TARGETS ${vitrine_library} EXPORT VitrineTargets
  LIBRARY COMPONENT vitrine_runtime NAMELINK_COMPONENT vitrine_development
  ARCHIVE COMPONENT vitrine_development
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${public_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vitrine COMPONENT vitrine_development)

# find_package(Vitrine). Beside a static library the program must link those that read pictures.
install(EXPORT VitrineTargets NAMESPACE Vitrine:: DESTINATION ${package_dir} COMPONENT vitrine_development)
set(find_libraries "")
if(NOT VT_SHARED)
  set(find_libraries "include(CMakeFindDependencyMacro)
find_dependency(PNG)
find_dependency(JPEG)
find_dependency(OpenEXR 3.1)
find_dependency(PkgConfig)
if(NOT TARGET PkgConfig::WEBP)
  pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
endif()
")
endif()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/VitrineConfig.cmake @ONLY CONTENT
  "@find_libraries@include(\${CMAKE_CURRENT_LIST_DIR}/VitrineTargets.cmake)\n")
install(FILES ${PROJECT_BINARY_DIR}/VitrineConfig.cmake DESTINATION ${package_dir} COMPONENT vitrine_development)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/VitrineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/VitrineConfigVersion.cmake DESTINATION ${package_dir} COMPONENT vitrine_development)

# pkg-config. The prefix is told from where vitrine.pc lies, so that all of it can be moved. A shared library knows
# what it needs; beside a static one the program must link that.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig
  OUTPUT_VARIABLE to_prefix)
set(linked -lvitrine)
set(required "")
if(NOT VT_SHARED)
  set(required "Requires: libpng libjpeg libwebp OpenEXR >= 3.1")
  foreach(name IN LISTS cxx_libraries)
    string(APPEND linked " -l${name}")
  endforeach()
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/vitrine.pc.in ${PROJECT_BINARY_DIR}/vitrine.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/vitrine.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT vitrine_development)

# Whatever is installed holds the licences; a program or a shared library alone, too.
set(components vitrine_development)
if(VT_SHARED)
  list(APPEND components vitrine_runtime)
endif()
if(VT_PROGRAM)
  list(APPEND components vitrine_program)
  install(TARGETS vitrine RUNTIME COMPONENT vitrine_program)
endif()
set(document_dir ${CMAKE_INSTALL_DATADIR}/doc/vitrine)
foreach(component IN LISTS components)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${notices} DESTINATION ${document_dir} COMPONENT ${component})
endforeach()
file(GLOB documents CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/*.c)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${document_dir} COMPONENT vitrine_development)
install(FILES ${documents} DESTINATION ${document_dir}/docs COMPONENT vitrine_development)

if(NOT PROJECT_IS_TOP_LEVEL)
  return() # packages are the outer project's
endif()
set(CPACK_GENERATOR TGZ)
find_program(VT_DPKG_SHLIBDEPS dpkg-shlibdeps)
if(VT_DPKG_SHLIBDEPS)
  list(APPEND CPACK_GENERATOR DEB)
endif()
set(CPACK_PACKAGE_CONTACT "The Vitrine authors")
set(CPACK_PACKAGE_DESCRIPTION "A program that draws meshes, scenes and reliefs in glass, and the library it is made of.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # the program's shared libraries are packages it depends on
include(CPack)
