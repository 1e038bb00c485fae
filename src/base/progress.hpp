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
    /// again, it may be less than before. Told by the thread that runs the stage.
    virtual void share(double done) = 0;
    virtual void done() = 0;
};

/// The share of the work of this thread. Where nobody listens, telling costs next to nothing.
class Share {
  public:
    /// Where a thread tells, and which part of that its work is.
    struct Place {
        Progress* to = nullptr;
        double begin = 0, end = 1;
        bool loop_tells = false; ///< the next parallel loop tells how far it is

        void tell(double done) const {
            if (to) to->share(begin + done * (end - begin));
        }
        Place part(double from, double until) const {
            return {to, begin + from * (end - begin), begin + until * (end - begin)};
        }
    };

    /// Until its end, shares that this thread tells go there; null: nowhere.
    explicit Share(Progress* to) : Share(Place{to, 0, 1}) {}
    /// Until its end, what this thread tells is the part from `begin` to `end` of what it told before.
    Share(double begin, double end) : Share(here().part(begin, end)) {}
    ~Share() { here() = before_; }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

    /// done: from 0 to 1.
    static void tell(double done) { here().tell(done); }
    /// Of n items, one by one, item i is next; cheap enough for each.
    static void tell_item(std::size_t i, std::size_t n) {
        if (i % 8192 == 0 && n > 0) tell(static_cast<double>(i) / static_cast<double>(n));
    }

    /// The next parallel loop (base/parallel.hpp) tells how far it is; those within it and after it do not.
    static void loop_tells() { here().loop_tells = true; }
    /// Where a parallel loop that begins tells; nowhere unless it was asked to.
    static Place of_loop() {
        Place& place = here();
        return std::exchange(place.loop_tells, false) ? place : Place{};
    }

  private:
    friend class ShareOfSteps;
    friend class ShareOfRounds;
    explicit Share(const Place& place) : before_(std::exchange(here(), place)) {}
    static Place& here() {
        thread_local Place place;
        return place;
    }

    Place before_;
};

/// Divides the share of this thread among steps, one after the other, by how long each takes, about:
/// ShareOfSteps steps({2, 5, 1}); the first step; steps.next(); the second; steps.next(); the third.
/// A step that is left out is passed by one more next().
class ShareOfSteps {
  public:
    explicit ShareOfSteps(std::vector<double> lengths);
    ~ShareOfSteps() { Share::here() = whole_; }
    ShareOfSteps(const ShareOfSteps&) = delete;
    ShareOfSteps& operator=(const ShareOfSteps&) = delete;

    void next();

  private:
    std::vector<double> lengths_; ///< as shares of all
    std::size_t step_ = 0;
    double done_ = 0;
    Share::Place whole_;
};

/// Rounds of a work whose number is not known before: each has half of the share that is left.
class ShareOfRounds {
  public:
    ShareOfRounds();
    ~ShareOfRounds() { Share::here() = whole_; }
    ShareOfRounds(const ShareOfRounds&) = delete;
    ShareOfRounds& operator=(const ShareOfRounds&) = delete;

    /// A round has ended, the next begins.
    void next();

  private:
    double done_ = 0;
    Share::Place whole_;
};

} // namespace facetmill
