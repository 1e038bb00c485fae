#pragma once
// How far a run is: a bar on a terminal, nothing elsewhere. The runner tells the stages; loops that take long
// tell what share of a stage is done, without knowing who listens.

#include <atomic>
#include <string>

namespace facetmill {

class Progress {
  public:
    virtual ~Progress() = default;
    /// A stage begins: number of number_of, and its name.
    virtual void stage(int number, int number_of, const std::string& name) = 0;
    /// What comes after the last stage begins: a report is rendered.
    virtual void after_stages(const std::string& what) = 0;
    virtual void done() = 0;
    /// The share of the present stage that is done, from 0 to 1; negative while nothing tells it.
    std::atomic<double> share{-1};
};

/// The share of the work of this thread.
class Share {
  public:
    /// Until its end, shares that this thread tells go there; null: nowhere.
    explicit Share(std::atomic<double>* to) : Share(Place{to, 0, 1}) {}
    /// Until its end, what this thread tells is the part from `begin` to `end` of what it told before.
    Share(double begin, double end) : Share(inside(begin, end)) {}
    ~Share() { here() = before_; }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

    /// Costs next to nothing; done: from 0 to 1.
    static void tell(double done) {
        const Place& place = here();
        if (place.to)
            place.to->store(place.begin + done * (place.end - place.begin), std::memory_order_relaxed);
    }

    /// From here on it is not known.
    static void unknown() {
        if (here().to) here().to->store(-1, std::memory_order_relaxed);
    }

  private:
    struct Place {
        std::atomic<double>* to = nullptr;
        double begin = 0, end = 1;
    };
    explicit Share(const Place& place) : before_(here()) { here() = place; }
    static Place& here() {
        thread_local Place place;
        return place;
    }
    static Place inside(double begin, double end) {
        const Place& outer = here();
        const double size = outer.end - outer.begin;
        return {outer.to, outer.begin + begin * size, outer.begin + end * size};
    }

    Place before_;
};

} // namespace facetmill
