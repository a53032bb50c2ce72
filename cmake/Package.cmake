# `cmake --install`: the plugin goes to where the MeshLab it was built for looks for plugins.
# `cpack`: a Debian package for the installed MeshLab.
cmake_path(GET MESHLAB_PLUGIN_LIBRARY PARENT_PATH _libraries)
set(MESHLAB_PLUGIN_DIR "${_libraries}/plugins" CACHE PATH "Folder of MeshLab's plugins")
install(TARGETS filter_massprops LIBRARY DESTINATION ${MESHLAB_PLUGIN_DIR} COMPONENT plugin)

# The program, with what bash completes its words by and the page of the manual, which it writes itself.
if(TARGET massprops)
  set(_described ${CMAKE_BINARY_DIR}/command_line)
  add_custom_command(
    OUTPUT ${_described}/massprops.1 ${_described}/massprops.bash
    COMMAND massprops --describe man > massprops.1
    COMMAND massprops --describe bash > massprops.bash
    WORKING_DIRECTORY ${_described}
    DEPENDS massprops)
  add_custom_target(massprops_described ALL DEPENDS ${_described}/massprops.1)
endif()

if(NOT MESHLAB_PACKAGE_VERSION)
  return()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME meshlab-massprops)
set(CPACK_PACKAGE_CONTACT "The massprops authors <massprops@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "MeshLab filter that hollows models so that their prints behave")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Adds the filter Mass Property Optimization to MeshLab: it finds the cavity with which a model
 stands, spins, floats, hangs or rolls upright once it is printed. The program massprops does the same
 on the command line.")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# A plugin runs only in the version it was compiled for.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "meshlab (= ${MESHLAB_PACKAGE_VERSION})")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${_libraries})
set(CPACK_STRIP_FILES ON)
# The destinations are absolute.
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_BINARY_DIR};massprops;plugin;/"
                                 "${CMAKE_BINARY_DIR};massprops;package;/")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION /usr/share/doc/${CPACK_PACKAGE_NAME}
        RENAME copyright COMPONENT package EXCLUDE_FROM_ALL)
if(TARGET massprops)
  install(TARGETS massprops RUNTIME DESTINATION /usr/bin COMPONENT package EXCLUDE_FROM_ALL)
  install(FILES ${_described}/massprops.1 DESTINATION /usr/share/man/man1 COMPONENT package
          EXCLUDE_FROM_ALL)
  install(FILES ${_described}/massprops.bash DESTINATION /usr/share/bash-completion/completions
          RENAME massprops COMPONENT package EXCLUDE_FROM_ALL)
endif()
include(CPack)
