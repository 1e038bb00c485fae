#pragma once
// Program output: results to standard output, everything else to standard error, as text or as JSON lines.

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/progress.hpp"
#include "base/text/markup.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace facetmill::cli {

/// Writes a result to standard output. Throws an output error (E-WRITE) on failure, so that a full disk is
/// not a success.
void print(std::string_view text);
/// Writes a result for people; control characters in names are replaced, because they could affect the
/// terminal.
void show(std::string_view text);

/// The last reported fraction of a stage (0: none), and its time in seconds since the stage began.
struct PrintedMessage {
    double share = 0, seconds = 0;
};

/// The text after the name of a running stage: " 42 %, about 12 s left", or ", 12 s" without a fraction;
/// empty in the first second.
[[nodiscard]] std::string how_far(double seconds, const PrintedMessage& last);

/// Writes to standard error.
class Console {
  public:
    bool quiet = false;   ///< only warnings and errors
    bool verbose = false; ///< also resolved values and every stage
    bool json = false;    ///< one JSON object per line
    bool pipe = false;    ///< hints show options as pipe takes them

    /// Whether standard error is a terminal that supports colours; respects NO_COLOR and TERM=dumb.
    bool colour() const;
    void diagnostic(const Diagnostic& diagnostic) const;
    void diagnostics(const Error& error) const;
    /// A message for people, without control characters; suppressed by quiet. In JSON: {"level": "info",
    /// "message": ...}.
    void say(std::string_view text) const;
    /// Writes a result with colours; not for JSON.
    void say(const Painted& text) const;
    /// A JSON object for programs, only with --log json.
    void event(const Json& object) const;
    /// Whether a progress line may be redrawn: on a terminal, unless messages are lines or JSON.
    bool redraws() const;
    /// A bar on a terminal, lines with verbose, otherwise null.
    std::unique_ptr<Progress> progress() const;
};

} // namespace facetmill::cli
