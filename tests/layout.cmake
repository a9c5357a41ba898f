# SPDX-License-Identifier: Apache-2.0
# Fails unless lib keeps to its layout (docs/architecture.md): few files side by side, short files,
# and includes that go one way. Prints each breach.
# usage: cmake -D LIB=... -P layout.cmake

cmake_minimum_required(VERSION 3.25)

set(most_files 15) # of a folder
set(most_lines 300) # of a file; tables of data, *.inc, may be longer

# A stage of lib includes itself and the stages before it. The importers stand beside the others:
# they include lib/base alone, and nothing includes them.
set(stages base bounds format builder trace query)
set(importers scene)
# A room of lib/trace includes itself, the rooms before it, and trace.h, which has what they share.
set(rooms ray nodes triangles single wave batch packet schedule)

set(breaches 0)
macro(breach text)
  message("${text}")
  math(EXPR breaches "${breaches} + 1")
endmacro()

# Sets `out` to YES where `from` stands before `to` in the list named `order`, or is not in it.
function(is_out_of_order order from to out)
  list(FIND ${order} "${from}" from_index)
  list(FIND ${order} "${to}" to_index)
  set(result NO)
  if(to_index GREATER from_index OR to_index EQUAL -1)
    set(result YES)
  endif()
  set(${out} ${result} PARENT_SCOPE)
endfunction()

function(count_lines file out)
  file(READ ${file} text)
  string(REGEX REPLACE "[^\n]" "" ends "${text}")
  string(LENGTH "${ends}" lines)
  set(${out} ${lines} PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE files RELATIVE ${LIB} ${LIB}/*)
list(FILTER files EXCLUDE REGEX "^third_party/") # laid out by others
list(LENGTH files file_count)
if(file_count EQUAL 0)
  message(FATAL_ERROR "no files in LIB, \"${LIB}\"")
endif()

set(folders)
foreach(file IN LISTS files)
  get_filename_component(folder "${file}" DIRECTORY)
  list(APPEND folders "${folder}")
endforeach()
list(REMOVE_DUPLICATES folders)
foreach(folder IN LISTS folders)
  file(GLOB inside LIST_DIRECTORIES false ${LIB}/${folder}/*)
  list(LENGTH inside count)
  if(count GREATER most_files)
    breach("lib/${folder}: ${count} files, more than ${most_files}")
  endif()
endforeach()

foreach(file IN LISTS files)
  if(file MATCHES "\\.inc$")
    continue()
  endif()
  count_lines(${LIB}/${file} lines)
  if(lines GREATER most_lines)
    breach("lib/${file}: ${lines} lines, more than ${most_lines}")
  endif()

  string(REGEX MATCH "^[^/]+" stage "${file}")
  string(REGEX MATCH "^trace/([^/]+)/" _ "${file}")
  set(room "${CMAKE_MATCH_1}")
  file(STRINGS ${LIB}/${file} includes REGEX "^ *# *include \"")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "^[^\"]*\"([^\"]*)\".*" "\\1" path "${include}")
    string(REGEX MATCH "^[^/]+" included "${path}")
    if(included STREQUAL "sobb" OR included STREQUAL stage)
      set(wrong NO) # the public headers, or the stage itself
    elseif(stage IN_LIST importers)
      is_out_of_order(stages base ${included} wrong)
    elseif(stage IN_LIST stages)
      is_out_of_order(stages ${stage} ${included} wrong)
    else()
      continue() # lib/CMakeLists.txt
    endif()
    if(wrong)
      breach("lib/${file}: includes ${path}, which lib/${stage} may not know")
    endif()

    if(room AND path MATCHES "^trace/([^/]+)/")
      is_out_of_order(rooms ${room} ${CMAKE_MATCH_1} wrong)
    elseif(room AND included STREQUAL "trace" AND NOT path STREQUAL "trace/trace.h")
      set(wrong YES)
    else()
      set(wrong NO)
    endif()
    if(wrong)
      breach("lib/${file}: includes ${path}, which lib/trace/${room} may not know")
    endif()
  endforeach()
  if(room AND NOT room IN_LIST rooms)
    breach("lib/${file}: lib/trace/${room} has no place in the order of rooms")
  endif()
  if(file MATCHES "/" AND NOT stage IN_LIST stages AND NOT stage IN_LIST importers)
    breach("lib/${file}: lib/${stage} has no place in the order of stages")
  endif()
endforeach()

if(breaches GREATER 0)
  message(FATAL_ERROR "lib breaks its layout in ${breaches} places")
endif()
message("lib keeps to its layout in ${file_count} files")
