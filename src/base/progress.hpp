#pragma once
// How far a run is: a bar on a terminal, nothing elsewhere. Algorithms do not know of it; the runner does.

#include <string>

namespace facetmill {

class Progress {
  public:
    virtual ~Progress() = default;
    /// A stage begins: number of number_of, and its name.
    virtual void stage(int number, int number_of, const std::string& name) = 0;
    virtual void done() = 0;
};

} // namespace facetmill
