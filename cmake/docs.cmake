# The documentation as a site, and the reference of the C++ headers, where their generators are there: build/PRESET/docs.
# `docs` is made by Sphinx with MyST and Furo (scripts/setup docs installs them), `docs_cpp` by Doxygen.
find_program(NURBEAM_SPHINX sphinx-build)
execute_process(COMMAND /usr/bin/python3 -c "import sphinx, myst_parser, furo" RESULT_VARIABLE site_is_missing OUTPUT_QUIET ERROR_QUIET)
set(site ${PROJECT_BINARY_DIR}/docs)
if(NURBEAM_SPHINX AND NOT site_is_missing AND EXISTS /usr/share/javascript/katex AND NOT DEFINED SKBUILD)
  set(NURBEAM_SITE ON)
  file(GLOB_RECURSE pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/samples/*.md
    ${PROJECT_SOURCE_DIR}/docs/images/*)
  list(APPEND pages ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
    ${PROJECT_SOURCE_DIR}/fem/notation.md ${PROJECT_SOURCE_DIR}/docs/make_site)
  add_custom_command(OUTPUT ${site}/index.html
    COMMAND ${PROJECT_SOURCE_DIR}/docs/make_site ${site} ${PROJECT_VERSION}
    DEPENDS ${pages} COMMENT "Making the site of the documentation")
  add_custom_target(docs ALL DEPENDS ${site}/index.html)
  install(DIRECTORY ${site}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/nurbeam/html COMPONENT doc
    OPTIONAL
    PATTERN .buildinfo EXCLUDE PATTERN objects.inv EXCLUDE PATTERN cpp EXCLUDE)
endif()

find_program(NURBEAM_DOXYGEN doxygen)
if(NURBEAM_DOXYGEN AND NOT DEFINED SKBUILD)
  set(doxygen_rooms "")
  foreach(room nurbs solver fem cad_import pipelines)
    string(APPEND doxygen_rooms " \"${PROJECT_SOURCE_DIR}/${room}\"")
  endforeach()
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/Doxyfile CONTENT "PROJECT_NAME = nurbeam
PROJECT_NUMBER = ${PROJECT_VERSION}
PROJECT_BRIEF = \"CAD curves to flexible beams with sliding joints, and back\"
INPUT = \"${PROJECT_SOURCE_DIR}/docs/library.md\"${doxygen_rooms}
USE_MDFILE_AS_MAINPAGE = \"${PROJECT_SOURCE_DIR}/docs/library.md\"
FILE_PATTERNS = *.h
RECURSIVE = YES
EXCLUDE_PATTERNS = */pipelines/report/*
STRIP_FROM_PATH = \"${PROJECT_SOURCE_DIR}\"
OUTPUT_DIRECTORY = \"${site}\"
HTML_OUTPUT = cpp
GENERATE_LATEX = NO
EXTRACT_ALL = YES
JAVADOC_AUTOBRIEF = YES
GENERATE_TREEVIEW = YES
DISABLE_INDEX = NO
HAVE_DOT = NO
QUIET = YES
WARNINGS = NO
WARN_IF_DOC_ERROR = NO
VERBATIM_HEADERS = NO
")
  add_custom_target(docs_cpp COMMAND ${CMAKE_COMMAND} -E make_directory ${site}
    COMMAND ${NURBEAM_DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile COMMENT "Making the reference of the C++ headers")
  if(TARGET docs)
    add_dependencies(docs_cpp docs)
  endif()
endif()
