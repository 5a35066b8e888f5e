# Static libraries. All objects become one, in which only the C functions are global: C++ names of the library and its
# instances of Eigen's and the standard library's templates can't clash with those of the caller, who may compile with
# other flags. Sections that linkers fold by their name (COMDAT groups) become plain ones, because the linker would
# otherwise replace a function of the library by the caller's of the same name.
include(CheckLinkerFlag)
check_linker_flag(CXX "-Wl,--force-group-allocation" CAIRN_LINKER_FLATTENS_GROUPS)
if(NOT CAIRN_LINKER_FLATTENS_GROUPS OR NOT CMAKE_OBJCOPY)
  message(FATAL_ERROR "CAIRN_STATIC needs the linker and objcopy of GNU binutils: set CAIRN_STATIC=OFF, or use them")
endif()

# cairn_add_static(NAME OUTPUT EXPORT PATTERN OBJECTS...): the target NAME is libOUTPUT.a, found by others as
# cairn::EXPORT, with the global symbols of the wildcard patterns (a list) only.
function(cairn_add_static name output export patterns)
  set(object ${CMAKE_CURRENT_BINARY_DIR}/${name}.o)
  set(inputs)
  foreach(objects IN LISTS ARGN)
    # A precompiled header counts as an object of its target.
    list(APPEND inputs $<FILTER:$<TARGET_OBJECTS:${objects}>,EXCLUDE,[.][gp]ch$>)
  endforeach()
  list(TRANSFORM patterns PREPEND --keep-global-symbol=)
  add_custom_command(OUTPUT ${object}
    COMMAND ${CMAKE_CXX_COMPILER} -r -nostdlib -Wl,--force-group-allocation -o ${object} ${inputs}
    # GCC's unique symbols (static data of templates and of inline functions) become local only after they have become
    # weak. No symbol of the C++ runtime may match: where it is weak, the linker does not look for it.
    COMMAND ${CMAKE_OBJCOPY} --wildcard --weaken-symbol=_ZN5cairn* --weaken-symbol=_ZN5Eigen*
            --weaken-symbol=_ZN9nanoflann* --weaken-symbol=_ZZ* --weaken-symbol=_ZGVZ* ${object}
    COMMAND ${CMAKE_OBJCOPY} --wildcard ${patterns} ${object}
    DEPENDS ${inputs} COMMAND_EXPAND_LISTS VERBATIM COMMENT "One object for lib${output}.a")
  add_library(${name} STATIC ${object})
  set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  target_include_directories(${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                               $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_definitions(${name} INTERFACE CAIRN_STATIC)  # the headers must not say that a DLL is imported
  target_link_libraries(${name} INTERFACE ${CAIRN_RUNTIME_LIBRARIES})
  set_target_properties(${name} PROPERTIES OUTPUT_NAME ${output} EXPORT_NAME ${export} LINKER_LANGUAGE CXX
                        ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
endfunction()
