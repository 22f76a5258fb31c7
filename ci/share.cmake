# Data that the programs read at run time. It stands in the build as it stands where it is installed: programs
# in bin/ find it in ../share/glovebench.
set(GLOVEBENCH_SHARE_DIR ${PROJECT_BINARY_DIR}/share/glovebench)
add_custom_target(glovebench_share ALL)

# Copies one file when CMake configures, which it does again when the file changes. If the file is missing,
# configuring fails and says the remedy.
function(glovebench_share_file source target remedy)
  if(NOT EXISTS ${source})
    message(FATAL_ERROR "${source}: missing; ${remedy}")
  endif()
  configure_file(${source} ${GLOVEBENCH_SHARE_DIR}/${target} COPYONLY)
endfunction()

# Copies a folder when something in it changes. It is replaced whole, so that no deleted file lives on; the
# stamp's name carries the list of files, so that a deletion counts as a change.
function(glovebench_share_folder source target)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${source}/*)
  if(NOT files)
    return()
  endif()
  string(MD5 list_id "${files}")
  string(MAKE_C_IDENTIFIER ${target} name)
  set(stamp ${PROJECT_BINARY_DIR}/CMakeFiles/share_${name}_${list_id}.stamp)
  add_custom_command(OUTPUT ${stamp}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${GLOVEBENCH_SHARE_DIR}/${target}
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${source} ${GLOVEBENCH_SHARE_DIR}/${target}
    COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
    DEPENDS ${files}
    COMMENT "Copying ${target} to share/glovebench"
    VERBATIM)
  add_custom_target(glovebench_share_${name} DEPENDS ${stamp})
  add_dependencies(glovebench_share glovebench_share_${name})
endfunction()
