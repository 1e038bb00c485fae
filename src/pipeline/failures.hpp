#pragma once
// What went wrong in a run: errors and the exit code that they make, checks that do not hold, warnings that
// --strict turns into failures.

#include "base/error.hpp"
#include "base/out_of_memory.hpp"
#include "pipeline/run.hpp"

#include <fmt/format.h>

namespace facetmill::pipeline {

/// Writes into the record of a run, which outlives it, as the settings ask.
class Failures {
  public:
    /// allowed: ids of warnings that are neither told nor made to fail.
    Failures(report::RunRecord& record, const RunSettings& settings, const std::vector<std::string>& allowed)
        : record_(record), settings_(settings), allowed_(allowed) {}

    bool any() const { return any_; }

    /// The first failure decides the exit code; a check that did not hold gives way to what went wrong in
    /// earnest.
    void add(ErrorKind kind, report::RunError why);
    void add(const Error& error);
    /// Tells the warning, unless it is allowed, and fails when --strict says so.
    void warn(const Diagnostic& warning);
    /// Turns the checks of the record from this one on that do not hold into failures or, by their severity,
    /// into warnings. Whether all errors among them hold.
    bool judge_checks(std::size_t first);

    /// Runs body; whatever it throws becomes a failure at this place. False then.
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
                add(ErrorKind::bug, {{Severity::error, "E-BUG",
                                      fmt::format("{} failed in a way it never should: {}", what, e.what()),
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
