# `cmake --install` puts the program, the libraries with their headers, and what find_package(talus)
# needs in the usual places.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(talus_libraries GLOBAL PROPERTY talus_libraries)
install(TARGETS ${talus_libraries} talus_compile_options EXPORT talusTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/talus)
install(TARGETS talus)
install(EXPORT talusTargets NAMESPACE talus::
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
configure_package_config_file(cmake/talusConfig.cmake.in ${PROJECT_BINARY_DIR}/talusConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/talusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/talusConfig.cmake ${PROJECT_BINARY_DIR}/talusConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/talus)
