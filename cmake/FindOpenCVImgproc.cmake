# OpenCV's image processing alone, as OpenCV::imgproc. OpenCV's own configuration asks for all modules; on Debian they
# bring some 260 packages more (VTK, GDAL, Qt), which talus does not use.
#
# Linked into the program where that is possible: the shared libraries bring those of X11 and OpenGL along, and to load
# them takes as long as the rest of a start, of which a campaign has one for each trial.
find_path(OpenCVImgproc_INCLUDE_DIR opencv2/imgproc.hpp PATH_SUFFIXES opencv4)
find_library(OpenCVImgproc_STATIC_LIBRARY libopencv_imgproc.a)
find_library(OpenCVImgproc_STATIC_CORE_LIBRARY libopencv_core.a)
set(OpenCVImgproc_needs "")  # of the static libraries
foreach(name tbb lapack cblas z)
  find_library(OpenCVImgproc_${name}_LIBRARY ${name})
  mark_as_advanced(OpenCVImgproc_${name}_LIBRARY)
  list(APPEND OpenCVImgproc_needs "${OpenCVImgproc_${name}_LIBRARY}")
endforeach()
if(OpenCVImgproc_STATIC_LIBRARY AND OpenCVImgproc_STATIC_CORE_LIBRARY AND NOT OpenCVImgproc_needs MATCHES "NOTFOUND")
  set(OpenCVImgproc_LIBRARY ${OpenCVImgproc_STATIC_LIBRARY})
  set(OpenCVImgproc_CORE_LIBRARY ${OpenCVImgproc_STATIC_CORE_LIBRARY} ${OpenCVImgproc_needs})
else()
  find_library(OpenCVImgproc_LIBRARY opencv_imgproc)
  find_library(OpenCVImgproc_CORE_LIBRARY opencv_core)
endif()
mark_as_advanced(OpenCVImgproc_INCLUDE_DIR OpenCVImgproc_LIBRARY OpenCVImgproc_CORE_LIBRARY
  OpenCVImgproc_STATIC_LIBRARY OpenCVImgproc_STATIC_CORE_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVImgproc
  REQUIRED_VARS OpenCVImgproc_LIBRARY OpenCVImgproc_CORE_LIBRARY OpenCVImgproc_INCLUDE_DIR)

if(OpenCVImgproc_FOUND AND NOT TARGET OpenCV::imgproc)
  add_library(OpenCV::imgproc UNKNOWN IMPORTED)
  set_target_properties(OpenCV::imgproc PROPERTIES
    IMPORTED_LOCATION "${OpenCVImgproc_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OpenCVImgproc_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${OpenCVImgproc_CORE_LIBRARY}")
  if(OpenCVImgproc_STATIC_LIBRARY AND OpenCVImgproc_LIBRARY STREQUAL OpenCVImgproc_STATIC_LIBRARY)
    # OpenCV's way to textures of OpenGL, which nothing here takes.
    foreach(function GetProcAddressARB GetCurrentDisplay GetCurrentContext)
      set_property(TARGET OpenCV::imgproc APPEND PROPERTY INTERFACE_LINK_OPTIONS "LINKER:--defsym=glX${function}=0")
    endforeach()
  endif()
endif()
