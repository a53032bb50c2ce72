#include "core/failure.h"

#include <exception>
#include <new>

namespace massprops {

std::string sentenceOfFailure() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "There is not enough memory for this model: use Remeshing, Simplification and "
           "Reconstruction > Simplification: Quadric Edge Collapse Decimation, then run again.";
  } catch (const std::exception& error) {
    return *error.what() != '\0' ? error.what() : "The optimisation failed without a message.";
  } catch (...) {
    return "The optimisation failed for an unknown reason.";
  }
}

} // namespace massprops
