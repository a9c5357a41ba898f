# SPDX-License-Identifier: Apache-2.0
# Tests of the package: the consumer project against this build folder, found by find_package, and
# against an installation below it, found by find_package and by pkg-config. Static libraries, and
# builds inside of other projects, are for scripts/guest_check.sh.

set(consumer_dir ${CMAKE_CURRENT_BINARY_DIR}/consumer)
set(prefix ${consumer_dir}/prefix)

# Builds and runs the consumer project with the package that OPTION names.
function(sobb_add_consumer_test name option)
  add_test(NAME consumer.${name} COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer_dir}/${name}
    --build-generator ${CMAKE_GENERATOR}
    --build-options ${option} -DCMAKE_C_COMPILER=${CMAKE_C_COMPILER}
    --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure --no-tests=error)
endfunction()

sobb_add_consumer_test(build_tree -Dsobb_DIR=${PROJECT_BINARY_DIR})
sobb_add_consumer_test(find_package -DCMAKE_PREFIX_PATH=${prefix})
add_test(NAME consumer.install COMMAND ${CMAKE_COMMAND}
  --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
set(static)
if(NOT BUILD_SHARED_LIBS)
  set(static --static)
endif()
add_test(NAME consumer.pkg_config COMMAND
  ${CMAKE_CURRENT_SOURCE_DIR}/consumer/pkg_config.sh ${CMAKE_C_COMPILER}
  ${prefix}/${CMAKE_INSTALL_LIBDIR} ${consumer_dir}/pkg_config ${static})
set_tests_properties(consumer.install PROPERTIES FIXTURES_SETUP consumer TIMEOUT 900)
set_tests_properties(consumer.find_package consumer.pkg_config PROPERTIES FIXTURES_REQUIRED consumer)

if(BUILD_SHARED_LIBS)
  add_test(NAME consumer.installed COMMAND
    ${CMAKE_CURRENT_SOURCE_DIR}/consumer/installed.sh ${CMAKE_C_COMPILER}
    ${prefix} ${CMAKE_INSTALL_LIBDIR} ${consumer_dir}/installed
    $<TARGET_NAME_IF_EXISTS:sobb_bench> $<TARGET_NAME_IF_EXISTS:sobb_bench_volumes>
    COMMAND_EXPAND_LISTS)
  set_tests_properties(consumer.installed PROPERTIES FIXTURES_REQUIRED consumer)
endif()
