#pragma once
// A set that keeps the order of insertion.

#include <set>
#include <vector>

namespace facetmill {

/// T: ordered by <. Adding takes the logarithm of the count.
template <class T>
class OrderedSet {
  public:
    /// Returns true if the value is new.
    bool add(const T& value) {
        if (!known_.insert(value).second) return false;
        all_.push_back(value);
        return true;
    }
    const std::vector<T>& all() const { return all_; }

  private:
    std::set<T> known_;
    std::vector<T> all_;
};

} // namespace facetmill
