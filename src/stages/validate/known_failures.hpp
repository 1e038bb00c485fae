#pragma once
// Known failures: old assets keep them, and checks find only new failures.

#include "io/outputs/outputs.hpp"
#include "report/record.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace facetmill::validate_stage {

/// A failed check, and the locations of the failure.
struct Failure {
    std::string check, part;    ///< part is empty for the whole scene
    std::string component = {}; ///< the component's stable identity, with per: component
    std::string expected;
    report::Found found = {};
    std::optional<double> min = {}, max = {}; ///< the expected range of a number
    std::vector<std::uint64_t> keys =
        {};               ///< the keys of all locations (stages/validate/check_evidence.hpp), ascending
    std::size_t more = 0; ///< the number of locations that a file counts without listing them
    std::uint64_t more_hash = 0; ///< the combined hash of these unlisted locations

    std::size_t locations() const { return keys.size() + more; }
    /// Whether both are the same check of the same subject.
    bool is_like(const Failure& other) const {
        return check == other.check && part == other.part && component == other.component;
    }
};

/// A list of failures. As a file: {"facetmill_baseline": 1, "failures": [{"check", "part", "component",
/// "expected", "found", "locations", "known", "more"}]}. `known` lists location keys as 16 hexadecimal
/// digits, with "... x3" for three locations at the same positions. It lists at most `max_known` distinct
/// keys, the lowest. These are a random sample because keys are hashes. `more` is the combined hash of the
/// other keys. A file has about 25 bytes per location and at most 1.3 MB per check.
class KnownFailures {
  public:
    static constexpr std::size_t max_known = 50000;

    /// Throws a missing-file error if the file does not exist, and a malformed-input error (E-BASELINE) if
    /// it is not a valid baseline.
    static KnownFailures read(const std::filesystem::path& path);
    void write(io::Outputs& outputs, const std::filesystem::path& path) const;
    void add(Failure failure) { failures_.push_back(std::move(failure)); }

    struct Verdict {
        bool waived = false;
        bool known = false;              ///< the check failed before, waived or not
        std::size_t fresh = 0;           ///< new locations
        std::vector<std::uint64_t> keys; ///< the keys of the new locations that have known keys
    };
    /// A failure is waived if the check failed before, no location is new, and the value is no worse. A
    /// value is no worse if it is equal, or if it is a number that is no farther from the expected range.
    /// Locations beyond the listed keys are new if their count grows. If only their combined hash changes,
    /// at least one is new.
    Verdict judge(const Failure& failure) const;

    /// The known failures that no longer occur, given the current failures.
    struct Gone {
        std::size_t failures = 0, locations = 0; ///< locations belong to failures that still occur
    };
    Gone gone(const KnownFailures& now) const;
    std::size_t size() const { return failures_.size(); }

  private:
    std::vector<Failure> failures_;
};

} // namespace facetmill::validate_stage
