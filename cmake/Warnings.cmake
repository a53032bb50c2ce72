# massprops::warnings: linked by every target of ours. Headers of other projects come in as SYSTEM
# and stay silent.
set(_shadow -Wshadow)
if(MASSPROPS_JOIN_SOURCES)
  # Joined, a source may shadow what is in another one, and what each keeps to itself is not in the first file.
  set(_shadow -Wno-shadow)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    set(_shadow -Wshadow=local -Wno-subobject-linkage)
  endif()
endif()
add_library(massprops_warnings INTERFACE)
add_library(massprops::warnings ALIAS massprops_warnings)
target_compile_options(
  massprops_warnings
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            ${_shadow}
            -Wconversion
            -Wnon-virtual-dtor
            -Woverloaded-virtual
            -Wold-style-cast
            -Wcast-qual
            -Wformat=2
            $<$<BOOL:${MASSPROPS_WERROR}>:-Werror>)
