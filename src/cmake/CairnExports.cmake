# cairn_export_only(TARGET MAP SYMBOLS): the shared library TARGET exports its C functions and nothing else.
#   MAP      version script, for linkers of ELF files: exports by pattern, and gives each symbol its version
#   SYMBOLS  committed list of the exported symbols, NAME@@VERSION a line; Apple's linker has neither versions nor an
#            option for version scripts, and exports the names of a list
# A DLL needs neither: it exports what the headers mark with CAIRN_API.
function(cairn_export_only target map symbols)
  if(WIN32)
    return()
  endif()
  if(APPLE)
    set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}.exports)
    cairn_write_exports(${symbols} ${list})
    target_link_options(${target} PRIVATE -Wl,-exported_symbols_list,${list})
  else()
    set(list ${map})
    target_link_options(${target} PRIVATE -Wl,--version-script=${map} -Wl,--no-undefined)
  endif()
  set_target_properties(${target} PROPERTIES LINK_DEPENDS ${list})
endfunction()

# Writes the names of SYMBOLS as Apple's linker wants them: with the underscore that its C compiler puts before each.
function(cairn_write_exports symbols list)
  file(STRINGS ${symbols} lines REGEX "^cairn_")
  list(TRANSFORM lines REPLACE "@.*" "")
  list(TRANSFORM lines PREPEND "_")
  list(JOIN lines "\n" text)
  file(WRITE ${list} "${text}\n")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${symbols})
endfunction()
