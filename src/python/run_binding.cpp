// chainreel._native.SceneRun: a scene that is run, its numbers as views of the run's own memory.

#include <algorithm>
#include <memory>

#include "app/library/scene_run.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "python/binding.hpp"

namespace py = pybind11;

namespace chainreel {
namespace {

// A Python object that is let go with Python's lock held, whichever thread does it.
std::shared_ptr<py::object> kept(py::object object) {
  return {new py::object(std::move(object)), [](py::object* held) {
            const py::gil_scoped_acquire lock;
            delete held;
          }};
}

Array copied(std::span<const double> values) {
  return Array(py::ssize_t(values.size()), values.data());
}

// What a function gave that is no torque, and what it is to give.
std::string refusal(const std::string& words, const std::string& gave, double t, std::size_t freedoms) {
  return words + " gave " + gave + " at t = " + format_shortest(t) + " s: return " + std::to_string(freedoms) +
         (freedoms == 1 ? " number" : " numbers, one a freedom") + " in the order of qd, N m or N";
}

OwnTorque torque_of(py::object function, std::string words, std::string name) {
  OwnTorque torque;
  torque.words = words;
  torque.name = std::move(name);
  torque.function = [held = kept(std::move(function)), words = std::move(words)](double t, std::span<const double> q, std::span<const double> qd,
                                                       std::span<double> tau) {
    const py::gil_scoped_acquire lock;
    const py::object answer = (*held)(t, copied(q), copied(qd));
    if (answer.is_none()) throw py::type_error(refusal(words, "nothing (None)", t, tau.size()));
    const Array given = Array::ensure(answer);
    if (!given) {
      PyErr_Clear();
      throw py::type_error(refusal(words, "what are no numbers (" + std::string(py::str(py::type::of(answer).attr("__name__"))) + ")", t, tau.size()));
    }
    if (given.ndim() > 1) throw py::value_error(refusal(words, "an array of " + std::to_string(given.ndim()) + " dimensions", t, tau.size()));
    if (std::size_t(given.size()) != tau.size())
      throw py::value_error(refusal(words, std::to_string(given.size()) + (given.size() == 1 ? " number" : " numbers"), t, tau.size()));
    std::copy(given.data(), given.data() + given.size(), tau.begin());
  };
  return torque;
}

// Rows of `columns` numbers; `owner` lives as long as the view.
py::array view(const std::vector<double>& values, int columns, const py::object& owner) {
  const py::ssize_t width = columns, rows = py::ssize_t(values.size()) / width;
  Array array({rows, width}, values.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array view(const std::vector<double>& values, const py::object& owner) {
  Array array({py::ssize_t(values.size())}, {py::ssize_t(sizeof(double))}, values.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

const SceneRun& run_of(const py::object& self) {
  return self.cast<const SceneRun&>();
}

const Trajectory& trajectory_of(const py::object& self, int panel) {
  return run_of(self).trajectory(panel);
}

// In their order of time: name, s.
py::list events_of(const py::object& self, int panel) {
  const Trajectory& run = trajectory_of(self, panel);
  const std::vector<std::string> names = run_of(self).event_names(panel);
  py::list events;
  for (int k = 0; k < run.events.size(); ++k)
    events.append(py::make_tuple(names.at(std::size_t(run.events.event[std::size_t(k)])), run.events.t[std::size_t(k)]));
  return events;
}

template <class Work>
auto without_lock(Work&& work) {
  const LongWork released;
  return work();
}

std::unique_ptr<SceneRun> run_scene(std::string path, std::optional<std::string> text, std::vector<std::string> overrides,
                                    py::object torque, std::string words, std::string name, std::vector<double> times) {
  SceneRequest request{std::move(path), std::move(text), std::move(overrides), {}};
  if (!torque.is_none()) request.torque = torque_of(std::move(torque), std::move(words), std::move(name));
  return without_lock([&] { return std::make_unique<SceneRun>(std::move(request), std::move(times)); });
}

py::tuple film_of_run(const SceneRun& run, std::vector<std::string> files, double at, int jobs, bool overwrite) {
  const FilmFiles made = without_lock([&] { return run.film({std::move(files), at, jobs, overwrite}); });
  return py::make_tuple(made.files, made.sidecars, made.notes, made.frames, made.seconds);
}

// Arrays by their names, (rows, ...).
py::dict table_of_run(const SceneRun& run, const std::string& columns, int panel) {
  const std::vector<RunArray> arrays = without_lock([&] { return run.table(columns, panel); });
  py::dict table;
  for (const RunArray& one : arrays) {
    std::size_t numbers = 1;
    for (const std::size_t size : one.shape) numbers *= size;
    std::vector<py::ssize_t> shape{numbers == 0 ? 0 : py::ssize_t(one.values.size() / numbers)};
    shape.insert(shape.end(), one.shape.begin(), one.shape.end());
    py::array_t<double> array(shape);
    std::copy(one.values.begin(), one.values.end(), array.mutable_data());
    table[py::str(one.name)] = array;
  }
  return table;
}

// (height, width, 4), RGBA; and notes.
py::tuple pixels(const SceneRun& run, double at, int width, int height) {
  std::vector<std::string> notes;
  const Image image = without_lock([&] { return run.frame(at, width, height, &notes); });
  py::array_t<std::uint8_t> array({py::ssize_t(image.height), py::ssize_t(image.width), py::ssize_t(4)});
  std::uint8_t* to = array.mutable_data();
  for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
    to[i] = image.bgra[i + 2];
    to[i + 1] = image.bgra[i + 1];
    to[i + 2] = image.bgra[i];
    to[i + 3] = image.bgra[i + 3];
  }
  return py::make_tuple(array, notes);
}

}  // namespace

void bind_run(py::module_& module) {
  py::class_<SceneRun>(module, "SceneRun")
      .def(py::init(&run_scene))
      .def_property_readonly("panels", &SceneRun::panels)
      .def_property_readonly("name", &SceneRun::name)
      .def_property_readonly("effective_scene", &SceneRun::effective_scene)
      .def("warnings", [](const SceneRun& run) { return without_lock([&] { return run.warnings(); }); })
      .def("title", [](const SceneRun& run, int panel) { return run.title(panel); })
      .def("report", [](const SceneRun& run, int panel) { return without_lock([&] { return run.report(panel); }); })
      .def("status", [](const py::object& self, int panel) { return to_string(trajectory_of(self, panel).status); })
      .def("events", &events_of)
      .def("t", [](const py::object& self, int panel) { return view(trajectory_of(self, panel).t, self); })
      .def("q", [](const py::object& self, int panel) {
        return view(trajectory_of(self, panel).q, trajectory_of(self, panel).nq, self);
      })
      .def("qd", [](const py::object& self, int panel) {
        return view(trajectory_of(self, panel).qd, trajectory_of(self, panel).nv, self);
      })
      .def("work", [](const py::object& self, int panel) { return view(trajectory_of(self, panel).work, self); })
      .def("tau", [](const py::object& self, int panel) {
        const SceneRun& run = run_of(self);
        return view(*without_lock([&] { return &run.torques(panel); }), run.trajectory(panel).nv, self);
      })
      .def("energy", [](const py::object& self, int panel, const std::string& part) {
        const SceneRun& run = run_of(self);
        const EnergyCourse& energy = *without_lock([&] { return &run.energy(panel); });
        const std::vector<double>& values = part == "kinetic"     ? energy.kinetic
                                            : part == "potential" ? energy.potential
                                            : part == "error"     ? energy.error
                                                                  : energy.total;
        return view(values, self);
      })
      .def("table", &table_of_run)
      .def("film", &film_of_run)
      .def("frame", &pixels)
      .def("picture", [](const SceneRun& run, double at, const std::string& path, bool overwrite) {
        std::vector<std::string> notes;
        without_lock([&] { run.picture(at, path, overwrite, &notes); });
        return notes;
      });
}

}  // namespace chainreel
