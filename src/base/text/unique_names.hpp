#pragma once
// Names that differ: NAME, NAME_2, NAME_3 ..., or with another separator.

#include <fmt/format.h>
#include <map>
#include <set>
#include <string>

namespace facetmill {

/// The name when it is free, else the first of NAME_2, NAME_3 ... that is: for which taken(name) is false.
template <class Taken>
std::string free_name(const std::string& wanted, Taken&& taken) {
    std::string name = wanted;
    for (int n = 2; taken(name); ++n) name = fmt::format("{}_{}", wanted, n);
    return name;
}

/// Names that were given out: none twice. Adding takes the logarithm of their count, also where a thousand
/// want the same.
class UniqueNames {
  public:
    explicit UniqueNames(char separator = '_') : separator_(separator) {}
    /// A name that exists already.
    void take(const std::string& name) { taken_.insert(name); }
    /// As free_name.
    std::string add(const std::string& wanted) {
        std::string name = wanted;
        while (!taken_.insert(name).second)
            name = fmt::format("{}{}{}", wanted, separator_, ++copies_[wanted] + 1);
        return name;
    }

  private:
    char separator_;
    std::set<std::string> taken_;
    std::map<std::string, int> copies_; ///< where to go on counting
};

} // namespace facetmill
