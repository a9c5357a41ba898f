# SPDX-License-Identifier: Apache-2.0
# PROGRAM, sobb_bench_volumes, on a small scene: every row of the eleven methods; exit codes.
# Run by ctest: cmake -D PROGRAM=... -D OUT=... -P bench_volumes.cmake

function(expect_exit code)
  execute_process(COMMAND ${PROGRAM} ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL code)
    message(FATAL_ERROR "${ARGN}: exit ${result}, not ${code}\n${output}")
  endif()
endfunction()

expect_exit(2 --layout=cubic)
expect_exit(2 --strategy=k4)
expect_exit(2 --cell-seconds=0)
expect_exit(2 --isa=mmx)
expect_exit(2 --benchmark_no_such_flag)
expect_exit(2 stray)
expect_exit(1 --scene=missing.glb)
expect_exit(1 --scene=builtin:hairball:1000 --view=99)
expect_exit(0 --scene=builtin:hairball:5000 --size=48 --cell-seconds=0.01
  --benchmark_out=${OUT} --benchmark_out_format=json)

set(rows)
foreach(layout binary wide)
  list(APPEND rows build/${layout})
  foreach(kind overhead primary secondary)
    foreach(method aabb 14-dop obb)
      list(APPEND rows ${kind}/${method}/${layout})
    endforeach()
    foreach(method 32d 32i 48d 48i 64d 64i 128 256)
      list(APPEND rows ${kind}/sobb${method}/${layout}/k2)
    endforeach()
  endforeach()
endforeach()

file(READ ${OUT} report)
foreach(key scene triangles view size threads isa sobb processor primary_rays secondary_rays
    brute_force_rays)
  string(JSON value GET "${report}" context ${key})
endforeach()
if(NOT value EQUAL 200)
  message(FATAL_ERROR "${value} rays were compared with brute force")
endif()

string(REGEX MATCHALL "\"run_name\": \"[^\"]*\"" found "${report}")
list(TRANSFORM found REPLACE "\"run_name\": \"(.*)\"" "\\1")
list(REMOVE_DUPLICATES found)
list(TRANSFORM rows APPEND /manual_time)
list(SORT rows)
list(SORT found)
if(NOT rows STREQUAL found)
  message(FATAL_ERROR "rows: ${found}\nexpected: ${rows}")
endif()
