#pragma once
// A limit on the time of a run. Stages are stopped where they report their progress.

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"

#include <fmt/format.h>

namespace facetmill::pipeline {

/// Passes progress on, and throws a limit error (E-TIME) when the time is over. Work that reports no progress
/// ends first. Since the last report comes before outputs get their names, a late run never writes any.
class TimeLimit : public Progress {
  public:
    /// to: the receiver of the progress, or null. seconds: the limit, or 0 for none.
    TimeLimit(Progress* to, double seconds) : to_(to), seconds_(seconds) {}

    void stage(int number, int number_of, const std::string& name) override {
        check();
        if (to_) to_->stage(number, number_of, name);
    }
    void beside_stages(const std::string& what) override {
        check();
        if (to_) to_->beside_stages(what);
    }
    void share(double done) override {
        check();
        if (to_) to_->share(done);
    }
    void done() override {
        if (to_) to_->done();
    }

    /// The receiver for a run: without a limit, nothing is checked.
    Progress* progress() { return seconds_ > 0 ? this : to_; }
    /// From now on the time is not checked, so that the report of a failure can be written.
    void end() { seconds_ = 0; }

  private:
    void check() const {
        if (seconds_ > 0 && watch_.seconds() > seconds_)
            throw Error(ErrorKind::limit, "E-TIME", fmt::format("the time limit of {} s is over", seconds_),
                        "allow more with --time-limit, or reduce the mesh first with simplify");
    }

    Progress* to_;
    double seconds_;
    const Stopwatch watch_;
};

} // namespace facetmill::pipeline
