// The C++ part of the Python module `talus`; python/talus/__init__.py is what users see.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "base/error.h"
#include "base/parallel_for.h"
#include "base/version.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/trials/simulate/run_folder.h"
#include "experiments/trials/simulate/simulate.h"
#include "imaging/formats/images/image_file.h"
#include "imaging/heap/metrics.h"
#include "imaging/spheres/projection.h"
#include "python/arrays.h"
#include "python/strategy.h"

namespace talus::python {
namespace {

namespace py = pybind11;

// Other Python threads run while it works, on no object of Python.
template <class Work>
auto Asleep(Work&& work) {
  const py::gil_scoped_release release;
  return work();
}

// Ctrl-C is Python's own error, which a loop over cases does not take for a failed one.
void Simulate(const std::string& file, const std::string& folder, bool fresh) {
  try {
    Asleep([&] {
      trials::Simulate(file, {.run = {.folder = folder, .fresh = fresh, .quiet = true}});
    });
  } catch (const base::Interrupted& interrupted) {
    PyErr_SetString(PyExc_KeyboardInterrupt, interrupted.what());
    throw py::error_already_set();
  }
}

GrayArray ReadImage(const std::string& file) {
  return ArrayOf(Asleep([&] { return imaging::ReadGrayImage(file); }));
}

GrayArray DecodeImage(const py::bytes& bytes) {
  const std::string text(bytes);
  return ArrayOf(Asleep([&] { return imaging::DecodeGrayImage(text, "the image"); }));
}

GrayArray Project(const py::object& spheres, const py::dict& frame, int num_views) {
  const imaging::Frame known = FrameOf(frame);
  const std::vector<base::Sphere> heap = SpheresOf(spheres, known.plate_diameter);
  return ArrayOf(Asleep([&] { return imaging::ProjectHeap(heap, known, num_views).image; }));
}

py::dict Compare(const py::object& heap, const py::object& reference, const py::dict& frame) {
  const imaging::Frame known = FrameOf(frame);
  const auto images = [&](const char* name, const py::object& array) {
    const imaging::GrayImage image = ImageOf(array, name);
    if (image.width != known.width || image.height != known.height) {
      throw base::ConfigError(std::string(name) + ": has " + std::to_string(image.width) + " x " +
                              std::to_string(image.height) + " px, its frame " +
                              std::to_string(known.width) + " x " + std::to_string(known.height));
    }
    return imaging::HeapImages{.profile = {.image = image, .frame = known}, .parts = {}};
  };
  const imaging::HeapImages one = images("heap", heap), other = images("reference", reference);
  py::dict metrics;
  for (const imaging::Metric& metric :
       Asleep([&] { return imaging::CompareProfiles(one, other); })) {
    if (metric.value.defined()) {
      metrics[py::str(metric.name)] = metric.value.value;
    } else {
      metrics[py::str(metric.name)] = py::none();
    }
  }
  return metrics;
}

}  // namespace
}  // namespace talus::python

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  using talus::python::Strategy;
  py::register_exception<talus::base::Error>(module, "Error", PyExc_RuntimeError).attr("__doc__") =
      "What went wrong while talus ran.";
  py::register_exception<talus::base::ConfigError>(module, "ConfigError", PyExc_ValueError)
      .attr("__doc__") = "Input that is not in order: what, where, and the remedy.";
  module.attr("__version__") = talus::base::Version();
  module.def("simulate", &talus::python::Simulate, py::arg("file"), py::arg("folder"),
             py::arg("fresh") = false);
  // A forked process has OpenMP's team without its threads, which a loop would wait for.
  module.def("stay_on_one_thread", [] { talus::base::SetMostLoopThreads(1); });
  module.def("is_worked_on", &talus::campaign::IsWorkedOn, py::arg("folder"));
  module.def("read_image", &talus::python::ReadImage, py::arg("file"));
  module.def("decode_image", &talus::python::DecodeImage, py::arg("bytes"));
  module.def("project", &talus::python::Project, py::arg("spheres"), py::arg("frame"),
             py::arg("num_views") = talus::imaging::kDefaultViews);
  module.def("compare", &talus::python::Compare, py::arg("heap"), py::arg("reference"),
             py::arg("frame"));
  py::class_<Strategy>(module, "Strategy")
      .def(py::init<const py::list&, const py::dict&, std::uint64_t, const py::object&, double>(),
           py::arg("parameters"), py::arg("options") = py::dict(), py::arg("seed") = 1,
           py::arg("target") = py::none(), py::arg("pixel_area") = 1.0)
      .def("ask", &Strategy::Ask, py::arg("count") = 1)
      .def("tell", &Strategy::Tell, py::arg("values"), py::arg("value") = py::none(),
           py::arg("image") = py::none(), py::arg("failed") = false)
      .def("stop_reason", &Strategy::StopReason)
      .def("answer", &Strategy::Answer);
}
