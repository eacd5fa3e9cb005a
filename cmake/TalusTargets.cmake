# How every target of the project is made: one library a folder, one program of tests a folder.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
# Both with assertions: what is checked while it runs is checked at the user's, too.
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1")

add_library(talus_compile_options INTERFACE)
add_library(talus::compile_options ALIAS talus_compile_options)
set_target_properties(talus_compile_options PROPERTIES EXPORT_NAME compile_options)
target_compile_features(talus_compile_options INTERFACE cxx_std_20)
# -fno-math-errno lets sqrt vectorise; -ffast-math would remove the NaN checks. -ffp-contract=off
# keeps the bits independent of where the compiler chooses to fuse. GCC collects its own garbage less
# often than by default: a tenth of the time to compile for some hundred megabytes.
target_compile_options(talus_compile_options INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wnon-virtual-dtor;-fno-math-errno;-ffp-contract=off>
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=400000>>
  $<BUILD_INTERFACE:$<$<BOOL:${TALUS_WARNINGS_AS_ERRORS}>:-Werror>>)
# Checks that double the time to compile are left out where the address sanitizer finds what comes of
# the mistake. GCC 12 takes the storage of an empty std::optional for read once it is instrumented.
# Eigen would put an allocator of its own before the sanitizer's, which optimizer/observation.h refuses.
if(TALUS_SANITIZE)
  target_compile_options(talus_compile_options INTERFACE
    $<BUILD_INTERFACE:-O1;-DEIGEN_MALLOC_ALREADY_ALIGNED=1;-fsanitize=address,undefined;-fno-sanitize=null,alignment,object-size,pointer-overflow>
    $<BUILD_INTERFACE:-fno-sanitize-recover=all;-fno-omit-frame-pointer;-Wno-maybe-uninitialized>)
  target_link_options(talus_compile_options INTERFACE
    $<BUILD_INTERFACE:-fsanitize=address,undefined>)
endif()

if(TALUS_THREAD_SANITIZER)
  target_compile_options(talus_compile_options INTERFACE
    $<BUILD_INTERFACE:-O1;-fsanitize=thread;-fno-omit-frame-pointer>)
  target_link_options(talus_compile_options INTERFACE $<BUILD_INTERFACE:-fsanitize=thread>)
endif()
if(TALUS_FUZZ)
  target_compile_options(talus_compile_options INTERFACE
    $<BUILD_INTERFACE:-O1;-DEIGEN_MALLOC_ALREADY_ALIGNED=1;-fsanitize=fuzzer-no-link,address,undefined;-fno-sanitize-recover=all>
    $<BUILD_INTERFACE:-fno-omit-frame-pointer>)
  target_link_options(talus_compile_options INTERFACE
    $<BUILD_INTERFACE:-fsanitize=address,undefined>)
endif()

# The headers that the libraries with Eigen include, read once. A file includes what it uses all the same: the thread
# preset builds without. Not for libraries that join many strings: GCC 12 warns of its own std::string where it comes
# out of a precompiled header.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/library_headers.cc CONTENT "")
add_library(talus_library_headers OBJECT ${PROJECT_BINARY_DIR}/library_headers.cc)
target_link_libraries(talus_library_headers PRIVATE talus::compile_options Eigen3::Eigen)
target_precompile_headers(talus_library_headers PRIVATE
  <Eigen/Core> <algorithm> <array> <cmath> <functional> <limits> <memory> <optional> <span> <string> <utility>
  <vector>)

# talus_unite_folders(target sources… [TOGETHER "folders…"…]): the files of a folder are compiled together where
# CMAKE_UNITY_BUILD is on, in half of the time; so in their unnamed namespaces functions of one name must not take each
# other's arguments. TOGETHER: each a list of folders that are compiled at once, with all folders in them; a compiler
# takes up to 2 GB for it.
function(talus_unite_folders target)
  cmake_parse_arguments(ARG "" "" "TOGETHER" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  foreach(source ${ARG_UNPARSED_ARGUMENTS})
    get_filename_component(group ${source} DIRECTORY)
    foreach(together ${ARG_TOGETHER})
      string(REPLACE " " "|" any "${together}")
      if(source MATCHES "^(${any})/")
        string(REPLACE " " "_" group "${together}")
      endif()
    endforeach()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${group}_")
  endforeach()
endfunction()

# talus_add_library(name [PUBLIC_HEADERS ...] SOURCES ... [PUBLIC ...] [PRIVATE ...] [PRECOMPILED] [TOGETHER ...])
# PUBLIC_HEADERS are installed (docs/library.md). PRECOMPILED: with talus_library_headers. TOGETHER: as in
# talus_unite_folders.
function(talus_add_library name)
  cmake_parse_arguments(ARG "PRECOMPILED" "" "PUBLIC_HEADERS;SOURCES;PUBLIC;PRIVATE;TOGETHER" ${ARGN})
  add_library(talus_${name} STATIC ${ARG_SOURCES})
  add_library(talus::${name} ALIAS talus_${name})
  set_target_properties(talus_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(talus_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_sources(talus_${name}
    PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_PUBLIC_HEADERS})
  target_link_libraries(talus_${name} PUBLIC talus::compile_options ${ARG_PUBLIC}
    PRIVATE ${ARG_PRIVATE})
  if(ARG_PRECOMPILED)
    target_precompile_headers(talus_${name} REUSE_FROM talus_library_headers)
  endif()
  talus_unite_folders(talus_${name} ${ARG_SOURCES} TOGETHER ${ARG_TOGETHER})
  set_property(GLOBAL APPEND PROPERTY talus_libraries talus_${name})
endfunction()

if(TALUS_THREAD_SANITIZER)
  add_custom_target(tests_with_threads)
endif()

# What all tests have in common. Their own text is optimised little: what takes long to run is in the
# libraries. GCC 12 warns of its own std::string there, and where it comes out of a precompiled header.
add_library(talus_test_options INTERFACE)
target_include_directories(talus_test_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(talus_test_options INTERFACE TALUS_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
  TALUS_BINARY_DIR="${PROJECT_BINARY_DIR}")
target_compile_options(talus_test_options INTERFACE $<$<NOT:$<BOOL:${TALUS_SANITIZE}>>:-Og;-g0>
  -Wno-array-bounds -Wno-maybe-uninitialized -Wno-restrict -Wno-stringop-overflow)

# The suites of a test's file as a filter of GoogleTest, parameterised ones included. A file without is an error, since
# a filter that fits nothing would pass. So is a suite that another file of the same program has: each of the two tests
# would run both files' cases, and at the same time the same case would write one temporary folder twice.
function(talus_suites_of file target filter)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(STRINGS ${file} cases REGEX "^TEST(_F|_P)?[(]")
  list(TRANSFORM cases REPLACE "^TEST[_FP]*[(]([A-Za-z0-9]+).*" "\\1")
  list(REMOVE_DUPLICATES cases)
  if(NOT cases)
    message(FATAL_ERROR "${file} has no TEST, TEST_F or TEST_P at the start of a line")
  endif()
  get_target_property(others ${target} TALUS_SUITES)
  foreach(suite IN LISTS cases)
    if(suite IN_LIST others)
      message(SEND_ERROR "${file}: another file of ${target} has a suite ${suite}, too; rename one")
    endif()
  endforeach()
  set_property(TARGET ${target} APPEND PROPERTY TALUS_SUITES ${cases})
  list(TRANSFORM cases REPLACE "(.+)" "\\1.*:*/\\1.*")
  list(JOIN cases ":" joined)
  set(${filter} ${joined} PARENT_SCOPE)
endfunction()

# talus_add_test(folder/name_test libraries... [ALONE] [LABELS slow|slowest] [TIMEOUT seconds] [DEPENDS target])
# One CTest test from one file. Where CMAKE_UNITY_BUILD is on, the files of a folder are one program, since reading
# the headers is most of what a test costs to compile: so each file has a namespace and suites of its own. ALONE: a
# program of its own all the same. Label "slow" keeps it out of the quick part of the suite, which is to take two
# minutes, "slowest" out of what the address sanitizer's preset runs, too; label "threads" puts it into what the thread
# sanitizer's preset builds and runs.
function(talus_add_test path)
  cmake_parse_arguments(ARG "ALONE" "TIMEOUT" "LABELS;DEPENDS" ${ARGN})
  set(source ${PROJECT_SOURCE_DIR}/tests/${path}.cc)
  set(program ${path})
  if(CMAKE_UNITY_BUILD AND NOT ARG_ALONE)
    get_filename_component(program ${path} DIRECTORY)
    string(APPEND program _tests)
  endif()
  string(REPLACE "/" "_" target ${program})
  if(NOT TARGET ${target})
    add_executable(${target})
    set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 24)
    target_precompile_headers(${target} REUSE_FROM talus_test_headers)
    target_link_libraries(${target} PRIVATE GTest::gmock GTest::gtest_main talus_test_options)
  endif()
  target_sources(${target} PRIVATE ${source})
  target_link_libraries(${target} PRIVATE ${ARG_UNPARSED_ARGUMENTS})
  if(ARG_DEPENDS)
    add_dependencies(${target} ${ARG_DEPENDS})
  endif()
  if(TALUS_THREAD_SANITIZER AND "threads" IN_LIST ARG_LABELS)
    add_dependencies(tests_with_threads ${target})
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  if(TALUS_SANITIZE OR TALUS_THREAD_SANITIZER)
    math(EXPR ARG_TIMEOUT "5 * ${ARG_TIMEOUT}")
  endif()
  talus_suites_of(${source} ${target} filter)
  set(scratch ${PROJECT_BINARY_DIR}/scratch/${path})
  file(MAKE_DIRECTORY ${scratch})
  add_test(NAME ${path} COMMAND ${target} --gtest_filter=${filter})
  set_tests_properties(${path} PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "${ARG_LABELS}"
    # A temporary folder of its own; memory as the program sets it (experiments/app/main.cc).
    ENVIRONMENT "TEST_TMPDIR=${scratch};OMP_WAIT_POLICY=passive;MALLOC_MMAP_THRESHOLD_=33554432;\
MALLOC_TRIM_THRESHOLD_=268435456")
endfunction()
