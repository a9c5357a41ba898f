# SPDX-License-Identifier: Apache-2.0
# The options that say what is built. A parent project gets the core alone, and asks for the rest.

include(CMakeDependentOption)

option(SOBB_INSTALL "Install the library, and let find_package find the build folder"
  ${PROJECT_IS_TOP_LEVEL})
option(SOBB_BUILD_SCENE "Build the importers, sobb::scene" ${PROJECT_IS_TOP_LEVEL})
option(SOBB_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(SOBB_BUILD_EXAMPLES "Build capi/examples" ${PROJECT_IS_TOP_LEVEL})
option(SOBB_BUILD_FUZZERS "Build the fuzzers; needs clang and -fsanitize=fuzzer-no-link" OFF)
option(SOBB_WITH_TBB "Run loops on TBB; else on threads of the library's own" ON)
set(SOBB_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, e.g. address,undefined")

# An option that needs the option NEEDED, and says so where it was asked for in vain.
macro(sobb_dependent_option name description needed)
  if(${name} AND NOT ${needed})
    message(NOTICE "${name} needs ${needed}, which is off: it is off, too")
  endif()
  cmake_dependent_option(${name} "${description}; needs ${needed}"
    ${PROJECT_IS_TOP_LEVEL} ${needed} OFF)
endmacro()

sobb_dependent_option(SOBB_BUILD_BENCH "Build the benchmark program, sobb_bench" SOBB_BUILD_SCENE)
sobb_dependent_option(SOBB_BUILD_RESEARCH
  "Build the paper's other volumes and the studies" SOBB_BUILD_BENCH)
