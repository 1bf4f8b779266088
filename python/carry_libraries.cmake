# Puts the libraries that the programs and the module of a wheel need beside them, into `folder`/lib below the prefix:
# `programs`, `module`, and `late`, the libraries that are loaded by their names. Those of the compiler and of the C library
# are everywhere.
file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${programs} MODULES "${module}" LIBRARIES ${late}
  RESOLVED_DEPENDENCIES_VAR found UNRESOLVED_DEPENDENCIES_VAR missing
  PRE_EXCLUDE_REGEXES "^lib(c|m|dl|rt|pthread|util|resolv|stdc\\+\\+|gcc_s)[.]so" "^ld-linux")
if(missing)
  message(FATAL_ERROR "not found, and so not carried along: ${missing}")
endif()
file(MAKE_DIRECTORY "${CMAKE_INSTALL_PREFIX}/${folder}/lib")
foreach(library IN LISTS found late)
  cmake_path(GET library FILENAME name)
  set(carried "${CMAKE_INSTALL_PREFIX}/${folder}/lib/${name}")
  file(COPY_FILE "${library}" "${carried}")
  file(RPATH_REMOVE FILE "${carried}")  # one of its own would lead to the libraries of this system
endforeach()
