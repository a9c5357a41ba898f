# SPDX-License-Identifier: Apache-2.0
# Fails unless a shared library loads the libraries in LOADS, those of the C and C++ run times, and no
# others, and is at most MOST_BYTES long once it is stripped.
# usage: cmake -D READELF=... -D STRIP=... -D LIBRARY=... -D LOADS=... -D MOST_BYTES=... -P loads.cmake

cmake_minimum_required(VERSION 3.25)

set(run_times stdc++ m gcc_s c pthread dl ld-linux-x86-64)
execute_process(COMMAND ${READELF} -d ${LIBRARY}
  OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\\(NEEDED\\)[^\n]*\\[[^]]*\\]" lines "${dynamic}")
set(loaded)
foreach(line IN LISTS lines)
  string(REGEX REPLACE ".*\\[(lib)?([^]]*)\\.so.*" "\\2" name "${line}")
  list(APPEND loaded ${name})
endforeach()
if(NOT c IN_LIST loaded)
  message(FATAL_ERROR "${LIBRARY}: what it loads cannot be read:\n${dynamic}")
endif()
foreach(name IN LISTS loaded)
  if(NOT name IN_LIST LOADS AND NOT name IN_LIST run_times)
    message(FATAL_ERROR "${LIBRARY} loads ${name}")
  endif()
endforeach()
foreach(name IN LISTS LOADS)
  if(NOT name IN_LIST loaded)
    message(FATAL_ERROR "${LIBRARY} does not load ${name}")
  endif()
endforeach()

set(stripped ${CMAKE_CURRENT_BINARY_DIR}/stripped.so)
execute_process(COMMAND ${STRIP} -o ${stripped} ${LIBRARY} COMMAND_ERROR_IS_FATAL ANY)
file(SIZE ${stripped} bytes)
file(REMOVE ${stripped})
if(bytes GREATER MOST_BYTES)
  message(FATAL_ERROR "${LIBRARY} has ${bytes} bytes, more than ${MOST_BYTES}")
endif()
list(JOIN loaded ", " loaded)
message("${LIBRARY} loads ${loaded}; ${bytes} bytes stripped")
