# cpack -G DEB in the build tree: nurbeam (the programs), libnurbeam-dev (libraries and headers), python3-nurbeam,
# freecad-nurbeam (the FreeCAD workbench) and nurbeam-doc (the site of the documentation).
set(packaged_components runtime dev)
set(packaged_names nurbeam libnurbeam-dev)
if(NURBEAM_WITH_PYTHON)
  list(APPEND packaged_components python freecad)
  list(APPEND packaged_names python3-nurbeam freecad-nurbeam)
endif()
if(NURBEAM_SITE)
  list(APPEND packaged_components doc)
  list(APPEND packaged_names nurbeam-doc)
endif()
set(CPACK_PACKAGE_NAME nurbeam)
set(CPACK_PACKAGE_CONTACT "The nurbeam authors <authors@nurbeam.invalid>")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What each package says of itself: its licence and its changes, and the programs to catalogues of software.
set(packaged_changelog ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)
execute_process(COMMAND gzip -9nc ${CMAKE_CURRENT_SOURCE_DIR}/cmake/package/changelog OUTPUT_FILE ${packaged_changelog})
foreach(described IN ITEMS "changelog:(${PROJECT_VERSION})" "org.nurbeam.nurbeam.metainfo.xml:version=\"${PROJECT_VERSION}\"")
  string(REGEX MATCH "^([^:]*):(.*)$" unused "${described}")
  file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/cmake/package/${CMAKE_MATCH_1} lines)
  string(FIND "${lines}" "${CMAKE_MATCH_2}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "cmake/package/${CMAKE_MATCH_1} does not tell of version ${PROJECT_VERSION}")
  endif()
endforeach()
foreach(component package IN ZIP_LISTS packaged_components packaged_names)
  if(DEFINED SKBUILD)
    break()  # a wheel has its own place for them
  endif()
  install(FILES cmake/package/copyright ${packaged_changelog} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
    COMPONENT ${component})
endforeach()
install(FILES cmake/package/org.nurbeam.nurbeam.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo COMPONENT runtime)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL ${packaged_components})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME nurbeam)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "libnetcdf19, libssl3")  # loaded late, which is not seen
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "CAD curves to flexible beams with sliding joints, and back
 nurbeam reads a curve from a STEP or IGES file, turns it without loss into
 flexible beam elements, simulates its motion with bodies that slide along it,
 and writes the deformed curve back to CAD.")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libnurbeam-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "nurbeam (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.4), libsundials-dev (>= 6.4), \
libsuitesparse-dev, nlohmann-json3-dev (>= 3.11)")
if(NURBEAM_WITH_CGAL)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libcgal-dev (>= 5.5)")
endif()
set(CPACK_COMPONENT_DEV_DESCRIPTION "Libraries and headers of nurbeam
 Curves, beam elements, integrators, CAD files and whole runs from C++.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-nurbeam)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "nurbeam (= ${PROJECT_VERSION}), ${NURBEAM_PYTHON_DEPENDS}, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS
  "python3-scipy, python3-matplotlib, python3-pandas, python3-xarray, python3-tqdm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "nurbeam from Python
 Curves, models, runs, forces of one's own and results as arrays.")
set(CPACK_DEBIAN_FREECAD_PACKAGE_NAME freecad-nurbeam)
set(CPACK_DEBIAN_FREECAD_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FREECAD_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_FREECAD_PACKAGE_DEPENDS
  "python3, nurbeam (= ${PROJECT_VERSION}), python3-nurbeam (= ${PROJECT_VERSION}), freecad (>= 0.20)")
set(CPACK_COMPONENT_FREECAD_DESCRIPTION "FreeCAD workbench of nurbeam
 Flexible beams along curves of a document, with bodies that slide on them,
 and cables of a given length between connectors.")
set(CPACK_DEBIAN_DOC_PACKAGE_NAME nurbeam-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DOC_DESCRIPTION "Documentation of nurbeam
 Tutorials, how-to pages, reference and theory as a site that needs no
 network: /usr/share/doc/nurbeam/html/index.html.")
include(CPack)
