# Every package the project builds on. All missing ones are named at once, each with its Debian
# package, so that a build without root needs one look.
set(talus_missing "")

macro(talus_find package debian_package)
  find_package(${package} QUIET ${ARGN})
  if(NOT ${package}_FOUND)
    string(APPEND talus_missing "\n  ${package}  (Debian: ${debian_package})")
  endif()
endmacro()

# Ceres reads Eigen's and glog's configuration itself, so Eigen comes first.
talus_find(Eigen3 libeigen3-dev NO_MODULE)
talus_find(Ceres libceres-dev)
talus_find(NLopt libnlopt-cxx-dev)
talus_find(OpenCVImgproc libopencv-imgproc-dev)
talus_find(PNG libpng-dev)
talus_find(JPEG libjpeg-dev)
talus_find(TIFF libtiff-dev)
talus_find(nlohmann_json nlohmann-json3-dev)
talus_find(SQLite3 libsqlite3-dev)
talus_find(CLI11 libcli11-dev)
talus_find(Threads libc6-dev)
# The thread sanitizer takes what OpenMP's threads share for races, and clang's OpenMP is another
# package: there every loop has one thread.
set(talus_openmp "")
if(NOT TALUS_THREAD_SANITIZER AND NOT TALUS_FUZZ)
  talus_find(OpenMP "g++" COMPONENTS CXX)
  set(talus_openmp OpenMP::OpenMP_CXX)
endif()
talus_find(pugixml libpugixml-dev)
talus_find(ZLIB zlib1g-dev)
talus_find(PkgConfig pkg-config)
if(PkgConfig_FOUND)
  pkg_check_modules(XXHASH QUIET IMPORTED_TARGET libxxhash)
endif()
if(NOT XXHASH_FOUND)
  string(APPEND talus_missing "\n  xxHash  (Debian: libxxhash-dev)")
endif()
if(TALUS_BUILD_TESTS)
  talus_find(GTest "libgtest-dev and libgmock-dev")
endif()

if(talus_missing)
  message(FATAL_ERROR "These packages are missing:${talus_missing}\n"
    "scripts/install_packages installs them all on Debian 12 (needs root).")
endif()
