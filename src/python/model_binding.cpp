// chainreel._native.Model: the terms of a model's equation of motion.

#include <cmath>
#include <mutex>

#include "app/library/loaded_model.hpp"
#include "core/error.hpp"
#include "dynamics/effective_mass.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/kinematics.hpp"
#include "model/followers.hpp"
#include "python/binding.hpp"
#include "sim/instant.hpp"

namespace py = pybind11;

namespace chainreel {
namespace {

using Name = std::optional<std::string>;

Array array_of(const Eigen::MatrixXd& matrix) {
  Array result({matrix.rows(), matrix.cols()});
  auto view = result.mutable_unchecked<2>();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) view(i, j) = matrix(i, j);
  return result;
}

Array array_of(ConstVec values) {
  return Array(py::ssize_t(values.size()), values.data());
}

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ExitCode::usage, message);
}

Task task_of(const std::string& name) {
  if (name == "linear") return Task::linear;
  if (name == "full") return Task::full;
  refuse("task '" + name + "' is none of linear, full");
}

// A model with the one workspace that its algorithms write. Python's lock is held all along: a call takes microseconds.
class PythonModel {
 public:
  PythonModel(const std::string& path, std::optional<std::string> text, std::vector<std::string> overrides)
      : model_(load_model({path, std::move(text), std::move(overrides)})), ws_(chain()) {}

  const Chain& chain() const { return model_.chain; }

  Array M(const Array& q) {
    compute_mass_matrix(chain(), ws_, pose(q));
    return array_of(ws_.M);
  }
  Array C(const Array& q, const Array& qd) { return array_of(coriolis_matrix_of(chain(), pose(q), rates(qd, "qd"))); }
  Array nle(const Array& q, const Array& qd) {
    compute_nle(chain(), ws_, pose(q), rates(qd, "qd"));
    return array_of(ws_.nle);
  }
  Array gravity(const Array& q) {
    compute_gravity_torque(chain(), ws_, pose(q));
    return array_of(ws_.tau_g);
  }
  Array friction(const Array& qd) {
    compute_friction(chain(), ws_, rates(qd, "qd"));
    return array_of(ws_.tau_f);
  }
  Array forward(const Array& q, const Array& qd, const Array& tau) {
    compute_forward_dynamics(chain(), ws_, pose(q), rates(qd, "qd"), rates(tau, "tau"));
    return array_of(ws_.qdd);
  }
  Array inverse(const Array& q, const Array& qd, const Array& qdd) {
    compute_inverse_dynamics(chain(), ws_, pose(q), rates(qd, "qd"), rates(qdd, "qdd"));
    std::vector<double> tau = ws_.tau;
    compute_friction(chain(), ws_, rates(qd, "qd"));
    for (std::size_t i = 0; i < tau.size(); ++i) tau[i] += ws_.tau_f[i];
    return array_of(tau);
  }
  py::tuple energy(const Array& q, const Array& qd) {
    const Energy energy = energy_of(chain(), ws_, pose(q), rates(qd, "qd"));
    return py::make_tuple(energy.kinetic, energy.potential);
  }
  Array frame_pose_of(const Array& q, const Name& frame) {
    const std::vector<double> rest(std::size_t(chain().nv), 0.0);
    const int index = frame_of(frame);
    compute_kinematics(chain(), ws_, pose(q), rest);
    return array_of(frame_pose(chain(), ws_, index).matrix());
  }
  Array jacobian(const Array& q, const Name& frame, const std::string& task) {
    compute_jacobian(chain(), ws_, pose(q), frame_of(frame), task_of(task));
    return array_of(ws_.J);
  }
  Array basis(const std::string& task) const {
    const TaskBasis basis = task_basis(chain(), task_of(task));
    Eigen::MatrixXd rows(Eigen::Index(basis.directions.size()), 3);
    for (Eigen::Index r = 0; r < rows.rows(); ++r) rows.row(r) = basis.directions[std::size_t(r)];
    return array_of(rows);
  }
  Array Lambda_inv(const Array& q, const std::string& task) { return array_of(mass(q, task).Lambda_inv); }
  Array Lambda(const Array& q, const std::string& task) {
    const EffectiveMass effective = mass(q, task);
    if (!effective.Lambda)
      throw Error(ExitCode::numerical,
                  "Lambda is infinite at this pose, which is singular: Lambda_inv(q) is finite everywhere");
    return array_of(*effective.Lambda);
  }
  py::tuple mobility(const Array& q) {
    const EffectiveMass effective = mass(q, "linear");
    return py::make_tuple(array_of(ConstVec(effective.mobility.data(), std::size_t(effective.mobility.size()))),
                          array_of(effective.directions));
  }
  std::string ellipse(const Array& q, const std::string& reading, int width, int height) {
    const AskedEllipse asked = asked_ellipse(q, reading, width, height);
    const LongWork released;
    return ellipse_svg(model_, asked);
  }
  void save_ellipse(const Array& q, const std::string& reading, const std::string& path, bool overwrite, int width, int height) {
    const AskedEllipse asked = asked_ellipse(q, reading, width, height);
    const LongWork released;
    write_ellipse(model_, asked, path, overwrite);
  }

 private:
  AskedEllipse asked_ellipse(const Array& q, const std::string& reading, int width, int height) {
    const ConstVec numbers = pose(q);
    return {{{numbers.begin(), numbers.end()}}, reading, width, height};
  }
  ConstVec numbers(const Array& given, int count, const std::string& name) const {
    if (given.ndim() > 1 || int(given.size()) != count)
      refuse(name + " takes " + std::to_string(count) + (count == 1 ? " number" : " numbers") + " of " + chain().name +
             ", not " + (given.ndim() > 1 ? "an array of " + std::to_string(given.ndim()) + " dimensions"
                                          : std::to_string(given.size())) +
             (followers_of(chain()).empty() ? "" : "; " + followers_of(chain())));
    const ConstVec values(given.data(), std::size_t(given.size()));
    for (const double value : values)
      if (!std::isfinite(value)) refuse(name + " holds what is no finite number");
    return values;
  }
  ConstVec pose(const Array& q) const {
    const ConstVec values = numbers(q, chain().nq, "q");
    if (const std::string trouble = trouble_of_pose(chain(), values); !trouble.empty()) refuse(trouble);
    return values;
  }
  ConstVec rates(const Array& given, const char* name) const { return numbers(given, chain().nv, name); }
  int frame_of(const Name& name) const {
    if (!name) return require_end_effector(chain());
    const int frame = find_frame(chain(), *name);
    if (frame >= 0) return frame;
    std::vector<std::string> names;
    for (const Frame& one : chain().frames) names.push_back(one.name);
    refuse("the model has no link '" + *name + "'" + did_you_mean(*name, names));
  }
  EffectiveMass mass(const Array& q, const std::string& task) {
    require_end_effector(chain());
    return TipMass(chain()).at(ws_, pose(q), task_of(task));
  }

  LoadedModel model_;
  Workspace ws_;
};

std::vector<std::string> frame_names(const PythonModel& model) {
  std::vector<std::string> names;
  for (const Frame& frame : model.chain().frames) names.push_back(frame.name);
  return names;
}

Name end_effector(const PythonModel& model) {
  const Chain& chain = model.chain();
  return chain.end_effector < 0 ? Name() : chain.frames[std::size_t(chain.end_effector)].name;
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<PythonModel>(module, "Model")
      .def(py::init<std::string, std::optional<std::string>, std::vector<std::string>>())
      .def_property_readonly("name", [](const PythonModel& model) { return model.chain().name; })
      .def_property_readonly("nq", [](const PythonModel& model) { return model.chain().nq; })
      .def_property_readonly("nv", [](const PythonModel& model) { return model.chain().nv; })
      .def_property_readonly("joints", [](const PythonModel& model) { return model.chain().coordinate_names; })
      .def_property_readonly("frames", &frame_names)
      .def_property_readonly("end_effector", &end_effector)
      .def_property_readonly("g", [](const PythonModel& model) { return Array(3, model.chain().gravity.data()); })
      .def("M", &PythonModel::M)
      .def("C", &PythonModel::C)
      .def("nle", &PythonModel::nle)
      .def("gravity", &PythonModel::gravity)
      .def("friction", &PythonModel::friction)
      .def("forward", &PythonModel::forward)
      .def("inverse", &PythonModel::inverse)
      .def("energy", &PythonModel::energy)
      .def("pose", &PythonModel::frame_pose_of)
      .def("jacobian", &PythonModel::jacobian)
      .def("basis", &PythonModel::basis)
      .def("Lambda_inv", &PythonModel::Lambda_inv)
      .def("Lambda", &PythonModel::Lambda)
      .def("mobility", &PythonModel::mobility)
      .def("ellipse_svg", &PythonModel::ellipse, py::arg("q"), py::arg("reading"), py::arg("width") = 640,
           py::arg("height") = 480)
      .def("save_ellipse", &PythonModel::save_ellipse, py::arg("q"), py::arg("reading"), py::arg("path"), py::arg("overwrite"),
           py::arg("width") = 640, py::arg("height") = 480);
}

}  // namespace chainreel
