# SPDX-License-Identifier: Apache-2.0
# Every target of the project is compiled with the interface library sobb_options.

option(SOBB_WERROR "Treat warnings as errors" OFF)

add_library(sobb_options INTERFACE)
target_compile_features(sobb_options INTERFACE cxx_std_20)
target_include_directories(sobb_options INTERFACE
  ${PROJECT_SOURCE_DIR}/capi/include ${PROJECT_SOURCE_DIR}/capi/src ${PROJECT_SOURCE_DIR}/lib)
target_compile_options(sobb_options INTERFACE
  -Wall -Wextra -Wpedantic
  # Results must not depend on what the compiler fuses.
  -ffp-contract=off
  # GCC 12 warns of std::string's own operator+ (its bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${SOBB_WERROR}>:-Werror>)
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
