# cmake -DROOT=<source tree> -P includes.cmake: fails on an #include that the drawing of the rooms does not have, and
# on a library's header outside its home.
#
#   cad_import --> nurbs <-- fem --> solver        pipelines --> all of them        python --> pipelines and all of them
#   nothing --> python, tests, samples
#
# Inside a room a folder may include itself and those that stand before it in the room's list; "." is the room itself.
# The sub-folders of fem/motion have a list of their own.

cmake_minimum_required(VERSION 3.25)
set(rooms cad_import fem nurbs pipelines python solver)
set(nurbs_may_include nurbs)
set(solver_may_include solver)
set(fem_may_include fem nurbs solver)
set(cad_import_may_include cad_import nurbs)
set(pipelines_may_include pipelines cad_import fem nurbs solver)
set(python_may_include python pipelines cad_import fem nurbs solver)

set(nurbs_floors . smooth)
set(cad_import_floors report files . occt iges step ifc dxf json svg program)
set(solver_floors algebra system steps rest tangents)
set(fem_floors . material element comparison structure mesh constraints forces model system motion sensitivity)
set(fem_motion_floors record remesh events rest run)
set(python_floors .)
set(pipelines_floors diagnostics case section model results accuracy report run route study command verification papers bench)

# Where which header in <> may stand: pairs of what is included and which files may include it.
set(homes
  "[a-z_]+"                                                                       ".*"  # the standard library
  "Eigen/(Core|Dense|Geometry|LU|QR|SVD|Cholesky|Eigenvalues|SparseC(ore|holesky))" ".*"
  "(dlfcn|fcntl|malloc|poll|signal|spawn|unistd|sys/[a-z]+)\\.h"                                     "(cad_import|pipelines)/.*\\.cpp"
  "[A-Za-z0-9_]+\\.hxx"                                                           "cad_import/(occt|iges|step|program)/.*"
  "tbb/.*"                                                                        "solver/algebra/side_by_side\\.cpp"
  "(sundials|kinsol|idas?|cvodes?|arkode|nvector|sunmatrix|sunlinsol|sunnonlinsol)/.*" "solver/(.*\\.cpp|(algebra/sundials_border|rest/kinsol)\\.h)"
  "(klu\\.h|Eigen/KLUSupport)"                                                    "solver/algebra/sparse_lu\\.cpp"
  "Spectra/.*"                                                                    "solver/algebra/eigenpairs\\.cpp"
  "pybind11/.*"                                                                   "python/.*"
  "nlohmann/.*"                                                                   "(cad_import/json/.*\\.cpp|pipelines/(accuracy/level_file\\.cpp|case/.*|command/(inspect|route)\\.cpp|model/model_summary\\.cpp|report/report\\.cpp|run/(model_digest|run_messages)\\.cpp|route/route_case\\.cpp|results/(checked_json|run_summary)\\.cpp|study/(rows|study_output|study_report)\\.cpp|study/study_case\\.h))"
  "openturns/.*"                                                                  "pipelines/study/openturns_study\\.h"
  "mpi\\.h"                                                                       "pipelines/study/mpi_engine\\.cpp"
  "iconv\\.h"                                                                       "cad_import/files/code_page\\.cpp"
  "zlib\\.h"                                                                      "cad_import/program/unpacked\\.cpp"
  "netcdf\\.h"                                                                    "pipelines/results/netcdf_file\\.cpp"
  "CLI/.*"                                                                        "pipelines/command/command_line\\.cpp"
  "CGAL/.*"                                                                       "pipelines/section/with_cgal\\.cpp"
  "openssl/.*"                                                                    "pipelines/results/(file_hash|base64)\\.cpp")

set_property(GLOBAL PROPERTY complaints 0)
function(complain file included reason)
  message("${file} includes ${included}: ${reason}")
  get_property(complaints GLOBAL PROPERTY complaints)
  math(EXPR complaints "${complaints} + 1")
  set_property(GLOBAL PROPERTY complaints ${complaints})
endfunction()

function(check_own_header room file path)
  string(REGEX MATCH "^[a-z_]+" included_room "${path}")
  if(NOT included_room IN_LIST rooms OR NOT included_room IN_LIST ${room}_may_include)
    complain(${file} ${path} "${room} may include only ${${room}_may_include}")
  elseif(NOT path MATCHES "\\.h$")
    complain(${file} ${path} "sources are not included")
  elseif(NOT EXISTS ${ROOT}/${path})
    complain(${file} ${path} "includes go from the root, as in \"nurbs/knot_vector.h\"")
  endif()
endfunction()

# The folder of a file in `parent`, a room or a folder with a list: "." for `parent` itself.
function(floor_of parent path result)
  if(path MATCHES "^${parent}/([a-z_]+)/")
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
  else()
    set(${result} . PARENT_SCOPE)
  endif()
endfunction()

function(check_floor parent file path)
  string(REPLACE / _ name ${parent})
  if(NOT path MATCHES "^${parent}/" OR NOT file MATCHES "^${parent}/" OR NOT DEFINED ${name}_floors)
    return()
  endif()
  floor_of(${parent} ${file} from)
  floor_of(${parent} ${path} to)
  list(FIND ${name}_floors ${from} from_rank)
  list(FIND ${name}_floors ${to} to_rank)
  if(from_rank EQUAL -1)
    complain(${file} ${path} "${parent}/${from} has no place among the folders of ${parent}: ${${name}_floors}")
  elseif(to_rank GREATER from_rank)
    complain(${file} ${path} "${to} stands above ${from}: the order is ${${name}_floors}")
  endif()
  check_floor(${parent}/${from} ${file} ${path})
endfunction()

function(check_library_header file path)
  set(pairs ${homes})
  while(pairs)
    list(POP_FRONT pairs header home)
    if(path MATCHES "^${header}$")
      if(NOT file MATCHES "^${home}$")
        complain(${file} "<${path}>" "its home is ${home}")
      endif()
      return()
    endif()
  endwhile()
  complain(${file} "<${path}>" "this library has no home yet; give it one in tests/architecture/includes.cmake")
endfunction()

# A source file begins with its own header, which so is seen to compile alone.
function(check_begins_with_own_header file first_line)
  string(REGEX REPLACE "\\.cpp$" ".h" own "${file}")
  if(file MATCHES "\\.cpp$" AND EXISTS ${ROOT}/${own} AND NOT first_line MATCHES "\"${own}\"")
    complain(${file} ${own} "its own header must come first")
  endif()
endfunction()

# Texts compare with ==: what strcmp gives is easily taken for the opposite.
function(check_comparisons file)
  file(STRINGS ${ROOT}/${file} comparisons REGEX "[^a-z_](str[a-z]*|mem)cmp[ \t]*\\(")
  if(comparisons)
    complain(${file} <cstring> "compare texts with ==, not with ${comparisons}")
  endif()
endfunction()

set(count 0)
foreach(room IN LISTS rooms)
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${room}/*.h ${ROOT}/${room}/*.cpp)
  foreach(file IN LISTS files)
    file(STRINGS ${ROOT}/${file} lines REGEX "^[ \t]*#[ \t]*include")
    if(lines)
      list(GET lines 0 first_line)
      check_begins_with_own_header(${file} "${first_line}")
    endif()
    check_comparisons(${file})
    foreach(line IN LISTS lines)
      math(EXPR count "${count} + 1")
      if(line MATCHES "\"([^\"]+)\"")
        check_own_header(${room} ${file} ${CMAKE_MATCH_1})
        check_floor(${room} ${file} ${CMAKE_MATCH_1})
      elseif(line MATCHES "<([^>]+)>")
        check_library_header(${file} ${CMAKE_MATCH_1})
      endif()
    endforeach()
  endforeach()
endforeach()
if(count EQUAL 0)
  message(FATAL_ERROR "no #include found under ${ROOT}")
endif()
get_property(complaints GLOBAL PROPERTY complaints)
if(complaints)
  message(FATAL_ERROR "${complaints} of ${count} includes break the rule")
endif()
message(STATUS "${count} includes read")
