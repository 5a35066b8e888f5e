# The files that `cmake --install` installs. There are three components for packagers: runtime (the libraries),
# development (headers, pkg-config, CMake package) and program.
include(CMakePackageConfigHelpers)

install(TARGETS cairn cairn_sim EXPORT cairnTargets
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime # a DLL, and next line its import library
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/cairn DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/bindings/cpp/include/cairn DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT development FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/src/api/api.json DESTINATION ${CMAKE_INSTALL_DATADIR}/cairn COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)

if(CAIRN_STATIC)
  install(TARGETS cairn_static cairn_sim_static EXPORT cairnTargets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
endif()

# The loader looks here first if the machine supports it. The linker never does, but a program may open libcairn.so by
# that name at run time: without a link of this name here it would get the slower build.
if(TARGET cairn_v3)
  install(TARGETS cairn_v3 LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/glibc-hwcaps/x86-64-v3 COMPONENT runtime
          NAMELINK_COMPONENT development)
endif()

# The relative path from a directory under the prefix back to the prefix, so that the installed tree can be moved as a
# whole.
function(cairn_path_between from to result)
  file(RELATIVE_PATH path "${from}" "${to}")
  string(REGEX REPLACE "/$" "" path "${path}")
  set(${result} "${path}" PARENT_SCOPE)
endfunction()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cairn)
install(EXPORT cairnTargets NAMESPACE cairn:: DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/cairnConfig.cmake.in ${PROJECT_BINARY_DIR}/cairnConfig.cmake
                              INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
configure_file(${CMAKE_CURRENT_LIST_DIR}/cairnConfigVersion.cmake.in ${PROJECT_BINARY_DIR}/cairnConfigVersion.cmake @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/cairnConfig.cmake ${PROJECT_BINARY_DIR}/cairnConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT development)

set(pkgconfig_dir ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig)
cairn_path_between(${pkgconfig_dir} ${CMAKE_INSTALL_PREFIX} CAIRN_PC_PREFIX)
cairn_path_between(${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR} CAIRN_PC_INCLUDEDIR)
cairn_path_between(${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR} CAIRN_PC_LIBDIR)
set(CAIRN_PC_LIBS_PRIVATE ${CAIRN_RUNTIME_LIBRARIES})
list(TRANSFORM CAIRN_PC_LIBS_PRIVATE PREPEND -l)
list(JOIN CAIRN_PC_LIBS_PRIVATE " " CAIRN_PC_LIBS_PRIVATE)
foreach(name IN ITEMS cairn cairn-sim)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endforeach()

if(TARGET cairn_program)
  cairn_path_between(${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR} path)
  if(APPLE)
    set(here @loader_path)
  else()
    set(here $ORIGIN)
  endif()
  set_target_properties(cairn_program PROPERTIES INSTALL_RPATH "${here}/${path}")
  install(TARGETS cairn_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  if(EXISTS ${PROJECT_SOURCE_DIR}/docs/cairn.1)
    install(FILES ${PROJECT_SOURCE_DIR}/docs/cairn.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  endif()
endif()
