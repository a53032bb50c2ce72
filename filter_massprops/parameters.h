// The dialog's parameters and what they mean to the library.
#pragma once

#include "core/base/options.h"
#include "filter_massprops/meshlab_api.h"

namespace massprops {

/// Every parameter under its fixed name, with defaults for a model of that bounding-box diagonal.
RichParameterList dialogParameters(double diagonal);

/// \throw InvalidInput for an entry outside of its list
Options optionsFrom(const RichParameterList& parameters);

} // namespace massprops
