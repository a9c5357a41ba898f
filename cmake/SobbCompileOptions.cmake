# SPDX-License-Identifier: Apache-2.0
# Every target of the project is compiled with the interface library sobb_options.

# Whether warnings are errors is asked of this project alone: neither what a parent says nor what
# stands in CMAKE_CXX_FLAGS turns a newer compiler's warning into a build that fails.
option(SOBB_WERROR "Treat warnings as errors" OFF)
set(CMAKE_COMPILE_WARNING_AS_ERROR OFF)
# GCC 12 warns of std::string's own operator+ (its bug 105651).
set(warnings -Wall -Wextra -Wpedantic $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(SOBB_WERROR)
  list(APPEND warnings -Werror)
elseif(PROJECT_IS_TOP_LEVEL)
  list(APPEND warnings -Wno-error)
else()
  set(warnings -w) # a parent's -Wconversion is for the parent's code
endif()

add_library(sobb_options INTERFACE)
target_compile_features(sobb_options INTERFACE cxx_std_20)
target_include_directories(sobb_options INTERFACE
  ${PROJECT_SOURCE_DIR}/capi/include ${PROJECT_SOURCE_DIR}/capi/src ${PROJECT_SOURCE_DIR}/lib)
# These stand behind CMAKE_CXX_FLAGS and behind the options of a parent's folder, so they prevail.
target_compile_options(sobb_options INTERFACE
  ${warnings}
  # Results rest on the arithmetic of IEEE 754, and must not depend on what the compiler fuses.
  # lib/base/float_control.h refuses what these do not undo.
  -fno-fast-math
  $<$<CXX_COMPILER_ID:Clang>:-fdenormal-fp-math=ieee>
  -ffp-contract=off
  # Failures travel as exceptions up to the C interface, which lets none pass.
  -fexceptions -frtti)
if(SOBB_SANITIZE)
  target_compile_options(sobb_options INTERFACE
    -fsanitize=${SOBB_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(sobb_options INTERFACE -fsanitize=${SOBB_SANITIZE})
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 99)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# The sources of kernels include themselves once per instruction set, so that no two of them can be
# one unit.
set(CMAKE_UNITY_BUILD OFF)

# What a parent lets run over its own sources is not for those of a guest.
if(NOT PROJECT_IS_TOP_LEVEL)
  foreach(tool IN ITEMS AUTOMOC AUTORCC AUTOUIC
      CXX_CLANG_TIDY CXX_CPPCHECK CXX_CPPLINT CXX_INCLUDE_WHAT_YOU_USE LINK_WHAT_YOU_USE)
    set(CMAKE_${tool} "")
  endforeach()
endif()
