// import chainreel._native

#include <exception>

#include "core/data_folder.hpp"
#include "app/report/version.hpp"
#include "core/error.hpp"
#include "python/binding.hpp"
#include "render/renderer_pins.hpp"

namespace py = pybind11;

namespace chainreel {
namespace {

// What the command line takes by a flag, a function takes by an argument.
std::string in_python(std::string message) {
  for (const auto& [flag, argument] : {std::pair<std::string, std::string>{"--force", "overwrite=True"}, {"with -o", "in its place"}})
    for (std::size_t at = message.find(flag); at != std::string::npos; at = message.find(flag, at + argument.size()))
      message.replace(at, flag.size(), argument);
  return message;
}

// As chainreel.Error, with each problem's place.
void raise(const Error& error) {
  if (error.code() == ExitCode::interrupted) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    return;
  }
  py::list problems;
  for (const Problem& problem : error.problems())
    problems.append(
        py::make_tuple(in_python(problem.message), problem.place.file, problem.place.line, problem.place.column));
  const py::object type = py::module_::import("chainreel._errors").attr("Error");
  const py::object raised = type(int(error.code()), problems);
  PyErr_SetObject(type.ptr(), raised.ptr());
}

}  // namespace
}  // namespace chainreel

PYBIND11_MODULE(_native, module) {
  chainreel::settle_environment();
  module.doc() = "What chainreel's Python package calls; use chainreel itself.";
  module.attr("version") = chainreel::program_version();
  module.attr("revision") = chainreel::program_revision();
  module.def("found_file", [](const std::string& named) { return chainreel::found_file(named); });
  module.def("found_elsewhere", &chainreel::found_elsewhere);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const chainreel::Error& error) {
      chainreel::raise(error);
    }
  });
  chainreel::bind_model(module);
  chainreel::bind_run(module);
}
