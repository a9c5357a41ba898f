# SPDX-License-Identifier: Apache-2.0
# Proves that a subproject changes nothing of its parent: parent_remember() before it is added,
# parent_compare() after it. They look at variables, the cache, policies, languages, and properties
# of the folder.

# New variables of these names are the subproject's own, or what finds its dependencies.
set(parent_allowed "^(SOBB_|sobb_|FETCHCONTENT_|FIND_PACKAGE_MESSAGE_DETAILS_|TBB|hwy_)")
# CMake itself changes these wherever a folder is added or a package is found.
set(parent_volatile "^(ARG[CNV0-9]*|CMAKE_CURRENT_LIST_LINE|CMAKE_MATCH_.*|parent_.*|OUTPUT_VARIABLE|_.*)$")

set(parent_properties COMPILE_DEFINITIONS COMPILE_OPTIONS INCLUDE_DIRECTORIES LINK_DIRECTORIES
  LINK_LIBRARIES LINK_OPTIONS TESTS)

# Calls `visit(kind name value)` for all that is compared.
macro(parent_visit visit)
  get_cmake_property(parent_variables VARIABLES)
  foreach(parent_name IN LISTS parent_variables)
    if(NOT parent_name MATCHES "${parent_volatile}")
      cmake_language(CALL ${visit} variable "${parent_name}" "${${parent_name}}")
    endif()
  endforeach()
  get_cmake_property(parent_variables CACHE_VARIABLES)
  foreach(parent_name IN LISTS parent_variables)
    cmake_language(CALL ${visit} cache "${parent_name}" "$CACHE{${parent_name}}")
  endforeach()
  foreach(parent_number RANGE 48 117) # those of CMake 3.16 to 3.25 that a project may set
    string(REGEX REPLACE "^.*(....)$" "CMP\\1" parent_name 000${parent_number})
    cmake_policy(GET ${parent_name} parent_value)
    cmake_language(CALL ${visit} policy ${parent_name} "${parent_value}")
  endforeach()
  get_cmake_property(parent_value ENABLED_LANGUAGES)
  cmake_language(CALL ${visit} global ENABLED_LANGUAGES "${parent_value}")
  foreach(parent_name IN LISTS parent_properties)
    get_directory_property(parent_value ${parent_name})
    cmake_language(CALL ${visit} folder ${parent_name} "${parent_value}")
  endforeach()
endmacro()

function(parent_keep kind name value)
  set_property(GLOBAL PROPERTY "parent_${kind}_${name}" "${value}")
endfunction()

function(parent_check kind name value)
  get_property(known GLOBAL PROPERTY "parent_${kind}_${name}" SET)
  get_property(before GLOBAL PROPERTY "parent_${kind}_${name}")
  if(NOT known AND NOT name MATCHES "${parent_allowed}")
    message(SEND_ERROR "The subproject gave its parent the ${kind} ${name}, \"${value}\"")
  elseif(known AND NOT "${before}" STREQUAL "${value}")
    message(SEND_ERROR "The subproject changed its parent's ${kind} ${name} "
      "from \"${before}\" to \"${value}\"")
  endif()
endfunction()

macro(parent_remember)
  parent_visit(parent_keep)
endmacro()

macro(parent_compare)
  parent_visit(parent_check)
endmacro()
