# This folder inside a tree of MeshLab (since 2022.02) or of meshlab-extra-plugins: docs/hosts.md.
# MeshLab's `add_meshlab_plugin` knows the version, the precision and where plugins go.
if(TARGET meshlab-common)
  get_target_property(_common meshlab-common SOURCE_DIR)
else()
  message(FATAL_ERROR "massprops: MeshLab's library meshlab-common comes before its plugins.")
endif()
if(EXISTS ${_common}/parameters/rich_parameter/rich_percentage.h)
  set(_percentage RichPercentage)
  set(_file RichFileSave)
else()
  set(_percentage RichAbsPerc)
  set(_file RichSaveFile)
endif()

add_subdirectory(core)
file(GLOB _sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/filter_massprops/*.cpp)
file(GLOB _headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/filter_massprops/*.h)
add_meshlab_plugin(filter_massprops ${_sources} ${_headers})
target_compile_definitions(
  filter_massprops PRIVATE MASSPROPS_MESHLAB_API=2022 MASSPROPS_MESHLAB_PERCENTAGE=${_percentage}
                           MASSPROPS_MESHLAB_FILE=${_file})
target_link_libraries(filter_massprops PRIVATE massprops::core)
set_target_properties(filter_massprops PROPERTIES AUTOMOC ON)
if(UNIX AND NOT APPLE)
  target_link_options(
    filter_massprops PRIVATE -Wl,--exclude-libs,ALL -Wl,--as-needed
    -Wl,--version-script=${PROJECT_SOURCE_DIR}/filter_massprops/exports.map)
endif()
