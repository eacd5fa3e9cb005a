# Before `cpack` packs a .tar.gz: makes of the installed tree one that runs from any folder, on any x86-64 Linux,
# also with an older C library than the one it was built with. All libraries come along, the C library and its loader
# among them; bin/talus is a script that starts the program with them.
if(NOT CPACK_GENERATOR STREQUAL TGZ)
  return()
endif()
set(root "${CPACK_TEMPORARY_DIRECTORY}")
file(GLOB installed "${root}${CPACK_PACKAGING_INSTALL_PREFIX}/*")  # as a package has it: /usr
foreach(entry IN LISTS installed)
  get_filename_component(name "${entry}" NAME)
  file(RENAME "${entry}" "${root}/${name}")
endforeach()
file(REMOVE_RECURSE "${root}${CPACK_PACKAGING_INSTALL_PREFIX}")
set(libraries "${root}/lib/talus")
file(REMOVE_RECURSE "${root}/include" "${root}/lib")  # for building against, and a module of this system's Python
file(MAKE_DIRECTORY "${libraries}")
file(RENAME "${root}/bin/talus" "${libraries}/talus")

file(GET_RUNTIME_DEPENDENCIES EXECUTABLES "${libraries}/talus"
  RESOLVED_DEPENDENCIES_VAR found UNRESOLVED_DEPENDENCIES_VAR lost)
if(lost)
  message(FATAL_ERROR "libraries that are not here: ${lost}")
endif()
foreach(library IN LISTS found)
  get_filename_component(name "${library}" NAME)
  get_filename_component(file "${library}" REALPATH)
  file(COPY_FILE "${file}" "${libraries}/${name}")
endforeach()

# What they are under, from the packages that they are of.
file(MAKE_DIRECTORY "${root}/share/doc/talus/libraries")
foreach(library IN LISTS found)
  get_filename_component(file "${library}" REALPATH)
  string(REGEX REPLACE "^/usr" "" without_usr "${file}")  # dpkg knows some of /usr/lib as /lib
  foreach(path "${file}" "${without_usr}")
    execute_process(COMMAND dpkg -S "${path}" OUTPUT_VARIABLE owner RESULT_VARIABLE unknown ERROR_QUIET)
    if(NOT unknown)
      break()
    endif()
  endforeach()
  string(REGEX MATCH "^[^:,\n]+" package "${owner}")
  set(copyright "/usr/share/doc/${package}/copyright")
  if(unknown OR NOT EXISTS "${copyright}")
    message(FATAL_ERROR "${library}: no package says what it is under")
  endif()
  get_filename_component(copyright "${copyright}" REALPATH)
  file(COPY_FILE "${copyright}" "${root}/share/doc/talus/libraries/${package}")
endforeach()

# The loader goes by the name that the program asks for it.
execute_process(COMMAND readelf -l "${libraries}/talus" OUTPUT_VARIABLE headers COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "interpreter: ([^]]+)" _ "${headers}")
get_filename_component(loader "${CMAKE_MATCH_1}" NAME)
get_filename_component(file "${CMAKE_MATCH_1}" REALPATH)
file(COPY_FILE "${file}" "${libraries}/${loader}")

# The environment names the program to itself, whose process is the loader's; OpenMP waits asleep, which it would
# otherwise start itself anew for.
file(WRITE "${root}/bin/talus" "#!/bin/sh
# Starts talus with the libraries beside it, wherever this folder is.
self=\$(readlink -f \"\$0\")
libraries=\$(dirname \"\$(dirname \"\$self\")\")/lib/talus
export TALUS_PROGRAM=\"\$self\" OMP_WAIT_POLICY=\"\${OMP_WAIT_POLICY:-passive}\"
exec \"\$libraries/${loader}\" --argv0 \"\$0\" --inhibit-cache --library-path \"\$libraries\" \"\$libraries/talus\" \"\$@\"
")
file(CHMOD "${root}/bin/talus" "${libraries}/talus" "${libraries}/${loader}" PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
