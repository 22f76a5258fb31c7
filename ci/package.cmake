# Installs the program with its data. `cpack` makes two Debian packages: `glovebench` (component command) and
# `libglovebench-dev` (component core, core/CMakeLists.txt).

# The manual page and the completion of shells, as the program prints them.
set(manual ${PROJECT_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${manual})
add_custom_command(OUTPUT ${manual}/glovebench.1 ${manual}/glovebench ${manual}/_glovebench ${manual}/glovebench.fish
  COMMAND glovebench manual > ${manual}/glovebench.1
  COMMAND glovebench completion bash > ${manual}/glovebench
  COMMAND glovebench completion zsh > ${manual}/_glovebench
  COMMAND glovebench completion fish > ${manual}/glovebench.fish
  DEPENDS glovebench
  COMMENT "Writing the manual page"
  VERBATIM)
add_custom_target(glovebench_manual ALL DEPENDS ${manual}/glovebench.1)

install(TARGETS glovebench RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
install(DIRECTORY ${GLOVEBENCH_SHARE_DIR} DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT command)
install(FILES ${manual}/glovebench.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
install(FILES ${manual}/glovebench DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT command)
install(FILES ${manual}/_glovebench DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT command)
install(FILES ${manual}/glovebench.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT command)
# dpkg refuses two packages with one file.
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/glovebench RENAME copyright COMPONENT command)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libglovebench-dev RENAME copyright COMPONENT core)

# `cpack` packs what is built and builds nothing: ci/package builds before it.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The glovebench authors <glovebench@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL command core)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME glovebench)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "ffmpeg, openssl")  # `track --overlay FILE.mp4`, `robot-server keys`
set(CPACK_COMPONENT_COMMAND_DESCRIPTION ${PROJECT_DESCRIPTION})
set(CPACK_DEBIAN_CORE_PACKAGE_NAME libglovebench-dev)
set(CPACK_DEBIAN_CORE_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_CORE_PACKAGE_DEPENDS  # what glovebenchConfig.cmake finds
  "libassimp-dev, libeigen3-dev, libfmt-dev, libhwy-dev, libopencv-dev, libtbb-dev, libxxhash-dev, nlohmann-json3-dev, pkg-config")
set(CPACK_COMPONENT_CORE_DESCRIPTION "The hand tracker of glovebench as a library")
include(CPack)

if(GLOVEBENCH_TESTS)
  add_test(NAME ci/package COMMAND ${GLOVEBENCH_PYTHON} ${PROJECT_SOURCE_DIR}/ci/package_test.py
    ${CMAKE_CPACK_COMMAND} ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR})
endif()
