#pragma once
// Where words go: results to standard output, everything else to standard error, as text or as JSON lines.

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/progress.hpp"
#include "base/text/markup.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace facetmill::cli {

/// Writes a result to standard output. Throws output (E-WRITE) when that fails, so that a full disk is no
/// success.
void print(std::string_view text);
/// The same for people, in whose terminal no control character of a name may get.
void show(std::string_view text);

/// The share of a stage that was done when it was told last (0: it was not), seconds after the stage began.
struct PrintedMessage {
    double share = 0, seconds = 0;
};

/// Behind the name of a stage that has run for some seconds: " 42 %, about 12 s left", ", 12 s" where no
/// share was told; nothing in its first second.
std::string how_far(double seconds, const PrintedMessage& last);

/// What goes to standard error.
class Console {
  public:
    bool quiet = false;   ///< only warnings and errors
    bool verbose = false; ///< also what was resolved, and every stage
    bool json = false;    ///< one JSON object per line

    /// Whether standard error is a terminal that takes colours (NO_COLOR and TERM=dumb are respected).
    bool colour() const;
    void diagnostic(const Diagnostic& diagnostic) const;
    void diagnostics(const Error& error) const;
    /// For people, without control characters of names; left out with quiet. In JSON: {"level": "info",
    /// "message": ...}.
    void say(std::string_view text) const;
    /// The same with colours; not for JSON.
    void say(const Painted& text) const;
    /// The same for programs: an object of its own, only with --log json.
    void event(const Json& object) const;
    /// Whether a line may be drawn anew to show progress: on a terminal, unless messages are lines or JSON.
    bool redraws() const;
    /// A bar on a terminal, lines with verbose, else null.
    std::unique_ptr<Progress> progress() const;
};

} // namespace facetmill::cli
