#pragma once
// Failures that are known and waived, so that a gate can be introduced on old assets.

#include "io/outputs.hpp"
#include "report/record.hpp"

#include <filesystem>
#include <optional>

namespace facetmill {

/// A list of failed checks by name and part, with what was found. As a file: {"failures": [{"check", "part",
/// "expected", "found", "places"}]}, places being null where they are not counted.
class KnownFailures {
  public:
    /// Throws missing when there is no such file, malformed (E-BASELINE) when it is no baseline.
    static KnownFailures read(const std::filesystem::path& path);
    void write(io::Outputs& outputs, const std::filesystem::path& path) const;
    void add(const report::Check& check);
    bool empty() const { return failures_.empty(); }
    /// Whether the check failed before in the same part, and no worse: found the same, or a number that is
    /// not farther from what is expected; at no more places, where both are counted.
    bool waives(const report::Check& check) const;
    /// How many of these do not fail any more, by what fails now.
    std::size_t mended(const KnownFailures& now) const;
    std::size_t size() const { return failures_.size(); }

  private:
    struct Failure {
        std::string check, part, expected, found;
        std::optional<std::size_t> places;
    };
    std::vector<Failure> failures_;
};

} // namespace facetmill
