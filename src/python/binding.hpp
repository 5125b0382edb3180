// What the parts of the Python module share.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "app/cli/streams.hpp"

namespace chainreel {

using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

void bind_model(pybind11::module_& module);
void bind_run(pybind11::module_& module);

// Long work: without Python's lock, so that other threads go on; in the main thread Ctrl-C ends it, as the signal's Error.
class LongWork {
 public:
  LongWork() {
    const pybind11::module_ threading = pybind11::module_::import("threading");
    if (threading.attr("current_thread")().is(threading.attr("main_thread")())) watch_.emplace();
    released_.emplace();
  }

 private:
  std::optional<InterruptWatch> watch_;
  std::optional<pybind11::gil_scoped_release> released_;
};

}  // namespace chainreel
