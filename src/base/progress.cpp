#include "base/progress.hpp"

#include <algorithm>
#include <numeric>

namespace facetmill {

ProgressSteps::ProgressSteps(std::vector<double> lengths) : lengths_(std::move(lengths)) {
    const double all = std::accumulate(lengths_.begin(), lengths_.end(), 0.0);
    for (double& length : lengths_) length = all > 0 ? length / all : 0;
    whole_ = ProgressScope::here();
    ProgressScope::here() = whole_.part(0, lengths_.empty() ? 1 : lengths_[0]);
}

void ProgressSteps::next() {
    if (step_ >= lengths_.size()) return;
    done_ = std::min(1.0, done_ + lengths_[step_++]);
    whole_.report(done_);
    ProgressScope::here() =
        whole_.part(done_, step_ < lengths_.size() ? std::min(1.0, done_ + lengths_[step_]) : 1);
}

ProgressRounds::ProgressRounds() : whole_(ProgressScope::here()) {
    ProgressScope::here() = whole_.part(0, 0.5);
}

void ProgressRounds::next() {
    done_ += (1 - done_) / 2;
    whole_.report(done_);
    ProgressScope::here() = whole_.part(done_, done_ + (1 - done_) / 2);
}

} // namespace facetmill
