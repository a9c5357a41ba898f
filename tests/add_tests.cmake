# SPDX-License-Identifier: Apache-2.0
# sobb_add_tests makes a program of a folder of GoogleTest files, and decides how ctest runs it: by
# the test case in a release build, in fewer processes and less of it under the sanitizers.

find_package(GTest CONFIG REQUIRED)
include(GoogleTest)

set(thread_sanitizer NO)
if(SOBB_SANITIZE MATCHES thread)
  set(thread_sanitizer YES)
endif()

# sobb_add_tests(AREA [SHARDS N] [THREADS] LIBRARIES...)
#
# AREA/*.cpp make the program test_AREA, and each test case is one ctest. Under a sanitizer a process
# takes longer to start than most test cases to run: there an area with SHARDS is N ctests, each of
# every Nth test case.
#
# ThreadSanitizer's build has what uses threads: all of an area that is marked THREADS, and of the
# others the test cases with Thread in their names.
function(sobb_add_tests area)
  cmake_parse_arguments(PARSE_ARGV 1 arg "THREADS" "SHARDS" "")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${area}/*.cpp)
  if(thread_sanitizer AND NOT arg_THREADS)
    sobb_keep_thread_tests(sources)
  endif()
  if(NOT sources)
    return()
  endif()
  add_executable(test_${area} ${sources})
  target_compile_definitions(test_${area} PRIVATE SOBB_TEST_DATA="${CMAKE_CURRENT_SOURCE_DIR}/data")
  # A test's time is the library's, whose objects have their own flags: this saves a quarter of the
  # compiler's time.
  target_compile_options(test_${area} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_link_libraries(test_${area} PRIVATE
    ${arg_UNPARSED_ARGUMENTS} sobb_test_support GTest::gtest GTest::gtest_main)
  if(thread_sanitizer AND NOT arg_THREADS)
    add_test(NAME ${area}.threads COMMAND test_${area} --gtest_filter=*Thread*)
  elseif(SOBB_SANITIZE AND arg_SHARDS)
    sobb_add_shards(${area} ${arg_SHARDS})
  else()
    gtest_discover_tests(test_${area} TEST_PREFIX ${area}. NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60)
  endif()
endfunction()

function(sobb_add_shards area count)
  math(EXPR last "${count} - 1")
  foreach(shard RANGE ${last})
    add_test(NAME ${area}.shard${shard} COMMAND test_${area})
    # Areas of many shards start first, so that no long one is left to run alone at the end.
    set_tests_properties(${area}.shard${shard} PROPERTIES COST ${count}
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${count};GTEST_SHARD_INDEX=${shard}")
  endforeach()
endfunction()

# Leaves in the list named `list` those test_*.cpp that have a test case with Thread in its name,
# and the files that help them; nothing where there is no such test case.
function(sobb_keep_thread_tests list)
  set(kept)
  set(helpers)
  foreach(source IN LISTS ${list})
    if(NOT source MATCHES "/test_[^/]*$")
      list(APPEND helpers ${source})
      continue()
    endif()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(STRINGS ${source} found REGEX "^TEST(_F|_P)?\\(.*Thread")
    if(found)
      list(APPEND kept ${source})
    endif()
  endforeach()
  if(kept)
    list(APPEND kept ${helpers})
  endif()
  set(${list} ${kept} PARENT_SCOPE)
endfunction()
