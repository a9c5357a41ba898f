# SPDX-License-Identifier: Apache-2.0
# Fails unless a shared library exports exactly what its export list names, and that is what its
# header declares, but for names with `_internal_`.
# usage: cmake -D NM=... -D LIBRARY=... -D MAP=... -D HEADER=... -P exports.cmake

file(READ ${MAP} text)
string(REGEX REPLACE "/\\*[^*]*\\*/" "" text "${text}")
string(REGEX MATCHALL "sobb_[a-z0-9_]+" listed "${text}")

file(READ ${HEADER} text)
string(REGEX MATCHALL "SOBB_(SCENE_)?API [a-z0-9_ *]+[ *]sobb_[a-z0-9_]+\\(" declarations "${text}")
set(declared)
foreach(declaration IN LISTS declarations)
  string(REGEX REPLACE ".*[ *](sobb_[a-z0-9_]+)\\($" "\\1" name "${declaration}")
  list(APPEND declared ${name})
endforeach()

execute_process(COMMAND ${NM} --dynamic --defined-only --format=posix ${LIBRARY}
  OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^ \n]+ [A-Za-z] [^\n]*" symbols "${text}")
set(exported)
foreach(symbol IN LISTS symbols)
  string(REGEX REPLACE "[@ ].*" "" name "${symbol}")
  if(NOT symbol MATCHES " A ")  # the version's own name
    list(APPEND exported ${name})
  endif()
endforeach()

set(public ${listed})
list(FILTER public EXCLUDE REGEX _internal_)
foreach(set IN ITEMS listed public declared exported)
  list(SORT ${set})
endforeach()
if(NOT declared)
  message(FATAL_ERROR "${HEADER} declares no function that this test can find")
endif()
if(NOT "${public}" STREQUAL "${declared}")
  message(FATAL_ERROR "listed:   ${public}\ndeclared: ${declared}")
endif()
if(NOT "${listed}" STREQUAL "${exported}")
  message(FATAL_ERROR "listed:   ${listed}\nexported: ${exported}")
endif()
