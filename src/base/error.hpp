#pragma once
// Errors as data: a diagnostic has a stable id, a message, a location and a hint; an Error contains one or
// more diagnostics and an exit code. Library code throws, never prints and never exits.

#include "base/mark.hpp"

#include <exception>
#include <set>
#include <string>
#include <vector>

namespace facetmill {

/// The kind of an error, which shows who can fix it. The value is the process's exit code.
enum class ErrorKind : int {
    check = 1,     ///< a check of validate or ensure failed
    usage = 2,     ///< the command line or the pipeline is wrong
    missing = 3,   ///< an input is missing or not permitted
    output = 4,    ///< an output cannot be written
    stage = 5,     ///< a stage could not process its input
    malformed = 6, ///< an input is malformed
    limit = 7,     ///< a limit was exceeded, or memory was short
    bug = 70,      ///< a bug in facetmill
};

/// The exit code and its meaning: "2 (the command line or the pipeline is wrong)".
[[nodiscard]] std::string to_string(ErrorKind kind);

enum class Severity { error, warning, note };

struct Diagnostic {
    Severity severity = Severity::error;
    std::string id;      ///< stable, documented: E-KEY, W-UNITS
    std::string message; ///< one sentence without a full stop: the expected and the found value
    Mark where;          ///< may be unknown
    std::string hint;    ///< how to fix it, or empty
    /// The operation failed for lack of memory, and may succeed with less parallel work.
    bool out_of_memory = false;
};

/// One or more diagnostics, and who can fix them.
class Error : public std::exception {
  public:
    Error(ErrorKind kind, std::string id, std::string message, std::string hint = {}, Mark where = {});
    Error(ErrorKind kind, std::vector<Diagnostic> diagnostics);
    Error(const Error&);
    Error(Error&&) noexcept;
    Error& operator=(const Error&);
    Error& operator=(Error&&) noexcept;
    ~Error() override;

    ErrorKind kind() const { return kind_; }
    const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
    /// Sets the location of the diagnostics without one. Low-level code throws the message, and a higher
    /// layer adds the location.
    Error& at(const Mark& where);
    const char* what() const noexcept override { return text_.c_str(); }

  private:
    ErrorKind kind_;
    std::vector<Diagnostic> diagnostics_;
    std::string text_;
};

/// An error of kind limit (E-MEMORY), with out_of_memory set.
[[nodiscard]] Error out_of_memory(std::string message, std::string hint = {}, Mark where = {});

/// Whether --allow lists the warning. ids: the user's list.
bool is_allowed(const Diagnostic& warning, const std::vector<std::string>& ids);

/// Collects diagnostics, so that all of them can be reported at once.
class Problems {
  public:
    void add(Mark where, std::string id, std::string message, std::string hint = {});
    void warn(Mark where, std::string id, std::string message, std::string hint = {});
    void add(const Error& error);
    bool any_errors() const;
    std::size_t size() const { return all_.size(); }
    const std::vector<Diagnostic>& all() const { return all_; }
    /// Throws an Error of this kind with all collected diagnostics, if they include an error.
    void throw_if_any(ErrorKind kind) const;

  private:
    /// Adds a diagnostic unless it is known. The stages of a foreach are planned for each of its values, and
    /// a common problem is reported once.
    void add_once(Diagnostic one);

    std::vector<Diagnostic> all_;
    std::set<std::string> known_; ///< the contents of all_, as text
};

/// The diagnostic as text: "file:line:col: error[ID]: message", the source line, a caret, the hint.
[[nodiscard]] std::string render(const Diagnostic& diagnostic, bool colour = false);

} // namespace facetmill

// Compiled once, in error.cpp.
extern template class std::vector<facetmill::Diagnostic>;
