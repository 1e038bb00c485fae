#pragma once
// The progress of a run: a bar on a terminal, otherwise silent. The runner announces the stages; long work
// reports its completed share to an unknown listener.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace facetmill {

class Progress {
  public:
    virtual ~Progress() = default;
    /// A stage begins: its number, the number of stages, and its name.
    virtual void stage(int number, int number_of, const std::string& name) = 0;
    /// Work outside the stages begins: for example, a picture or a report.
    virtual void beside_stages(const std::string& what) = 0;
    /// The completed share of the current stage, or of work outside stages, from 0 to 1. Repeated work may
    /// lower it. Called by the thread that runs the stage.
    virtual void share(double done) = 0;
    virtual void done() = 0;
};

/// The share of the work of this thread. Without a listener, reporting costs almost nothing.
class ProgressScope {
  public:
    /// The receiver of a thread's reports, and the part of the whole that its work covers.
    struct Range {
        Progress* to = nullptr;
        double begin = 0, end = 1;
        bool reports_loop = false; ///< the next parallel loop reports its progress

        void report(double done) const {
            if (to) to->share(begin + done * (end - begin));
        }
        Range part(double from, double until) const {
            return {to, begin + from * (end - begin), begin + until * (end - begin)};
        }
    };

    /// During its lifetime, `to` receives the shares that this thread reports. Null: no receiver.
    explicit ProgressScope(Progress* to) : ProgressScope(Range{to, 0, 1}) {}
    /// During its lifetime, this thread's reports cover the part from `begin` to `end` of the enclosing
    /// scope.
    ProgressScope(double begin, double end) : ProgressScope(here().part(begin, end)) {}
    ~ProgressScope() { here() = before_; }
    ProgressScope(const ProgressScope&) = delete;
    ProgressScope& operator=(const ProgressScope&) = delete;

    /// done: from 0 to 1.
    static void report(double done) { here().report(done); }
    /// Item i of n is next; cheap enough to call for each.
    static void report_item(std::size_t i, std::size_t n) {
        if (i % 8192 == 0 && n > 0) report(static_cast<double>(i) / static_cast<double>(n));
    }

    /// Lets the next parallel loop (parallel/parallel.hpp) report its progress; nested and later loops do
    /// not.
    static void report_next_loop() { here().reports_loop = true; }
    /// The receiver of a starting parallel loop; none unless report_next_loop was called.
    static Range of_loop() {
        Range& place = here();
        return std::exchange(place.reports_loop, false) ? place : Range{};
    }

  private:
    friend class ProgressSteps;
    friend class ProgressRounds;
    explicit ProgressScope(const Range& place) : before_(std::exchange(here(), place)) {}
    static Range& here() {
        thread_local Range place;
        return place;
    }

    Range before_;
};

/// Divides the share of this thread among consecutive steps, by the approximate time of each: ProgressSteps
/// steps({2, 5, 1}); the first step; steps.next(); the second; steps.next(); the third. To skip a step, call
/// next() once more.
class ProgressSteps {
  public:
    explicit ProgressSteps(std::vector<double> lengths);
    ~ProgressSteps() { ProgressScope::here() = whole_; }
    ProgressSteps(const ProgressSteps&) = delete;
    ProgressSteps& operator=(const ProgressSteps&) = delete;

    void next();

  private:
    std::vector<double> lengths_; ///< lengths as shares of the total
    std::size_t step_ = 0;
    double done_ = 0;
    ProgressScope::Range whole_;
};

/// Progress for an unknown number of rounds: each takes half of the remaining share.
class ProgressRounds {
  public:
    ProgressRounds();
    ~ProgressRounds() { ProgressScope::here() = whole_; }
    ProgressRounds(const ProgressRounds&) = delete;
    ProgressRounds& operator=(const ProgressRounds&) = delete;

    /// Ends a round, and begins the next.
    void next();

  private:
    double done_ = 0;
    ProgressScope::Range whole_;
};

} // namespace facetmill
