#pragma once
// Failures that are known and waived, so that a gate can be introduced on old assets.

#include "io/outputs.hpp"
#include "report/record.hpp"

#include <filesystem>

namespace facetmill {

/// A list of failed checks by name and part, with what was found. As a file: {"failures": [{"check", "part",
/// "expected", "found"}]}.
class KnownFailures {
  public:
    /// Throws missing when there is no such file, malformed (E-BASELINE) when it is no baseline.
    static KnownFailures read(const std::filesystem::path& path);
    void write(io::Outputs& outputs, const std::filesystem::path& path) const;
    void add(const report::Check& check);
    bool empty() const { return failures_.empty(); }
    /// Whether the check failed before in the same part, and no worse: found the same, or a number that is
    /// not farther from what is expected.
    bool waives(const report::Check& check) const;

  private:
    struct Failure {
        std::string check, part, expected, found;
    };
    std::vector<Failure> failures_;
};

} // namespace facetmill
