#pragma once
// Of a scene of 10,000 parts, a warning about each would fill the terminal.

#include "cli/console.hpp"

#include <map>
#include <string>

namespace facetmill::cli {

/// Tells errors and warnings. Of those that are alike (one id, one place in the pipeline) the first ten, and
/// how many more there are; with --log json all.
class WarningLimiter {
  public:
    explicit WarningLimiter(const Console& console) : console_(console) {}

    void tell(const Diagnostic& diagnostic);
    /// Tells what was left out so far, and begins anew.
    void finish();

  private:
    struct Kind {
        std::size_t count = 0;
        Diagnostic last;
    };
    const Console& console_;
    std::map<std::string, Kind>
        kinds_; ///< by severity, id and place; what --strict makes of warnings by theirs
};

} // namespace facetmill::cli
