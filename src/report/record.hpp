#pragma once
// The data that a run collects. Only the renderers (text, JSON, HTML, JUnit) read it.

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/math/vec.hpp"
#include "geometry/model_row/model_row.hpp"
#include "io/gltf/contents/byte_kinds.hpp"
#include "mesh/attribute_changes.hpp"
#include "report/views.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace facetmill::report {

/// A reason why a check failed: a location, or the share of a part or file.
struct EvidenceEntry {
    enum class Of { place, part, material, image, extension, bytes };
    Of of = Of::place;                ///< place: a point without owner
    std::string name = {};            ///< the owner's name
    std::optional<Vec3> at = {};      ///< location in the world
    std::optional<Vec3> nearest = {}; ///< for a deviation: the nearest point on the other surface
    std::string side = {};            ///< for a deviation: the surface that contains `at`
    std::optional<std::size_t> face = {}, with = {}; ///< with: the other face of a pair
    std::string attribute = {};                      ///< the attribute concerned
    std::optional<std::size_t> loop = {};            ///< the number of a boundary chain in its part
    std::size_t edges = 0;                           ///< the chain's number of edges
    double length = 0;                               ///< the chain's length
    std::string document = {};                       ///< document with the extension
    std::size_t width = 0, height = 0;               ///< size of an image
    std::optional<double> amount = {};               ///< the owner's share
    bool is_count = false;                           ///< amount is a count
};
using CheckEvidence = std::vector<EvidenceEntry>;

/// The corners of a box.
struct Corners {
    Vec3 min, max;
    bool operator==(const Corners&) const = default;
};

/// The found value of a check, by the kind of its property: a truth value, a count, a number, a word, a box
/// or names. None if the property does not apply.
using Found =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, Corners, std::vector<std::string>>;

/// A validate or ensure assertion with its result.
struct Check {
    std::string name = {};  ///< the property: "closed"
    std::string stage = {}; ///< the stage's name
    bool passed = true;
    Severity severity = Severity::error;
    std::string expected = {}; ///< "true", "2", "at most 5"
    Found found = {};
    std::string found_words = {};               ///< a more informative text for people
    std::optional<double> min = {}, max = {};   ///< the allowed range of a number
    std::string hint = {};                      ///< after a failure: a stage that fixes it
    std::string part = {};                      ///< the part concerned; empty: the scene
    std::string file = {};                      ///< the written file that was judged; empty: the scene
    std::optional<CheckEvidence> evidence = {}; ///< of a failed check: first locations, largest shares
    std::optional<std::size_t> locations = {};  ///< number of failing locations, if different from found
    std::optional<std::size_t> fresh = {}; ///< failing locations missing in the baseline; empty without one
    bool waived = false;                   ///< it failed, but the baseline allows it; passed is true
    Mark where = {};
    std::string picture = {}; ///< for pages: locations of a failed check, a PNG in base64
};

struct PartChange {
    std::string part;
    AttributeChange change;
};

/// A length that depended on the scene, with its value.
struct ResolvedLength {
    std::string option; ///< "amplitude", or, if parts differ, "amplitude (wheel)"
    std::string given;  ///< "0.2%"
    double is = 0;      ///< in scene units
};
/// Sets the length of this option.
inline void set_resolved(std::vector<ResolvedLength>& all, ResolvedLength length) {
    const auto known = std::find_if(all.begin(), all.end(),
                                    [&](const ResolvedLength& l) { return l.option == length.option; });
    (known != all.end() ? *known : all.emplace_back()) = std::move(length);
}

/// The cheap data of a scene before and after every stage.
struct Brief {
    std::size_t parts = 0, vertices = 0, faces = 0;
    Box bounds = {};
};

struct StageRecord {
    std::string name;  ///< unique in the run: the common key name, or the stage's name with a number
    std::string stage; ///< "clip"
    std::string path;  ///< position in the pipeline: "stages[3]" or "stages[5].branch.far[0]"
    std::optional<Brief> before, after; ///< both empty: the stage was skipped; only `after` empty: it failed
    std::vector<PartChange> attribute_changes;
    std::vector<Diagnostic> warnings;
    Json options = Json::object(); ///< effective values: given or default
    Json result = Json::object();  ///< the stage's own report
    std::vector<ResolvedLength> resolved;
    std::vector<std::string> said; ///< main numbers of the result for the terminal, one per line
    bool skipped = false;          ///< its `when` did not hold
    double seconds = 0;
    std::string picture; ///< picture of the scene after it, for pages: a PNG in base64; empty: as after the
                         ///< previous stage
    int camera = 0;      ///< equal numbers mean the same camera; 0: a separate camera
    std::optional<DeviationView>
        deviation;               ///< for pages: how far the stage moved the surface, if it measures that
    std::size_t peak_memory = 0; ///< peak memory of the process so far, in bytes
};

struct FileRecord {
    std::string path; ///< for an input, the path as opened; for an output, the path in the pipeline, relative
                      ///< to the output folder
    std::size_t bytes = 0;
    std::string sha256;
    Json read_back; ///< for output meshes: properties of the file decoded again, and how far positions moved
    std::optional<io::ByteKinds> kinds = {}; ///< sizes by kind of data
};

/// Why a run failed.
struct RunError : Diagnostic {
    bool of_check = false; ///< a failed check, which is also in checks
};

struct RunRecord {
    std::string pipeline; ///< the file's name as given, or "pipe"
    std::string about;
    std::string text;    ///< text of the pipeline, for pages
    std::string command; ///< shell command to run it again; empty: unknown
    Json params = Json::object();
    std::vector<FileRecord> inputs, outputs;
    std::vector<std::string> absent;  ///< missing files that inputs refer to; the run continues
    std::vector<std::string> reports; ///< written reports, relative to the output folder
    std::vector<StageRecord> stages;
    std::vector<Check> checks;
    std::vector<OutputView> views;     ///< for pages: outputs, or the scene where the run ended
    std::size_t pictures_left_out = 0; ///< pictures omitted to keep the page small
    bool pictures_shrunk = false;      ///< some pictures are smaller than usual, for the same reason
    std::vector<Diagnostic> not_drawn; ///< textures missing in the page's pictures
    std::vector<Diagnostic> warnings;  ///< warnings of the run as a whole
    std::vector<RunError> errors;      ///< reasons for failure
    int exit_code = 0;
    double seconds = 0;
    std::size_t peak_memory = 0; ///< in bytes
    int threads = 0;
    Json final_properties; ///< all of property_table() for the final scene, or for the scene that failed a
                           ///< check
    ModelRow model;        ///< for tables: the final scene, the scene that failed a check, or as loaded
};

} // namespace facetmill::report
