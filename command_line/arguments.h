// What is asked for on the command line.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace massprops {

/// Files to write, empty where none is asked for. `{name}` stands for the model's name without its
/// folder and suffix.
struct Outputs {
  std::string cavity;
  std::string solid;  ///< outer and inner surface together, joined by drain holes
  std::string plugs;  ///< of drain holes
  std::string answer; ///< the model cut open and what it is judged by, in colours
  std::string report; ///< JSON; `-` is the standard output
};

struct Arguments {
  std::vector<std::string> models;
  Outputs outputs;
  std::map<std::string, std::string> given; ///< parameter's name → text
  int jobs = 1;
  bool quiet = false;
  std::string describe; ///< a form of description.h, instead of a run
};

/// The end of the program that parsing itself asks for: help, version, or a mistake.
struct ParsedEnd {
  int exitStatus;
};

/// Prints help and mistakes. \throw ParsedEnd
Arguments parse(int argc, const char* const* argv);

/// An option as the help has it.
struct OptionHelp {
  std::string names;       ///< -o,--cavity
  std::string placeholder; ///< FILE; empty for a switch
  std::string help;
  std::string heading;
};

/// What `massprops` is, and all of its options in the order of the help.
std::string programSummary();
std::string programNotes();
std::vector<OptionHelp> programOptions();

/// The option of a parameter: inner_lower_bound → --inner-lower-bound.
std::string optionOf(const std::string& parameterName);

} // namespace massprops
