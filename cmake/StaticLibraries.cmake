# What is needed at run time: with MASSPROPS_LINK_STATICALLY neither NLopt nor GMP nor MPFR, so that what was
# built loads on machines without them.
option(MASSPROPS_LINK_STATICALLY
       "Link NLopt, GMP and MPFR in; builds them from Debian's sources at first" OFF)
set(_static ${PROJECT_SOURCE_DIR}/build/static-libraries)
if(NOT MASSPROPS_LINK_STATICALLY)
  # What this tree linked in before is the system's again.
  foreach(_variable IN ITEMS GMP_LIBRARIES GMPXX_LIBRARIES MPFR_LIBRARIES GMP_LIBRARY_RELEASE GMP_LIBRARY_DEBUG)
    string(FIND "${${_variable}}" "${_static}" _place)
    if(_place EQUAL 0)
      unset(${_variable} CACHE)
    endif()
  endforeach()
  return()
endif()

# Beside what compiles: nothing but the linker waits for them, and much of it is done on one core.
set(_libraries "")
foreach(library IN ITEMS gmp gmpxx mpfr nlopt)
  list(APPEND _libraries ${_static}/lib/lib${library}.a)
endforeach()
set(_script ${PROJECT_SOURCE_DIR}/scripts/build_static_libraries.sh)
execute_process(COMMAND dpkg-query -W libnlopt-dev libgmp-dev libmpfr-dev OUTPUT_VARIABLE _versions
                COMMAND_ERROR_IS_FATAL ANY)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/static_libraries.versions CONTENT "${_versions}")
add_custom_command(OUTPUT ${_libraries} COMMAND ${_script} ${_static}
                   DEPENDS ${_script} ${PROJECT_BINARY_DIR}/static_libraries.versions VERBATIM)
add_custom_target(static_libraries DEPENDS ${_libraries})
# The variables that CGAL finds them by; the headers are those of the system. It looks for GMP itself
# again as long as it does not know the headers, and keeps what it found by two names.
foreach(library IN ITEMS gmp gmpxx mpfr)
  string(TOUPPER ${library} _name)
  set(${_name}_LIBRARIES ${_static}/lib/lib${library}.a CACHE FILEPATH "" FORCE)
endforeach()
foreach(kind IN ITEMS RELEASE DEBUG)
  set(GMP_LIBRARY_${kind} ${_static}/lib/libgmp.a CACHE FILEPATH "" FORCE)
endforeach()
set(MASSPROPS_STATIC_NLOPT ${_static}/lib/libnlopt.a)
