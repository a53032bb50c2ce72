#include "filter_massprops/mass_properties_filter.h"

#include "core/pipeline.h"
#include "core/vcg_conversion.h"
#include "filter_massprops/parameters.h"

#include <cmath>
#include <exception>
#include <new>

using namespace massprops;

namespace {

constexpr FilterId kFilter = 0;
const char* const kName = "Mass Property Optimization";

const char* const kInfo =
    "Hollows a closed model so that its print stands, spins, floats, hangs or rolls upright: finds "
    "the cavity that brings centre "
    "of mass and moments of inertia to where the <b>goal</b> needs them, without touching the "
    "outer "
    "surface. Wall thickness, material and filling are given; the cavity is a new layer whose "
    "normals point into the cavity, so that both layers together (<i>Flatten Visible Layers</i>) "
    "bound the material. Its vertex quality is the wall thickness (<i>Colorize by vertex "
    "Quality</i>). The numbers before and after are written to the log.<br>"
    "The model must be closed, manifold and coherently oriented, and may have several parts; its "
    "existing cavities are replaced. Lengths are read as millimetres.<br><br>"
    "The offsets of the cavity from the surface towards its mean curvature skeleton are a "
    "combination of the lowest harmonics of the surface.<br>"
    "See:<br>"
    "<i>Przemyslaw Musialski, Thomas Auzinger, Michael Birsak, Michael Wimmer, Leif Kobbelt</i><br>"
    "<b>\"Reduced-Order Shape Optimization Using Offset Surfaces\"</b><br>"
    "ACM Transactions on Graphics, volume 34, issue 4, 2015. "
    "<a href='https://doi.org/10.1145/2766955'>doi:10.1145/2766955</a><br>"
    "<i>Romain Pr\u00e9vost, Emily Whiting, Sylvain Lefebvre, Olga Sorkine-Hornung</i><br>"
    "<b>\"Make It Stand: Balancing Shapes for 3D Fabrication\"</b><br>"
    "ACM Transactions on Graphics, volume 32, issue 4, 2013. "
    "<a href='https://doi.org/10.1145/2461912.2461957'>doi:10.1145/2461912.2461957</a><br>"
    "<i>Moritz B\u00e4cher, Emily Whiting, Bernd Bickel, Olga Sorkine-Hornung</i><br>"
    "<b>\"Spin-It: Optimizing Moment of Inertia for Spinnable Objects\"</b><br>"
    "ACM Transactions on Graphics, volume 33, issue 4, 2014. "
    "<a href='https://doi.org/10.1145/2601097.2601157'>doi:10.1145/2601097.2601157</a><br>"
    "<i>Andrea Tagliasacchi, Ibraheem Alhashim, Matt Olson, Hao Zhang</i><br>"
    "<b>\"Mean Curvature Skeletons\"</b><br>"
    "Computer Graphics Forum, volume 31, issue 5, 2012. "
    "<a href='https://doi.org/10.1111/j.1467-8659.2012.03178.x'>"
    "doi:10.1111/j.1467-8659.2012.03178.x</a>";

/// \throw InvalidInput when the layer's matrix is no invertible affine map
Placement placementOf(const MeshModel& layer) {
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      matrix(row, column) = static_cast<double>(layer.cm.Tr.ElementAt(row, column));
    }
  }
  const bool affine = matrix.row(3) == Eigen::RowVector4d(0, 0, 0, 1);
  const double volume = std::abs(matrix.topLeftCorner<3, 3>().determinant());
  const double size = matrix.topLeftCorner<3, 3>().norm();
  if (!affine || !matrix.allFinite() || !(volume > 1e-12 * size * size * size)) {
    throw InvalidInput("The layer's transformation matrix is not an invertible affine map: use "
                       "Normals, Curvatures and Orientation > Matrix: Reset Current Matrix, then "
                       "run again.");
  }
  return Placement(matrix);
}

double diagonalOf(const MeshModel& layer) {
  Placement placement;
  try {
    placement = placementOf(layer);
  } catch (const InvalidInput&) {
    placement.setIdentity();
  }
  Eigen::AlignedBox3d box;
  for (const auto& vertex : layer.cm.vert) {
    if (vertex.IsD()) continue;
    const auto& p = vertex.cP();
    box.extend(placement * Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]),
                                static_cast<double>(p[2])));
  }
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

double diagonalOfCurrentLayer(const MeshDocument& document) {
  // MeshLab asks for the parameters of an empty document, too.
  const MeshModel* layer = document.mm();
  return layer == nullptr ? 0.0 : diagonalOf(*layer);
}

/// Adds layers to a document and takes them away again when the rest fails.
class NewLayers {
public:
  NewLayers(MeshDocument& document, const MeshModel& input)
      : document_(document), input_(input), placement_(placementOf(input)) {}
  NewLayers(const NewLayers&) = delete;
  NewLayers& operator=(const NewLayers&) = delete;
  ~NewLayers() {
    if (kept_) return;
    for (MeshModel* layer : added_) removeLayer(document_, layer);
  }

  /// `quality`: a value for every vertex, or none.
  void add(const TriangleMesh& surface, const char* what, const Vector& quality = {}) {
    added_.reserve(added_.size() + 1);
    MeshModel* layer = document_.addNewMesh("", input_.label() + " " + what, false);
    added_.push_back(layer);
    toVcg(surface, placement_, layer->cm);
    layer->cm.Tr = input_.cm.Tr;
    if (quality.size() > 0) {
      layer->updateDataMask(MeshModel::MM_VERTQUALITY);
      Eigen::Index v = 0;
      for (auto& vertex : layer->cm.vert) vertex.Q() = static_cast<Scalarm>(quality[v++]);
    }
    updateBoxAndNormals(*layer);
  }

  void keep() {
    kept_ = true;
    if (!added_.empty()) document_.setCurrentMesh(added_.back()->id());
  }

private:
  MeshDocument& document_;
  const MeshModel& input_;
  Placement placement_;
  std::vector<MeshModel*> added_;
  bool kept_ = false;
};

Progress reporterTo(vcg::CallBackPos* callback) {
  if (callback == nullptr) return {};
  return [callback](int percent, const char* stage) {
    callback(percent, (std::string(stage) + "\n").c_str());
  };
}

struct ToVariant {
  QVariant operator()(bool value) const { return value; }
  QVariant operator()(int value) const { return value; }
  QVariant operator()(double value) const { return value; }
#if MASSPROPS_MESHLAB_API >= 2022
  QVariant operator()(const Vec3& value) const {
    return QVariant::fromValue(Point3m(static_cast<Scalarm>(value.x()),
                                       static_cast<Scalarm>(value.y()),
                                       static_cast<Scalarm>(value.z())));
  }
  QVariant operator()(const Mat3& value) const {
    Matrix33m matrix;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        matrix[row][column] = static_cast<Scalarm>(value(row, column));
      }
    }
    return QVariant::fromValue(matrix);
  }
  // PyMeshLab cannot take text.
  QVariant operator()(const std::string&) const {
    return {};
  }
#else
  // This host returns no values.
  template <class Value>
  QVariant operator()(const Value&) const {
    return {};
  }
#endif
};

/// What the user reads when `run` throws; empty when it does not.
template <class Run>
std::string failureOf(const Run& run) {
  try {
    run();
    return {};
  } catch (const std::bad_alloc&) {
    return "There is not enough memory for this model: use Remeshing, Simplification and "
           "Reconstruction > Simplification: Quadric Edge Collapse Decimation, then run again.";
  } catch (const std::exception& error) {
    return *error.what() != '\0' ? error.what() : "The optimisation failed without a message.";
  } catch (...) {
    return "The optimisation failed for an unknown reason.";
  }
}

} // namespace

MassPropertiesFilter::MassPropertiesFilter() {
  typeList.push_back(kFilter);
  actionList.push_back(new QAction(kName, this));
}

QString MassPropertiesFilter::pluginName() const {
  return "FilterMassProps";
}

QString MassPropertiesFilter::filterName(FilterId) const {
  return kName;
}

QString MassPropertiesFilter::filterInfo(FilterId) const {
  return QString::fromUtf8(kInfo);
}

FilterArity MassPropertiesFilter::filterArity(ActionPointer) const {
  return SINGLE_MESH;
}

int MassPropertiesFilter::getPreConditions(ActionPointer) const {
  return MeshModel::MM_FACENUMBER;
}

int MassPropertiesFilter::postCondition(ActionPointer) const {
  // A change of the numbers of elements keeps MeshLab from offering a preview.
  return MeshModel::MM_VERTNUMBER | MeshModel::MM_FACENUMBER;
}

#if MASSPROPS_MESHLAB_API >= 2022

QString MassPropertiesFilter::vendor() const {
  return "massprops";
}

FilterPlugin::FilterClass MassPropertiesFilter::getClass(const QAction*) const {
  return Remeshing;
}

RichParameterList MassPropertiesFilter::initParameterList(const QAction*, const MeshModel& mesh) {
  return dialogParameters(diagonalOf(mesh));
}

RichParameterList MassPropertiesFilter::initParameterList(const QAction*,
                                                          const MeshDocument& document) {
  return dialogParameters(diagonalOfCurrentLayer(document));
}

ReturnedValues MassPropertiesFilter::applyFilter(const QAction*,
                                                 const RichParameterList& parameters,
                                                 MeshDocument& document,
                                                 unsigned int& postConditionMask,
                                                 vcg::CallBackPos* callback) {
  postConditionMask = static_cast<unsigned int>(postCondition(nullptr));
  ReturnedValues values;
  const std::string failure = failureOf([&] { values = optimize(document, parameters, callback); });
  if (!failure.empty()) {
    write(failure);
    throw MLException(QString::fromStdString(failure));
  }
  return values;
}

void MassPropertiesFilter::write(const std::string& line) {
  log("%s", line.c_str());
}

#else

MeshFilterInterface::FilterClass MassPropertiesFilter::getClass(QAction*) {
  return Remeshing;
}

void MassPropertiesFilter::initParameterSet(QAction*, MeshModel& mesh, RichParameterList& list) {
  list.join(dialogParameters(diagonalOf(mesh)));
}

void MassPropertiesFilter::initParameterSet(QAction*, MeshDocument& document,
                                            RichParameterList& list) {
  list.join(dialogParameters(diagonalOfCurrentLayer(document)));
}

bool MassPropertiesFilter::applyFilter(QAction*, MeshDocument& document,
                                       const RichParameterList& parameters,
                                       vcg::CallBackPos* callback) {
  const std::string failure = failureOf([&] { optimize(document, parameters, callback); });
  if (failure.empty()) return true;
  // meshlabserver prints the log, but not the message.
  errorMessage = QString::fromStdString(failure);
  write(failure);
  return false;
}

void MassPropertiesFilter::write(const std::string& line) {
  Log("%s", line.c_str());
}

#endif

ReturnedValues MassPropertiesFilter::optimize(MeshDocument& document,
                                              const RichParameterList& parameters,
                                              vcg::CallBackPos* callback) {
  const MeshModel* input = document.mm();
  if (input == nullptr) {
    throw InvalidInput("There is no layer to work on: open a closed triangle mesh with File > "
                       "Import Mesh, then run again.");
  }
  const Placement placement = placementOf(*input);
  Options options = optionsFrom(parameters);
  options.representable = [&placement](const Points& world) {
    return representable<Scalarm>(world, placement);
  };

  const Result result =
      optimizeMassProperties(fromVcg(input->cm, placement), options, reporterTo(callback));

  NewLayers layers(document, *input);
  if (result.outer) layers.add(*result.outer, "outer offset surface");
  if (result.inner.faces.rows() > 0) {
    layers.add(result.inner, "inner offset surface", result.innerWall);
  }
  layers.keep();

  ReturnedValues values;
  for (const auto& [key, value] : result.report.entries) {
    write(key + " = " + toString(value));
    const QVariant returned = std::visit(ToVariant{}, value);
    if (returned.isValid()) values[key] = returned;
  }
  return values;
}
