# cmake -DBUILD=<build tree> -DCONFIG=<type> -DFLAGS=<its compiler flags> -P install_and_build.cmake:
# installs nurbeam below the build tree, and builds and runs the projects of this folder against it.
set(work ${BUILD}/consumer)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/installed)
foreach(project . curve)
  run(${CMAKE_COMMAND} -G Ninja -S ${CMAKE_CURRENT_LIST_DIR}/${project} -B ${work}/build/${project}
    -DCMAKE_PREFIX_PATH=${work}/installed -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_CXX_FLAGS=${FLAGS})
  run(${CMAKE_COMMAND} --build ${work}/build/${project})
endforeach()
run(${work}/build/consumer)
run(${work}/build/curve/curve_consumer)
run(${work}/installed/bin/nurbeam --version)
