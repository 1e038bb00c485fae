#pragma once
// Failures that are known and waived, so that a gate can be introduced on old assets.

#include "io/outputs/outputs.hpp"
#include "report/record.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace facetmill::validate_stage {

/// A failed check, and the locations that speak against it.
struct Failure {
    std::string check, part;    ///< part is empty: the scene
    std::string component = {}; ///< of per: component, what it is known by
    std::string expected;
    report::Found found = {};
    std::optional<double> min = {}, max = {}; ///< what a number had to lie between
    std::vector<std::uint64_t> keys =
        {};                      ///< of all its locations (stages/validate/check_evidence.hpp), ascending
    std::size_t more = 0;        ///< read from a file: locations that it only counts,
    std::uint64_t more_hash = 0; ///< and what they are known by together

    std::size_t locations() const { return keys.size() + more; }
    /// Whether it is the same check of the same thing.
    bool is_like(const Failure& other) const {
        return check == other.check && part == other.part && component == other.component;
    }
};

/// A list of failures. As a file: {"facetmill_baseline": 1, "failures": [{"check", "part", "component",
/// "expected", "found", "locations", "known", "more"}]}: `known` has the keys of locations as 16 hexadecimal
/// digits, "... x3" for three at the same positions. Of more than `max_known` different ones it has the
/// lowest (a sample, since they are hashes), and `more` what the others are known by together. So a file has
/// about 25 bytes per location and at most 1.3 MB per check.
class KnownFailures {
  public:
    static constexpr std::size_t max_known = 50000;

    /// Throws missing when there is no such file, malformed (E-BASELINE) when it is no baseline of this
    /// form.
    static KnownFailures read(const std::filesystem::path& path);
    void write(io::Outputs& outputs, const std::filesystem::path& path) const;
    void add(Failure failure) { failures_.push_back(std::move(failure)); }

    struct Verdict {
        bool waived = false;
        bool known = false;              ///< the check failed before, waived or not
        std::size_t fresh = 0;           ///< locations that are new
        std::vector<std::uint64_t> keys; ///< of those, as far as they are known one by one
    };
    /// Waived is what failed before, at no location that is new, and with a value that is no worse: the same,
    /// or a number not farther from what is expected. Beyond what the file lists, locations are new when
    /// there are more of them, or as many but others (one at least).
    Verdict judge(const Failure& failure) const;

    /// How much of this is no longer there, by what fails now.
    struct Gone {
        std::size_t failures = 0, locations = 0; ///< locations: of failures that are still there
    };
    Gone gone(const KnownFailures& now) const;
    std::size_t size() const { return failures_.size(); }

  private:
    std::vector<Failure> failures_;
};

} // namespace facetmill::validate_stage
