#pragma once
// The failures of a run: errors with their exit code, failed checks, and warnings that --strict turns into
// failures.

#include "base/error.hpp"
#include "base/out_of_memory.hpp"
#include "pipeline/run.hpp"

#include <fmt/format.h>

namespace facetmill::pipeline {

/// Adds failures to the record of a run, according to the settings. The record must outlive this object.
class Failures {
  public:
    /// allowed: ids of warnings that are neither reported nor failures.
    Failures(report::RunRecord& record, const RunSettings& settings, const std::vector<std::string>& allowed)
        : record_(record), settings_(settings), allowed_(allowed) {}

    bool any() const { return any_; }

    /// The first failure sets the exit code, but other failures take precedence over a failed check.
    void add(ErrorKind kind, report::RunError why);
    void add(const Error& error);
    /// Reports the warning, unless it is allowed, and fails if --strict includes it.
    void warn(const Diagnostic& warning);
    /// Turns failed checks of the record, from index first, into failures or, by their severity, into
    /// warnings. Returns true if all checks of severity error hold.
    bool judge_checks(std::size_t first);

    /// Runs body; an exception becomes a failure at this position. Then it returns false.
    template <class Body>
    bool guarded(const Mark& where, const std::string& what, Body&& body) {
        try {
            body();
            return true;
        } catch (Error& e) {
            add(e.at(where));
        } catch (const std::exception& e) {
            if (const auto limit = told_as_limit(e, what, where))
                add(*limit);
            else
                add(ErrorKind::bug,
                    {{Severity::error, "E-BUG", fmt::format("{} failed unexpectedly: {}", what, e.what()),
                      where, "please report it, with the pipeline and the input"}});
        }
        return false;
    }

  private:
    report::RunRecord& record_;
    const RunSettings& settings_;
    const std::vector<std::string>& allowed_;
    bool any_ = false;
};

} // namespace facetmill::pipeline
