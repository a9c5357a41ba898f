# SPDX-License-Identifier: Apache-2.0
# Installation: libraries, headers, the CMake package `sobb` (components core and scene) and the
# pkg-config modules sobb and sobb_scene. The build folder is such a package, too: find_package
# finds it where CMAKE_PREFIX_PATH or sobb_DIR names it.

include(CMakePackageConfigHelpers)

set(sobb_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/sobb)
set(sobb_libraries sobb)
install(FILES capi/include/sobb/sobb.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sobb)
if(SOBB_BUILD_SCENE)
  list(APPEND sobb_libraries sobb_scene)
  install(FILES capi/include/sobb/scene.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sobb)
endif()

install(TARGETS ${sobb_libraries} EXPORT sobbTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT sobbTargets NAMESPACE sobb:: DESTINATION ${sobb_package_dir})
export(EXPORT sobbTargets NAMESPACE sobb:: FILE ${PROJECT_BINARY_DIR}/sobbTargets.cmake)

configure_package_config_file(cmake/sobbConfig.cmake.in ${PROJECT_BINARY_DIR}/sobbConfig.cmake
  INSTALL_DESTINATION ${sobb_package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the API, so only patch versions are compatible.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sobbConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sobbConfig.cmake ${PROJECT_BINARY_DIR}/sobbConfigVersion.cmake
  DESTINATION ${sobb_package_dir})

# The modules find their prefix from where they lie, so that an installation can be moved. What the
# libraries need stands in Libs.private, for `pkg-config --static` only: Requires.private would ask
# for the development files of every dependency even where the libraries are shared.
set(sobb_pc_dir ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH sobb_prefix_from_pc ${sobb_pc_dir} ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH sobb_include_from_pc ${sobb_pc_dir} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
set(sobb_pc_tbb)
if(SOBB_WITH_TBB)
  set(sobb_pc_tbb -ltbb)
endif()
list(TRANSFORM SOBB_DECODERS PREPEND "-l" OUTPUT_VARIABLE sobb_decoder_flags)
list(JOIN sobb_decoder_flags " " sobb_decoder_flags)
foreach(library IN LISTS sobb_libraries)
  configure_file(cmake/${library}.pc.in ${library}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${library}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

# Headers and documents name each other as they lie in the sources, so they lie so here as well.
set(sobb_doc_dir ${CMAKE_INSTALL_DATAROOTDIR}/doc/sobb)
install(FILES README.md CHANGELOG.md SECURITY.md LICENSE THIRD_PARTY_NOTICES.md
  DESTINATION ${sobb_doc_dir})
install(DIRECTORY docs DESTINATION ${sobb_doc_dir} PATTERN data EXCLUDE)
install(DIRECTORY capi/examples DESTINATION ${sobb_doc_dir}/capi FILES_MATCHING PATTERN "*.c")

# The Python package looks for programs in bin beside the folder of the libraries.
set(sobb_programs)
foreach(program IN ITEMS sobb_bench sobb_bench_volumes)
  if(TARGET ${program})
    list(APPEND sobb_programs ${program})
  endif()
endforeach()
if(sobb_programs)
  file(RELATIVE_PATH sobb_lib_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(${sobb_programs} PROPERTIES INSTALL_RPATH "$ORIGIN/${sobb_lib_from_bin}")
  install(TARGETS ${sobb_programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # sobb_bench loads it from where the libraries lie.
  if(TARGET sobb_bench_embree)
    install(TARGETS sobb_bench_embree LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  endif()
endif()
