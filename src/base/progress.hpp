#pragma once
// How far a run is: a bar on a terminal, nothing elsewhere. The runner tells the stages; work that takes long
// tells what share of a stage is done, without knowing who listens.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace facetmill {

class Progress {
  public:
    virtual ~Progress() = default;
    /// A stage begins: number of number_of, and its name.
    virtual void stage(int number, int number_of, const std::string& name) = 0;
    /// What is not the work of a stage begins: a picture or a report is made.
    virtual void beside_stages(const std::string& what) = 0;
    /// The share of the present stage, or of what is beside it, that is done: from 0 to 1. Where work is done
    /// again, it may be less than before. Called by the thread that runs the stage.
    virtual void share(double done) = 0;
    virtual void done() = 0;
};

/// The share of the work of this thread. Where nobody listens, telling costs next to nothing.
class ProgressScope {
  public:
    /// Where a thread tells, and which part of that its work is.
    struct Range {
        Progress* to = nullptr;
        double begin = 0, end = 1;
        bool reports_loop = false; ///< the next parallel loop tells how far it is

        void report(double done) const {
            if (to) to->share(begin + done * (end - begin));
        }
        Range part(double from, double until) const {
            return {to, begin + from * (end - begin), begin + until * (end - begin)};
        }
    };

    /// Until its end, shares that this thread tells go there; null: nowhere.
    explicit ProgressScope(Progress* to) : ProgressScope(Range{to, 0, 1}) {}
    /// Until its end, what this thread tells is the part from `begin` to `end` of what it told before.
    ProgressScope(double begin, double end) : ProgressScope(here().part(begin, end)) {}
    ~ProgressScope() { here() = before_; }
    ProgressScope(const ProgressScope&) = delete;
    ProgressScope& operator=(const ProgressScope&) = delete;

    /// done: from 0 to 1.
    static void report(double done) { here().report(done); }
    /// Of n items, one by one, item i is next; cheap enough for each.
    static void report_item(std::size_t i, std::size_t n) {
        if (i % 8192 == 0 && n > 0) report(static_cast<double>(i) / static_cast<double>(n));
    }

    /// The next parallel loop (parallel/parallel.hpp) tells how far it is; those within it and after it do
    /// not.
    static void report_next_loop() { here().reports_loop = true; }
    /// Where a parallel loop that begins tells; nowhere unless it was asked to.
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

/// Divides the share of this thread among steps, one after the other, by how long each takes, about:
/// ProgressSteps steps({2, 5, 1}); the first step; steps.next(); the second; steps.next(); the third.
/// A step that is left out is passed by one more next().
class ProgressSteps {
  public:
    explicit ProgressSteps(std::vector<double> lengths);
    ~ProgressSteps() { ProgressScope::here() = whole_; }
    ProgressSteps(const ProgressSteps&) = delete;
    ProgressSteps& operator=(const ProgressSteps&) = delete;

    void next();

  private:
    std::vector<double> lengths_; ///< as shares of all
    std::size_t step_ = 0;
    double done_ = 0;
    ProgressScope::Range whole_;
};

/// Rounds of a work whose number is not known before: each has half of the share that is left.
class ProgressRounds {
  public:
    ProgressRounds();
    ~ProgressRounds() { ProgressScope::here() = whole_; }
    ProgressRounds(const ProgressRounds&) = delete;
    ProgressRounds& operator=(const ProgressRounds&) = delete;

    /// A round has ended, the next begins.
    void next();

  private:
    double done_ = 0;
    ProgressScope::Range whole_;
};

} // namespace facetmill
