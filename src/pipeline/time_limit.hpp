#pragma once
// A limit on the time of a run. Stages are stopped where they report their progress, and between the chunks
// of their parallel loops.

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "parallel/loop_check.hpp"

#include <fmt/format.h>
#include <optional>

namespace facetmill::pipeline {

/// Passes progress on, and throws a limit error (E-TIME) when the time is over. Work that reports no progress
/// is not interrupted. Since the last report comes before outputs get their names, a late run never writes
/// outputs.
class TimeLimit : public Progress {
  public:
    /// to: the receiver of the progress, or null. seconds: the limit, or 0 for none.
    TimeLimit(Progress* to, double seconds) : to_(to), seconds_(seconds) {
        if (seconds > 0) loops_.emplace([this] { check_loop(); });
    }

    void stage(int number, int number_of, const std::string& name) override {
        check();
        in_stage_ = true;
        if (to_) to_->stage(number, number_of, name);
    }
    void beside_stages(const std::string& what) override {
        in_stage_ = false;
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

    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;

  private:
    void check() const {
        if (seconds_ > 0 && watch_.seconds() > seconds_)
            throw Error(ErrorKind::limit, "E-TIME", fmt::format("the time limit of {} s is over", seconds_),
                        "allow more with --time-limit, or reduce the mesh first with simplify");
    }

    /// Throws once in a stage, because the handling of its failure has loops, too.
    void check_loop() {
        if (!in_stage_ || !(seconds_ > 0) || watch_.seconds() <= seconds_) return;
        in_stage_ = false;
        check();
    }

    Progress* to_;
    double seconds_;
    bool in_stage_ = false;
    std::optional<LoopCheck> loops_;
    const Stopwatch watch_;
};

} // namespace facetmill::pipeline
