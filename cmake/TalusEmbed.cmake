# Text files that a program carries inside itself. Included by the build for talus_embed(), and run as
# a script (cmake -P) for each file.

# talus_embed(target header namespace FILES…) makes `header` with one std::string_view a file, named
# after it: page.html → kPageHtml.
function(talus_embed target header namespace)
  set(sources "")
  set(declarations "")
  foreach(file ${ARGN})
    get_filename_component(name ${file} NAME)
    string(REGEX REPLACE "[._-]" ";" parts ${name})
    set(constant k)
    foreach(part ${parts})
      string(SUBSTRING ${part} 0 1 first)
      string(SUBSTRING ${part} 1 -1 rest)
      string(TOUPPER ${first} first)
      string(APPEND constant ${first}${rest})
    endforeach()
    set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cc)
    add_custom_command(OUTPUT ${source}
      COMMAND ${CMAKE_COMMAND} -DINPUT=${file} -DOUTPUT=${source} -DCONSTANT=${constant}
              -DNAMESPACE=${namespace} -P ${PROJECT_SOURCE_DIR}/cmake/TalusEmbed.cmake
      DEPENDS ${file} ${PROJECT_SOURCE_DIR}/cmake/TalusEmbed.cmake VERBATIM)
    list(APPEND sources ${source})
    string(APPEND declarations "extern const std::string_view ${constant};\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/embedded/${header} CONTENT
"#pragma once

#include <string_view>

namespace @namespace@ {
@declarations@}
" @ONLY)
  target_sources(${target} PRIVATE ${sources})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/embedded)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  file(READ ${INPUT} content)
  file(SIZE ${INPUT} size)
  file(WRITE ${OUTPUT} "#include <string_view>

namespace ${NAMESPACE} {
constexpr char kText[] = R\"talus_file(${content})talus_file\";
static_assert(sizeof kText == ${size} + 1, \"a text file, whole\");
extern const std::string_view ${CONSTANT};
const std::string_view ${CONSTANT}(kText, ${size});
}  // namespace
")
endif()
