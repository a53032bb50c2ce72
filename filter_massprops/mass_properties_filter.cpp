#include "filter_massprops/mass_properties_filter.h"

#include "core/failure.h"
#include "core/mesh/components.h"
#include "core/pipeline.h"
#include "core/vcg_conversion.h"
#include "filter_massprops/dialog_size.h"
#include "filter_massprops/escape.h"
#include "filter_massprops/parameters.h"
#include "filter_massprops/pymeshlab_names.h"

#include <QApplication>
#include <QMainWindow>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace massprops;

namespace {

constexpr FilterId kFilter = 0;
const char* const kName = "Mass Property Optimization";
const char* const kCavityLayer = "inner offset surface";

// Broken into lines here: the dialog of MeshLab 2020.09 reserves too little height for text that it
// has to wrap, and does not scroll.
const char* const kInfo =
    "<p style='white-space:pre'>"
    "Finds the cavity with which a model stands, spins, floats, hangs or rolls upright once it is\n"
    "printed: a new layer whose normals point into the cavity, so that both layers together bound\n"
    "the material. Its vertex quality is the wall thickness; the numbers are in the log.\n"
    "See <a href='https://doi.org/10.1145/2766955'>Musialski et al. 2015</a>, "
    "<a href='https://doi.org/10.1145/2461912.2461957'>Pr\u00e9vost et al. 2013</a>, "
    "<a href='https://doi.org/10.1145/2601097.2601157'>B\u00e4cher et al. 2014</a>, "
    "<a href='https://doi.org/10.1111/j.1467-8659.2012.03178.x'>Tagliasacchi et al. 2012</a>.</p>";

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

/// The layer's label without the suffix of its file. MeshLab's list of layers hides what comes
/// after the last dot of a label, hence there is none.
QString titleOf(const MeshModel& layer) {
  QString title = layer.label();
  const QString suffix = "." + layer.suffixName();
  if (suffix.size() > 1 && title.endsWith(suffix)) title.chop(suffix.size());
  return title.replace('.', '_');
}

/// Scripts have no window.
bool inMeshLabsWindow() {
  const QWidgetList windows = QApplication::topLevelWidgets();
  return std::any_of(windows.begin(), windows.end(), [](const QWidget* window) {
    return qobject_cast<const QMainWindow*>(window) != nullptr;
  });
}

/// What the dialog offers for the current layer. MeshLab asks for it just before it opens the
/// dialog.
RichParameterList dialogFor(const MeshDocument& document) {
  if (inMeshLabsWindow()) fitDialogToScreen(kName);
  // The document may be empty.
  const MeshModel* layer = document.mm();
  return dialogParameters(layer == nullptr ? 0.0 : diagonalOf(*layer));
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
    MeshModel* layer = append(surface, what);
    if (quality.size() > 0) {
      layer->updateDataMask(MeshModel::MM_VERTQUALITY);
      Eigen::Index v = 0;
      for (auto& vertex : layer->cm.vert) vertex.Q() = static_cast<Scalarm>(quality[v++]);
    }
    updateBoxAndNormals(*layer);
  }

  /// `isAnswer`: whether the window shows it at once.
  void add(const ColouredMesh& surface, const std::string& what, bool isAnswer = true) {
    if (surface.mesh.faces.rows() == 0) return;
    MeshModel* layer = append(surface.mesh, what);
    layer->updateDataMask(MeshModel::MM_VERTCOLOR);
    auto colour = surface.colours.begin();
    for (auto& vertex : layer->cm.vert) {
      vertex.C() = vcg::Color4b(colour->red, colour->green, colour->blue, 255);
      ++colour;
    }
    updateBoxAndNormals(*layer);
    if (isAnswer) pictures_.push_back(layer);
  }

  void keep() {
    kept_ = true;
    if (!added_.empty()) document_.setCurrentMesh(added_.back()->id());
  }

  /// The pictures alone or, without any, the last layer, which lies inside of the others.
  void showAnswerOnly() {
    document_.setVisible(input_.id(), false);
    for (std::size_t i = 0; i < added_.size(); ++i) {
      const bool isPicture =
          std::find(pictures_.begin(), pictures_.end(), added_[i]) != pictures_.end();
      const bool isLast = i + 1 == added_.size();
      document_.setVisible(added_[i]->id(), pictures_.empty() ? isLast : isPicture);
    }
  }

private:
  MeshModel* append(const TriangleMesh& surface, const std::string& what) {
    added_.reserve(added_.size() + 1);
    MeshModel* layer =
        document_.addNewMesh("", titleOf(input_) + " " + QString::fromStdString(what), false);
    added_.push_back(layer);
    toVcg(surface, placement_, layer->cm);
    layer->cm.Tr = input_.cm.Tr;
    return layer;
  }

  MeshDocument& document_;
  const MeshModel& input_;
  Placement placement_;
  std::vector<MeshModel*> added_;
  std::vector<const MeshModel*> pictures_;
  bool kept_ = false;
};

/// \throw InvalidInput when nothing is selected
TriangleMesh selectedPart(const TriangleMesh& model, const std::vector<int>& faces) {
  if (faces.empty()) {
    throw InvalidInput("No face is selected: select those that shall stay solid, with the tool "
                       "Select Faces in a rectangular region, say, or switch keep_selected_solid "
                       "off.");
  }
  return submesh(model.vertices, model.faces(faces, Eigen::all)).mesh;
}

Progress reporterTo(vcg::CallBackPos* callback) {
  if (callback == nullptr) return {};
  const std::shared_ptr<Escape> escape = inMeshLabsWindow() ? std::make_shared<Escape>() : nullptr;
  return [callback, escape](int percent, const char* stage) {
    const std::string shown = std::string(stage) + (escape ? " (Esc ends the run)\n" : "\n");
    const bool goesOn = callback(percent, shown.c_str());
    if (!goesOn || (escape && escape->isWanted()))
      throw std::runtime_error("The run was ended: nothing was added to the document.");
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

/// Why `run` throws; empty when it does not.
template <class Run>
std::string reasonOf(const Run& run) {
  try {
    run();
    return {};
  } catch (...) {
    return sentenceOfFailure();
  }
}

/// What the user reads when `run` throws; empty when it does not.
template <class Run>
std::string failureOf(const Run& run) {
  const std::string reason = reasonOf(run);
  return inMeshLabsWindow() ? reason : withPyMeshLabNames(reason);
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
  // A layer without faces is refused with a sentence that says what to do.
  return MeshModel::MM_NONE;
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
  return dialogFor(document);
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
  list.join(dialogFor(document));
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
  // It is the current layer after a run, and would be hollowed as a body.
  if (input->label().endsWith(kCavityLayer)) {
    throw InvalidInput("The current layer is a cavity that this filter has made: choose the "
                       "model's layer (PyMeshLab: set_current_mesh), then run again.");
  }
  const Placement placement = placementOf(*input);
  Options options = optionsFrom(parameters);
  options.representable = [&placement](const Points& world) {
    return representable<Scalarm>(world, placement);
  };

  const TriangleMesh model = fromVcg(input->cm, placement);
  if (parameters.getBool("keep_selected_solid")) {
    options.keptSolid = selectedPart(model, selectedFaces(input->cm));
  }

  const Result result = optimizeMassProperties(model, options, reporterTo(callback));

  NewLayers layers(document, *input);
  if (result.outer) layers.add(*result.outer, "outer offset surface");
  if (result.drilled) layers.add(*result.drilled, "with drain holes");
  if (result.plugs) layers.add(*result.plugs, "plugs");
  if (result.picture) {
    layers.add(result.picture->cutOpen, "cut open");
    layers.add(result.picture->marks, result.picture->marksName);
    layers.add(result.picture->skeleton, "skeleton and correspondences", false);
  }
  const bool hasCavity = result.inner.faces.rows() > 0;
  if (hasCavity) layers.add(result.inner, kCavityLayer, result.innerWall);
  layers.keep();

  ReturnedValues values;
  for (const auto& [key, value] : result.report.entries) {
    write(key + " = " + toString(value));
    const QVariant returned = std::visit(ToVariant{}, value);
    if (returned.isValid()) values[key] = returned;
  }
  if ((hasCavity || result.picture) && inMeshLabsWindow()) {
    layers.showAnswerOnly();
    write(result.picture
              ? "Only the answer is shown now: the model cut open, and the centre of mass before "
                "(red) and after (green). Before you flatten, hide these two layers and show the "
                "outer and the inner one by a click on their eyes. A further layer, hidden, is the "
                "skeleton."
              : "Only the cavity is shown now; Back-Face > Double lights it from outside. Before "
                "you flatten or cut open (Ctrl and mouse wheel), show the outer layer by a click "
                "on its eye.");
  }
  return values;
}
