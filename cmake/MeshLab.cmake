# MeshLab::plugin: everything a filter plugin needs of one MeshLab version.
# vcglib:          the vcglib of the same tree.
# MESHLAB_PLUGIN_LIBRARY: the libmeshlab-common.so it was built for; MESHLAB_PACKAGE_VERSION: of the
#                  Debian package that the library is from, empty for another one.
#
# A plugin runs only in the MeshLab whose headers it was compiled with. Without the three variables
# below that is the installed Debian package, whose sources are fetched.
set(MESHLAB_SOURCE_DIR "" CACHE PATH
    "MeshLab source tree with vcglib; empty: the sources of the installed package")
set(MESHLAB_LIBRARY "" CACHE FILEPATH
    "libmeshlab-common.so of the same version; empty: the installed one")
set(MESHLAB_SCALAR float CACHE STRING "Scalar type MeshLab was built with")
set_property(CACHE MESHLAB_SCALAR PROPERTY STRINGS float double)

set(_tree "${MESHLAB_SOURCE_DIR}")
if(NOT _tree)
  execute_process(
    COMMAND ${PROJECT_SOURCE_DIR}/scripts/fetch_meshlab_source.sh
            ${PROJECT_SOURCE_DIR}/build/meshlab-source
    OUTPUT_VARIABLE _tree OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
endif()

set(_library "${MESHLAB_LIBRARY}")
if(NOT _library)
  find_library(MESHLAB_INSTALLED_LIBRARY meshlab-common PATH_SUFFIXES meshlab REQUIRED)
  mark_as_advanced(MESHLAB_INSTALLED_LIBRARY)
  set(_library "${MESHLAB_INSTALLED_LIBRARY}")
endif()

set(MESHLAB_PLUGIN_LIBRARY "${_library}")
set(MESHLAB_PACKAGE_VERSION "")
if(NOT MESHLAB_SOURCE_DIR AND NOT MESHLAB_LIBRARY)
  execute_process(COMMAND dpkg-query -W -f "\${Version}" meshlab
                  OUTPUT_VARIABLE MESHLAB_PACKAGE_VERSION COMMAND_ERROR_IS_FATAL ANY)
endif()

# The plugin interface changed with 2022.02.
if(EXISTS ${_tree}/src/common/plugins/interfaces/filter_plugin.h)
  set(_api 2022)
elseif(EXISTS ${_tree}/src/common/interfaces.h)
  set(_api 2020)
else()
  message(FATAL_ERROR "${_tree} holds no src/common of a MeshLab since 2020.09.")
endif()

if(EXISTS ${_tree}/src/common/parameters/rich_parameter/rich_percentage.h)
  set(_percentage RichPercentage)
  set(_file RichFileSave)
else()
  set(_percentage RichAbsPerc)
  set(_file RichSaveFile)
endif()

file(STRINGS ${_tree}/ML_VERSION _version LIMIT_COUNT 1)
if(MESHLAB_SCALAR STREQUAL double)
  string(APPEND _version d)
endif()

find_path(_vcglib vcg/complex/complex.h PATHS ${_tree}/vcglib ${_tree}/src/vcglib NO_DEFAULT_PATH
          NO_CACHE REQUIRED)

find_package(Eigen3 REQUIRED NO_MODULE)
find_package(GLEW REQUIRED)
find_package(Qt5 REQUIRED COMPONENTS Core Widgets OpenGL Xml)

add_library(vcglib INTERFACE)
target_include_directories(vcglib SYSTEM INTERFACE ${_vcglib})
target_link_libraries(vcglib INTERFACE Eigen3::Eigen)

add_library(MeshLab::plugin SHARED IMPORTED)
set_target_properties(MeshLab::plugin PROPERTIES IMPORTED_LOCATION "${_library}")
target_include_directories(MeshLab::plugin SYSTEM INTERFACE ${_tree}/src)
target_compile_definitions(
  MeshLab::plugin
  INTERFACE MESHLAB_SCALAR=${MESHLAB_SCALAR} MESHLAB_VERSION=${_version}
            MASSPROPS_MESHLAB_API=${_api} MASSPROPS_MESHLAB_PERCENTAGE=${_percentage}
            MASSPROPS_MESHLAB_FILE=${_file})
get_target_property(_glew GLEW::GLEW INTERFACE_INCLUDE_DIRECTORIES)
target_include_directories(MeshLab::plugin SYSTEM INTERFACE ${_glew})
target_link_libraries(MeshLab::plugin INTERFACE vcglib Qt5::Core Qt5::Widgets Qt5::OpenGL Qt5::Xml)

message(STATUS "MeshLab ${_version}, ${MESHLAB_SCALAR}, plugin interface of ${_api}: ${_tree}")
