# Flags that every target of the project is compiled with.

# ccache caches objects with a precompiled header only if this option allows it.
foreach(language IN ITEMS C CXX)
  if(CMAKE_${language}_COMPILER_LAUNCHER MATCHES "ccache$")
    set(CMAKE_${language}_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
        ${CMAKE_${language}_COMPILER_LAUNCHER})
  endif()
endforeach()
set(CMAKE_C_STANDARD 99)
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(MSVC)
  add_compile_options(/W4)
else()
  add_compile_options(-Wall -Wextra -Wshadow $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>)
  set(CAIRN_NO_MATH_ERRNO -fno-math-errno)    # sqrt becomes one instruction
  set(CAIRN_NO_CONTRACTION -ffp-contract=off) # no fused multiply-add: the same bits on all machines
endif()
# Vectors wider than the registers of the target are never part of an ABI here.
add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-Wno-psabi>)
if(CAIRN_DEVELOPER)
  if(MSVC)
    add_compile_options(/WX)
  else()
    add_compile_options(-Werror)
  endif()
endif()

# The source files of a folder become one file for the compiler, which then reads Eigen once for all of them.
function(cairn_unite target)
  if(NOT CAIRN_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "in_${folder}" group)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  cairn_allow_unity(${target})
endfunction()

# In a file that includes others, GCC takes local types of the others for those of a header, and warns.
function(cairn_allow_unity target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

if(CAIRN_SANITIZE)
  add_compile_options(-fsanitize=${CAIRN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # The checks for null, alignment and object size stand at every access to memory. In Eigen's inline functions they are
  # two thirds of what both sanitizers cost the compiler. The address sanitizer finds most of what they find: a read or
  # write through a null pointer or beyond an object. The C sources, which compile quickly, keep them.
  if(NOT CAIRN_SANITIZE_ACCESSES)
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fno-sanitize=null,alignment,object-size>)
  endif()
  # Eigen aligns memory by its own means where it sees the address sanitizer, whose malloc does it as well. Memory that the
  # library allocates may be freed by unit tests, which are compiled without sanitizers: one way for both.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
  add_link_options(-fsanitize=${CAIRN_SANITIZE})
endif()
