// Prints the dialog's parameters for a model of the given bounding-box diagonal, one a line, fields
// separated by tabs: name, label, tooltip.
#include "filter_massprops/parameters.h"

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  const RichParameterList list = massprops::dialogParameters(argc > 1 ? std::atof(argv[1]) : 1.0);
  for (const RichParameter& parameter : list) {
    std::cout << parameter.name().toStdString() << '\t'
              << parameter.fieldDescription().toStdString() << '\t'
              << parameter.toolTip().toStdString() << '\n';
  }
}
