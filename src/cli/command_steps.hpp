#pragma once
// How far a command without a pipeline is: info and diff.

#include "cli/console.hpp"

namespace facetmill::cli {

/// What it does, one step after the other, shown as the stages of a run are.
class CommandSteps {
  public:
    /// count: how many steps there will be.
    CommandSteps(const Console& console, std::size_t count)
        : count_(static_cast<int>(count)), progress_(console.progress()), share_(progress_.get()) {}

    /// The next step begins; what it tells of its share (base/progress.hpp) is of itself.
    void next(const std::string& name) {
        if (progress_) progress_->stage(++number_, count_, name);
    }
    /// There is nothing more to wait for: before a result is printed.
    void done() {
        if (progress_) progress_->done();
    }

  private:
    int number_ = 0, count_;
    std::unique_ptr<Progress> progress_;
    ProgressScope share_;
};

} // namespace facetmill::cli
