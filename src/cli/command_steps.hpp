#pragma once
// Progress of commands without a pipeline: info and diff.

#include "cli/console.hpp"

namespace facetmill::cli {

/// The steps of a command, shown like the stages of a run.
class CommandSteps {
  public:
    /// count: the number of steps.
    CommandSteps(const Console& console, std::size_t count)
        : count_(static_cast<int>(count)), progress_(console.progress()), share_(progress_.get()) {}

    /// Begins the next step; its progress (base/progress.hpp) is relative to the step.
    void next(const std::string& name) {
        if (progress_) progress_->stage(++number_, count_, name);
    }
    /// Ends the progress display before a result is printed.
    void done() {
        if (progress_) progress_->done();
    }

  private:
    int number_ = 0, count_;
    std::unique_ptr<Progress> progress_;
    ProgressScope share_;
};

} // namespace facetmill::cli
