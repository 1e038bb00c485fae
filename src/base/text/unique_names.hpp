#pragma once
// Makes names unique: NAME, NAME_2, NAME_3 ..., or with another separator.

#include <fmt/format.h>
#include <map>
#include <set>
#include <string>

namespace facetmill {

/// The name if it is free, otherwise the first free name of NAME_2, NAME_3 ... A name is free if taken(name)
/// is false.
template <class Taken>
[[nodiscard]] std::string free_name(const std::string& wanted, Taken&& taken) {
    std::string name = wanted;
    for (int n = 2; taken(name); ++n) name = fmt::format("{}_{}", wanted, n);
    return name;
}

/// Assigns names without repetition. Adding takes logarithmic time, even if a thousand callers want the same
/// name.
class UniqueNames {
  public:
    explicit UniqueNames(char separator = '_') : separator_(separator) {}
    /// Reserves an existing name.
    void take(const std::string& name) { taken_.insert(name); }
    /// Like free_name.
    std::string add(const std::string& wanted) {
        std::string name = wanted;
        while (!taken_.insert(name).second)
            name = fmt::format("{}{}{}", wanted, separator_, ++copies_[wanted] + 1);
        return name;
    }

  private:
    char separator_;
    std::set<std::string> taken_;
    std::map<std::string, int> copies_; ///< the last number used for each name
};

} // namespace facetmill
