# `cmake --install` puts the program, the libraries with their public headers, and what
# find_package(talus) needs in the usual places.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(talus_libraries GLOBAL PROPERTY talus_libraries)
list(REMOVE_ITEM talus_libraries talus_experiments)  # part of the program
install(TARGETS ${talus_libraries} talus_compile_options EXPORT talusTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/talus
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS talus)
install(EXPORT talusTargets NAMESPACE talus::
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
configure_package_config_file(cmake/talusConfig.cmake.in ${PROJECT_BINARY_DIR}/talusConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/talusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/talusConfig.cmake ${PROJECT_BINARY_DIR}/talusConfigVersion.cmake
    cmake/FindOpenCVImgproc.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
# Examples find their schema at ../../docs, in the source tree and installed.
install(DIRECTORY examples docs DESTINATION ${CMAKE_INSTALL_DATADIR}/talus
  PATTERN campaign EXCLUDE)  # where one was run
# What they link to stands where it does in the source tree.
foreach(file README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md LICENSE CITATION.cff bench/RECORD.md
    bench/drum_mcc/README.md bench/drum_mcc/RECORD.md bench/drum_mcc/swelling.py bench/optimizers/README.md bench/optimizers/RECORD.md
    tests/fuzz/README.md third_party/echarts/README.md)
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_DATADIR}/talus/${folder})
endforeach()
install(FILES LICENSE CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The licence and those of what is inside the program, as Debian's packages have them.
set(copyright "talus is under the licence in the file LICENSE beside this one. Inside the program, and in every report that it \
writes, are Apache ECharts and ECharts-GL, unchanged; their licences follow. \
Those of the libraries that are compiled into it stand in the folder libraries.\n")
file(GLOB licences CONFIGURE_DEPENDS third_party/echarts/NOTICE.* third_party/echarts/LICENSE.*)
foreach(file IN LISTS licences)
  file(READ ${file} text)
  get_filename_component(name ${file} NAME)
  string(APPEND copyright "\n--- ${name} ---\n\n${text}\n")
endforeach()
# What is compiled into it, as far as Debian's packages say.
foreach(package libceres-dev libcli11-dev libeigen3-dev libopencv-core-dev nlohmann-json3-dev)
  if(EXISTS /usr/share/doc/${package}/copyright)
    install(FILES /usr/share/doc/${package}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR}/libraries RENAME ${package})
  endif()
endforeach()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/copyright CONTENT "@copyright@" @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${licences} DESTINATION ${CMAKE_INSTALL_DATADIR}/talus/third_party/echarts)

# Man pages and completions are what the program says of itself.
set(talus_described ${PROJECT_BINARY_DIR}/described)
add_custom_command(OUTPUT ${talus_described}/done
  COMMAND ${PROJECT_SOURCE_DIR}/scripts/describe $<TARGET_FILE:talus> ${talus_described}
  COMMAND ${CMAKE_COMMAND} -E touch ${talus_described}/done
  DEPENDS talus ${PROJECT_SOURCE_DIR}/scripts/describe VERBATIM)
add_custom_target(talus_describe ALL DEPENDS ${talus_described}/done)
install(DIRECTORY ${talus_described}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${talus_described}/bash/talus
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${talus_described}/zsh/_talus
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES ${talus_described}/fish/talus.fish
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# `cpack` in the build folder makes talus_VERSION_ARCH.deb, and talus-VERSION-Linux-ARCH.tar.gz, which runs wherever it is
# unpacked (TalusArchive.cmake).
set(CPACK_GENERATOR DEB TGZ)
# Without these two cpack makes no package, or one that names no library it needs.
find_program(TALUS_SHLIBDEPS dpkg-shlibdeps)
find_program(TALUS_FILE file)
mark_as_advanced(TALUS_SHLIBDEPS TALUS_FILE)
if(NOT TALUS_SHLIBDEPS OR NOT TALUS_FILE)
  message(STATUS "cpack makes no Debian package: it needs Debian's dpkg-dev and file")
  set(CPACK_GENERATOR TGZ)
endif()
set(CPACK_SYSTEM_NAME ${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/TalusArchive.cmake)
set(CPACK_PACKAGE_NAME talus)
set(CPACK_PACKAGE_CONTACT "The talus developers <talus@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "liggghts, lammps, yade, slurm-client, chromium, python3-numpy, python3-pandas, python3-xarray")
include(CPack)
