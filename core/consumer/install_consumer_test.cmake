# Installs the library into a new folder, then configures, builds and runs the consumer against nothing else.
# Arguments: BUILD_DIR, SOURCE_DIR, CONFIG, GENERATOR, COMPILER, FLAGS of the build that is tested; MESH.
set(work ${BUILD_DIR}/install-consumer)
set(prefix ${work}/prefix)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --component core --prefix ${prefix})

# An installed package that points back into the build works only on this machine.
file(GLOB_RECURSE package_files ${prefix}/*.cmake)
if(NOT package_files)
  message(FATAL_ERROR "${prefix}: no package configuration was installed")
endif()
foreach(file IN LISTS package_files)
  file(READ ${file} content)
  foreach(folder ${SOURCE_DIR} ${BUILD_DIR})
    string(FIND "${content}" ${folder} position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file}: names the build or source folder ${folder}")
    endif()
  endforeach()
endforeach()

run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE_DIR}/core/consumer -B ${work}/build
  -D CMAKE_BUILD_TYPE=${CONFIG} -D CMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${FLAGS}"
  -D CMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/consumer ${MESH})
