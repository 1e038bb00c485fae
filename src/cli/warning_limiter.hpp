#pragma once
// Limits similar warnings, because a scene of 10,000 parts would fill the terminal.

#include "cli/console.hpp"

#include <map>
#include <string>

namespace facetmill::cli {

/// Prints errors and warnings. If warnings are similar (same id, same position in the pipeline), it prints
/// the first ten and the number of the others. With --log json, it prints all.
class WarningLimiter {
  public:
    explicit WarningLimiter(const Console& console) : console_(console) {}

    void tell(const Diagnostic& diagnostic);
    /// Prints the counts of omitted warnings, and starts over.
    void finish();

  private:
    struct Kind {
        std::size_t count = 0;
        Diagnostic last;
    };
    const Console& console_;
    std::map<std::string, Kind>
        kinds_; ///< by severity, id and place; errors from --strict by the place of their warnings
};

} // namespace facetmill::cli
