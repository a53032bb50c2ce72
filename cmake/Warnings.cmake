# massprops::warnings: linked by every target of ours. Headers of other projects come in as SYSTEM
# and stay silent.
add_library(massprops_warnings INTERFACE)
add_library(massprops::warnings ALIAS massprops_warnings)
target_compile_options(
  massprops_warnings
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            -Wshadow
            -Wconversion
            -Wnon-virtual-dtor
            -Woverloaded-virtual
            -Wold-style-cast
            -Wcast-qual
            -Wformat=2
            $<$<BOOL:${MASSPROPS_WERROR}>:-Werror>)
