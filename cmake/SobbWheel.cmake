# SPDX-License-Identifier: Apache-2.0
# The Python package (python/pyproject.toml) carries two folders below sobb/native: lib has the
# libraries and all that they load, bin has the programs. scikit-build-core's runs of CMake include
# this file.

set(wheel_libraries sobb sobb_scene)
set(wheel_programs sobb_bench sobb_bench_volumes)

# A wheel holds no symbolic links: each library is one file, named as programs ask for it.
set_target_properties(${wheel_libraries} PROPERTIES VERSION ${SOBB_ABI_VERSION})
set_target_properties(${wheel_programs} PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
# The old kind of run path holds also for what a library loads in turn: what lies in the wheel finds
# the rest beside itself though nothing in it says so.
foreach(target IN LISTS wheel_libraries wheel_programs)
  target_link_options(${target} PRIVATE -Wl,--disable-new-dtags)
endforeach()

install(TARGETS ${wheel_libraries} LIBRARY DESTINATION lib NAMELINK_SKIP COMPONENT wheel)
install(TARGETS ${wheel_programs} RUNTIME DESTINATION bin COMPONENT wheel)

# The module that calls Embree comes without Embree: sobb_bench says where that is not installed.
if(TARGET sobb_bench_embree)
  set_target_properties(sobb_bench_embree PROPERTIES INSTALL_RPATH "$ORIGIN")
  install(TARGETS sobb_bench_embree LIBRARY DESTINATION lib COMPONENT wheel)
endif()

# The wheel carries what the files load, but takes the C and C++ run time from the system.
install(CODE [[
  file(GET_RUNTIME_DEPENDENCIES
    RESOLVED_DEPENDENCIES_VAR loaded
    LIBRARIES $<TARGET_FILE:sobb> $<TARGET_FILE:sobb_scene>
    EXECUTABLES $<TARGET_FILE:sobb_bench> $<TARGET_FILE:sobb_bench_volumes>
    PRE_EXCLUDE_REGEXES "^libsobb" "^ld-linux" "^lib(c|m|dl|rt|pthread|gcc_s|stdc\\+\\+)\\.so")
  foreach(library IN LISTS loaded)
    get_filename_component(name "${library}" NAME)
    file(REAL_PATH "${library}" file)
    file(COPY_FILE "${file}" "${CMAKE_INSTALL_PREFIX}/lib/${name}")
  endforeach()
]] COMPONENT wheel)

# The package names the commit that it was made from, for what is measured with it. Without a
# checkout it names none.
find_package(Git QUIET)
if(Git_FOUND AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --abbrev=40 --dirty=+ --exclude=*
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_FILE ${PROJECT_BINARY_DIR}/commit ERROR_QUIET)
  install(FILES ${PROJECT_BINARY_DIR}/commit DESTINATION . COMPONENT wheel)
endif()
