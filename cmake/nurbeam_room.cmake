# nurbeam_room(<name> [PRIVATE <header>...] [EXCEPT <regex>]): the library of one top-level folder, made of every .cpp
# and .h in it and its sub-folders (main.cpp, and what the regex matches, apart). Includes go from the root
# ("nurbs/knot_vector.h"). Each public header must compile alone: one beside a source file, which begins with it
# (the architecture test sees to that), does so there, the others in target all_verify_interface_header_sets; PRIVATE
# headers, which show a library that the room hides, are not installed.
set(nurbeam_warnings -Wall -Wextra -Wno-maybe-uninitialized -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -Wzero-as-null-pointer-constant -Wsuggest-override -Wlogical-op -Wduplicated-cond -Wcatch-value=3)
if(CMAKE_UNITY_BUILD)  # where each source is included by another file
  list(APPEND nurbeam_warnings -Wno-subobject-linkage)
endif()

# With CMAKE_UNITY_BUILD (preset release) the sources of a folder are compiled as one: the headers of the libraries,
# which take most of the time, are read once for all.
function(nurbeam_compile_by_folder target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS ARGN)
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER ${folder} group)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

function(nurbeam_room name)
  cmake_parse_arguments(PARSE_ARGV 1 room "" EXCEPT PRIVATE)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  if(room_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "${room_EXCEPT}")
    list(FILTER headers EXCLUDE REGEX "${room_EXCEPT}")
  endif()
  list(TRANSFORM room_PRIVATE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  if(room_PRIVATE)
    list(REMOVE_ITEM headers ${room_PRIVATE})
  endif()
  add_library(nurbeam_${name} STATIC ${sources})
  nurbeam_compile_by_folder(nurbeam_${name} ${sources})
  add_library(nurbeam::${name} ALIAS nurbeam_${name})
  set_target_properties(nurbeam_${name} PROPERTIES EXPORT_NAME ${name} VERIFY_INTERFACE_HEADER_SETS ON
    INTERFACE_HEADER_SETS_TO_VERIFY headers_alone)
  target_compile_features(nurbeam_${name} PUBLIC cxx_std_20)
  target_compile_options(nurbeam_${name} PRIVATE ${nurbeam_warnings})
  set(beside_source ${headers})
  foreach(header IN LISTS headers)
    string(REGEX REPLACE "\\.h$" ".cpp" source ${header})
    if(source IN_LIST sources)
      list(REMOVE_ITEM headers ${header})
    else()
      list(REMOVE_ITEM beside_source ${header})
    endif()
  endforeach()
  target_sources(nurbeam_${name} PUBLIC
    FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${beside_source}
    FILE_SET headers_alone TYPE HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
  install(TARGETS nurbeam_${name} EXPORT nurbeam-${name}-targets COMPONENT dev
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nurbeam
    FILE_SET headers_alone DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nurbeam)
  install(EXPORT nurbeam-${name}-targets NAMESPACE nurbeam:: COMPONENT dev
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/nurbeam)
endfunction()
