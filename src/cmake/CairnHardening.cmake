# Compiler and linker flags that make errors of memory harder to exploit: the set that Debian builds its packages with,
# and on x86 indirect branch tracking and a shadow stack (CET). tests/install/hardening_test.sh looks for them in the
# built libraries. docs/building.md tells what they cost.
include(CheckCXXCompilerFlag)
include(CheckLinkerFlag)

# Other systems have other means. A sanitizer brings its own checks, and its runtime does not go with fortify.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT CAIRN_SANITIZE)
  set(hardening_default ON)
else()
  set(hardening_default OFF)
endif()
option(CAIRN_HARDENING "Stack protector, checked libc calls, read-only relocations, CET" ${hardening_default})
if(NOT CAIRN_HARDENING)
  return()
endif()

function(cairn_compile_flag_if_known name flag)
  set(CMAKE_REQUIRED_FLAGS -Werror)  # clang only warns of a flag that it does not use
  check_cxx_compiler_flag(${flag} ${name})
  if(${name})
    add_compile_options(${flag})
  endif()
endfunction()

cairn_compile_flag_if_known(CAIRN_HAS_STACK_PROTECTOR -fstack-protector-strong)
# x86: every target of an indirect branch is marked. Compilers for other processors refuse the flag.
cairn_compile_flag_if_known(CAIRN_HAS_CF_PROTECTION -fcf-protection=full)
# aarch64: the same there.
cairn_compile_flag_if_known(CAIRN_HAS_BRANCH_PROTECTION -mbranch-protection=standard)

# libc's headers can check sizes only in optimised code, and warn without. Some distributions define the macro already.
add_compile_options($<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE> $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=2>)

check_linker_flag(CXX "-Wl,-z,relro,-z,now,-z,noexecstack" CAIRN_HAS_RELRO)
if(CAIRN_HAS_RELRO)
  add_link_options(-Wl,-z,relro,-z,now,-z,noexecstack)
endif()

# The linker marks a library as ready for CET only if every object is. The start files of some distributions (crti.o of
# Debian 12) are not: their _init and _fini do not begin with a mark. These two do nothing in a library that has its
# constructors in .init_array. An entry point that does not exist leaves them out of the dynamic section, so nothing
# branches to them, and then the library may say that it is ready.
if(CAIRN_HAS_CF_PROTECTION)
  check_linker_flag(CXX "-Wl,-z,ibt,-z,shstk" CAIRN_HAS_CET_LINKER)
  if(CAIRN_HAS_CET_LINKER)
    string(APPEND CMAKE_SHARED_LINKER_FLAGS " -Wl,-z,ibt,-z,shstk,-init=cairn_no_init,-fini=cairn_no_fini")
  endif()
endif()
