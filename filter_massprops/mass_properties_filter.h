// The MeshLab filter "Mass Property Optimization": parameters → library → new layer and report.
#pragma once

#include "filter_massprops/meshlab_api.h"

#include <QObject>

// In the global namespace and without aliases in its macros, because Qt's meta-object compiler
// reads this text.
class MassPropertiesFilter : public QObject, public MASSPROPS_FILTER_BASE {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(MASSPROPS_FILTER_IID)
  Q_INTERFACES(MASSPROPS_FILTER_BASE)

public:
  MassPropertiesFilter();

  QString pluginName() const override;
  QString filterName(massprops::FilterId id) const override;
  QString filterInfo(massprops::FilterId id) const override;
  massprops::FilterArity filterArity(massprops::ActionPointer action) const override;
  int getPreConditions(massprops::ActionPointer action) const override;
  int postCondition(massprops::ActionPointer action) const override;

#if MASSPROPS_MESHLAB_API >= 2022
  QString vendor() const override;
  FilterClass getClass(const QAction* action) const override;
  RichParameterList initParameterList(const QAction* action, const MeshModel& mesh) override;
  RichParameterList initParameterList(const QAction* action, const MeshDocument& document) override;
  massprops::ReturnedValues applyFilter(const QAction* action, const RichParameterList& parameters,
                                        MeshDocument& document, unsigned int& postConditionMask,
                                        vcg::CallBackPos* callback) override;
#else
  FilterClass getClass(QAction* action) override;
  void initParameterSet(QAction* action, MeshModel& mesh, RichParameterList& list) override;
  void initParameterSet(QAction* action, MeshDocument& document, RichParameterList& list) override;
  bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                   vcg::CallBackPos* callback) override;
#endif

private:
  /// The run itself, the same for every host.
  /// \throw std::exception with a sentence for the user; the document is then as before
  massprops::ReturnedValues optimize(MeshDocument& document, const RichParameterList& parameters,
                                     vcg::CallBackPos* callback);
  void write(const std::string& line);
};
