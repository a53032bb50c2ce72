// The names in which MeshLab's plugin interfaces differ, one generation each. The build says which
// generation (cmake/MeshLab.cmake).
#pragma once

#if MASSPROPS_MESHLAB_API >= 2022
#include <common/plugins/interfaces/filter_plugin.h>
#define MASSPROPS_FILTER_BASE FilterPlugin
#define MASSPROPS_FILTER_IID FILTER_PLUGIN_IID
#else
#include <common/interfaces.h>
#define MASSPROPS_FILTER_BASE MeshFilterInterface
#define MASSPROPS_FILTER_IID MESH_FILTER_INTERFACE_IID
#endif

#include <map>
#include <string>

namespace massprops {

/// Absolute length or percentage of a range; stored as an absolute length.
using RichLength = MASSPROPS_MESHLAB_PERCENTAGE;
/// A file to write to.
using RichFile = MASSPROPS_MESHLAB_FILE;
using ReturnedValues = std::map<std::string, QVariant>;

#if MASSPROPS_MESHLAB_API >= 2022
using FilterId = FilterPlugin::ActionIDType;
using FilterArity = FilterPlugin::FilterArity;
using ActionPointer = const QAction*;

inline void updateBoxAndNormals(MeshModel& layer) {
  layer.updateBoxAndNormals();
}
inline void removeLayer(MeshDocument& document, MeshModel* layer) {
  document.delMesh(layer->id());
}
#else
using FilterId = MeshFilterInterface::FilterIDType;
using FilterArity = MeshFilterInterface::FILTER_ARITY;
using ActionPointer = QAction*;

inline void updateBoxAndNormals(MeshModel& layer) {
  layer.UpdateBoxAndNormals();
}
inline void removeLayer(MeshDocument& document, MeshModel* layer) {
  document.delMesh(layer);
}
#endif

} // namespace massprops
