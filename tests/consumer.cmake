# SPDX-License-Identifier: Apache-2.0
# Tests of the package: the consumer project against the build folder, and against installations
# below it, found by find_package and by pkg-config: of this build, and of one with static libraries.
# Builds inside of other projects are in scripts/guest_check.sh.

set(consumer_dir ${CMAKE_CURRENT_BINARY_DIR}/consumer)

# Tests the installation in PREFIX, which the test consumer.NAME.install makes. Further arguments
# go to pkg-config.
function(sobb_add_consumer_tests name prefix)
  add_test(NAME consumer.${name}.find_package COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer_dir}/${name}
    --build-generator ${CMAKE_GENERATOR}
    --build-options -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_C_COMPILER=${CMAKE_C_COMPILER}
    --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure --no-tests=error)
  add_test(NAME consumer.${name}.pkg_config COMMAND
    ${CMAKE_CURRENT_SOURCE_DIR}/consumer/pkg_config.sh ${CMAKE_C_COMPILER}
    ${prefix}/${CMAKE_INSTALL_LIBDIR} ${consumer_dir}/${name}_pkg_config ${ARGN})
  set_tests_properties(consumer.${name}.install PROPERTIES
    FIXTURES_SETUP consumer_${name} TIMEOUT 900)
  set_tests_properties(consumer.${name}.find_package consumer.${name}.pkg_config PROPERTIES
    FIXTURES_REQUIRED consumer_${name})
endfunction()

# Tests the build folder BUILD as a package.
function(sobb_add_build_tree_test name build)
  add_test(NAME consumer.${name}.build_tree COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${consumer_dir}/${name}_build_tree
    --build-generator ${CMAKE_GENERATOR}
    --build-options -Dsobb_DIR=${build} -DCMAKE_C_COMPILER=${CMAKE_C_COMPILER}
    --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure --no-tests=error)
endfunction()

if(BUILD_SHARED_LIBS)
  add_test(NAME consumer.shared.install COMMAND ${CMAKE_COMMAND}
    --install ${PROJECT_BINARY_DIR} --prefix ${consumer_dir}/shared_prefix)
  sobb_add_consumer_tests(shared ${consumer_dir}/shared_prefix)
  sobb_add_build_tree_test(shared ${PROJECT_BINARY_DIR})
endif()

# Compiled as this build is, so that a compiler cache has the objects. In two steps: a process that
# has configured leaves another locale to what it starts, and the cache counts that.
add_test(NAME consumer.static.configure COMMAND ${CMAKE_COMMAND}
  -S ${PROJECT_SOURCE_DIR} -B ${consumer_dir}/static_build -G ${CMAKE_GENERATOR}
  -D BUILD_SHARED_LIBS=OFF -D CMAKE_INSTALL_PREFIX=${consumer_dir}/static_prefix
  -D CMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -D SOBB_WERROR=${SOBB_WERROR}
  -D CMAKE_C_COMPILER=${CMAKE_C_COMPILER} -D CMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
  -D CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
  -D SOBB_BUILD_TESTS=OFF -D SOBB_BUILD_BENCH=OFF -D SOBB_BUILD_EXAMPLES=OFF)
add_test(NAME consumer.static.install COMMAND ${CMAKE_COMMAND}
  --build ${consumer_dir}/static_build --target install)
set_tests_properties(consumer.static.configure PROPERTIES
  FIXTURES_SETUP consumer_static_configured)
set_tests_properties(consumer.static.install PROPERTIES
  FIXTURES_REQUIRED consumer_static_configured)
sobb_add_consumer_tests(static ${consumer_dir}/static_prefix --static)
sobb_add_build_tree_test(static ${consumer_dir}/static_build)
set_tests_properties(consumer.static.build_tree PROPERTIES FIXTURES_REQUIRED consumer_static)
