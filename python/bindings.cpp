// The module massprops._massprops: NumPy arrays in and out. What Python's users see is in
// massprops/__init__.py.
#include "core/base/parallel.h"
#include "core/goals/registry.h"
#include "core/mesh/components.h"
#include "core/parameter_text.h"
#include "core/parameters.h"
#include "core/pipeline.h"

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>

namespace py = pybind11;

namespace {

using namespace massprops;

double diagonalOf(const Points& points) {
  if (points.rows() == 0) return 0.0;
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

[[noreturn]] void refuse(const Parameter& parameter, const py::handle& value) {
  throw InvalidInput("The parameter '" + parameter.name + "' cannot be " +
                     py::repr(value).cast<std::string>() + ".");
}

/// Texts stand for lengths in % and for entries, and Python's numbers for numbers.
ParameterValue valueFrom(const Parameter& parameter, const py::handle& value, double diagonal) {
  if (py::isinstance<py::str>(value)) {
    return massprops::valueFrom(parameter, value.cast<std::string>(), diagonal);
  }
  try {
    switch (parameter.kind) {
    case ParameterKind::Switch:
      if (!py::isinstance<py::bool_>(value)) break;
      return value.cast<bool>();
    case ParameterKind::Whole:
    case ParameterKind::Choice:
      return value.cast<int>();
    case ParameterKind::Number:
    case ParameterKind::Share:
    case ParameterKind::Length:
      return value.cast<double>();
    case ParameterKind::File:
      return py::str(value).cast<std::string>();
    }
  } catch (const py::cast_error&) {
    // Refused below.
  }
  refuse(parameter, value);
}

Options optionsOf(const py::dict& given, double diagonal) {
  return optionsFrom([&](const Parameter& parameter) -> std::optional<ParameterValue> {
    const py::str name(parameter.name);
    if (!given.contains(name) || given[name].is_none()) return {};
    return valueFrom(parameter, given[name], diagonal);
  });
}

/// Calls back with the interpreter's lock; throws where Python raises: an exception of the
/// callback, or Ctrl-C.
Progress reporterTo(const py::object& callback) {
  return [&callback](int percent, const char* stage) {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!callback.is_none()) callback(percent, stage);
  };
}

struct ReportToPython {
  template <class Value>
  py::object operator()(const Value& value) const {
    return py::cast(value);
  }
};

py::dict toPython(const Report& report) {
  py::dict result;
  for (const auto& [key, value] : report.entries) {
    result[py::str(key)] = std::visit(ReportToPython{}, value);
  }
  return result;
}

py::tuple toPython(const TriangleMesh& mesh) {
  return py::make_tuple(mesh.vertices, mesh.faces);
}

py::tuple toPython(const std::string& name, const ColouredMesh& mesh) {
  Eigen::Matrix<unsigned char, Eigen::Dynamic, 3, Eigen::RowMajor> colours(
      static_cast<Eigen::Index>(mesh.colours.size()), 3);
  Eigen::Index v = 0;
  for (const Colour& c : mesh.colours) colours.row(v++) << c.red, c.green, c.blue;
  return py::make_tuple(name, mesh.mesh.vertices, mesh.mesh.faces, colours);
}

py::list picturesOf(const Result& result) {
  py::list pictures;
  if (!result.picture) return pictures;
  pictures.append(toPython("cut open", result.picture->cutOpen));
  pictures.append(toPython(result.picture->marksName, result.picture->marks));
  pictures.append(toPython("skeleton and correspondences", result.picture->skeleton));
  return pictures;
}

Points asFloats(const Points& points) {
  return points.cast<float>().cast<double>();
}

/// A model as Python's users have it.
class PythonModel {
public:
  PythonModel(const Points& vertices, const Faces& faces, bool singlePrecision)
      : mesh_{singlePrecision ? asFloats(vertices) : vertices, faces},
        singlePrecision_(singlePrecision), model_(mesh_) {}

  py::tuple hollow(const py::dict& parameters, const std::vector<int>& keptFaces,
                   const py::object& callback) {
    Options options = optionsOf(parameters, diagonalOf(mesh_.vertices));
    if (singlePrecision_) options.representable = asFloats;
    if (!keptFaces.empty()) {
      options.keptSolid = submesh(mesh_.vertices, mesh_.faces(keptFaces, Eigen::all)).mesh;
    }
    Result result;
    {
      const py::gil_scoped_release unlocked;
      result = model_.run(options, reporterTo(callback));
    }
    const auto orNone = [](const std::optional<TriangleMesh>& mesh) {
      return mesh ? py::object(toPython(*mesh)) : py::object(py::none());
    };
    return py::make_tuple(toPython(result.inner), result.innerWall, orNone(result.outer),
                          orNone(result.drilled), orNone(result.plugs), picturesOf(result),
                          toPython(result.report));
  }

private:
  TriangleMesh mesh_;
  bool singlePrecision_;
  Model model_;
};

const char* typeOf(ParameterKind kind) {
  switch (kind) {
  case ParameterKind::Switch:
    return "bool";
  case ParameterKind::Whole:
    return "int";
  case ParameterKind::Number:
  case ParameterKind::Share:
    return "float";
  case ParameterKind::Length:
    return "float | str";
  case ParameterKind::Choice:
  case ParameterKind::File:
    return "str";
  }
  return "";
}

py::list parameters() {
  py::list rows;
  for (const Parameter& parameter : parameterTable()) {
    py::object standard = py::cast(parameter.standard);
    if (parameter.kind == ParameterKind::Choice) {
      standard =
          py::cast(parameter.entries[static_cast<std::size_t>(std::get<int>(parameter.standard))]);
    } else if (parameter.kind == ParameterKind::Length) {
      const double share = std::get<double>(parameter.standard);
      standard = share == 0.0 ? standard : py::cast(toString(100.0 * share) + "%");
    }
    std::vector<std::string> goals;
    for (const GoalKind goal : parameter.goals) goals.push_back(goalEntry(goal).name);
    using namespace py::literals;
    rows.append(py::dict("name"_a = parameter.name, "type"_a = typeOf(parameter.kind),
                         "default"_a = standard, "label"_a = parameter.label,
                         "unit"_a = parameter.unit, "help"_a = parameter.help,
                         "entries"_a = parameter.entries, "goals"_a = goals,
                         "category"_a = parameter.category, "advanced"_a = parameter.advanced));
  }
  return rows;
}

} // namespace

PYBIND11_MODULE(_massprops, module) {
  py::register_exception<InvalidInput>(module, "InvalidInput", PyExc_ValueError);
  module.attr("__version__") = MASSPROPS_VERSION;
  py::class_<PythonModel>(module, "Model")
      .def(py::init<const Points&, const Faces&, bool>())
      .def("hollow", &PythonModel::hollow);
  module.def("parameters", parameters);
  module.def("set_thread_count", setThreadCount);
}
