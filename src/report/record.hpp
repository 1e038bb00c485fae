#pragma once
// The data that a run collects. Only the renderers (text, JSON, HTML, JUnit) read it.

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/math/vec.hpp"
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

/// A violation of a check: a location, or the contribution of an owner.
struct EvidenceEntry {
    enum class Of { place, part, material, image, extension, bytes };
    Of of = Of::place;                               ///< place: a point, of nobody
    std::string name = {};                           ///< whose it is
    std::optional<Vec3> at = {};                     ///< in the world
    std::optional<Vec3> nearest = {};                ///< for a deviation: on the other surface ...
    std::string side = {};                           ///< ... and whose `at` is
    std::optional<std::size_t> face = {}, with = {}; ///< with: the other face of a pair
    std::string attribute = {};                      ///< the place is about it
    std::optional<std::size_t> loop = {}; ///< the number of a boundary chain among those of its part,
    std::size_t edges = 0;                ///< ... how many edges it has
    double length = 0;                    ///< ... and how long it is
    std::string document = {};            ///< that names an extension
    std::size_t width = 0, height = 0;    ///< of an image
    std::optional<double> amount = {};    ///< the contribution
    bool is_count = false;                ///< the amount is
};
using CheckEvidence = std::vector<EvidenceEntry>;

/// The corners of a box.
struct Corners {
    Vec3 min, max;
    bool operator==(const Corners&) const = default;
};

/// What a check found, by the kind of its property: a truth, a count, a number, a word, a box or names; none
/// when the property does not apply.
using Found =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, Corners, std::vector<std::string>>;

/// A validate or ensure assertion and how it went.
struct Check {
    std::string name = {};  ///< the property: "closed"
    std::string stage = {}; ///< the name of the stage that made it
    bool passed = true;
    Severity severity = Severity::error;
    std::string expected = {}; ///< "true", "2", "at most 5"
    Found found = {};
    std::string found_words = {};               ///< what people read for it, where that says more
    std::optional<double> min = {}, max = {};   ///< the limits of a number
    std::string hint = {};                      ///< when it failed: the stage that fixes it
    std::string part = {};                      ///< the part it is about; empty: the scene
    std::optional<CheckEvidence> evidence = {}; ///< the first locations, or what counts most; none if it held
    std::optional<std::size_t> locations = {};  ///< how many speak against it, where found does not tell
    std::optional<std::size_t> fresh = {}; ///< how many of these a baseline does not know; none without one
    bool waived = false;                   ///< it did not hold, but that is known; passed is true
    Mark where = {};
    std::string picture = {}; ///< for pages: its places when it did not hold, a PNG in base64
};

struct PartChange {
    std::string part;
    AttributeChange change;
};

/// A length that depended on the scene, and its value.
struct ResolvedLength {
    std::string option; ///< "amplitude", or, where parts differ in it, "amplitude (wheel)"
    std::string given;  ///< "0.2%"
    double is = 0;      ///< in scene units
};
/// Sets the length of that option.
inline void set_resolved(std::vector<ResolvedLength>& all, ResolvedLength length) {
    const auto known = std::find_if(all.begin(), all.end(),
                                    [&](const ResolvedLength& l) { return l.option == length.option; });
    (known != all.end() ? *known : all.emplace_back()) = std::move(length);
}

/// The cheap counts of a scene before and after every stage.
struct Brief {
    std::size_t parts = 0, vertices = 0, faces = 0;
    Box bounds = {};
};

struct StageRecord {
    std::string name;  ///< unique in the run: the common key name, or the stage's own with a number
    std::string stage; ///< "clip"
    std::string path;  ///< where in the pipeline: "stages[3]" or "stages[5].branch.far[0]"
    std::optional<Brief> before, after; ///< none: it was skipped; none after: it failed
    std::vector<PartChange> attribute_changes;
    std::vector<Diagnostic> warnings;
    Json options = Json::object(); ///< as they held: given, or by default
    Json result = Json::object();  ///< what the stage itself reports
    std::vector<ResolvedLength> resolved;
    std::vector<std::string> said; ///< the main numbers of the result, a line each, for the terminal
    bool skipped = false;          ///< its `when` did not hold
    double seconds = 0;
    std::string
        picture;    ///< of the scene after it, for pages: a PNG in base64; empty: as after the stage before
    int camera = 0; ///< pictures of one number are seen in the same way; 0: it has a way of its own
    std::optional<DeviationView>
        deviation;               ///< for pages: how far it moved the surface, of stages that measure it
    std::size_t peak_memory = 0; ///< bytes, of the process so far
};

struct FileRecord {
    std::string
        path; ///< of an input as it was opened; of an output from the output folder, as the pipeline says
    std::size_t bytes = 0;
    std::string sha256;
    Json read_back; ///< of meshes among the outputs: properties of the file decoded again, and how far
                    ///< positions moved
    std::optional<io::ByteKinds> kinds = {}; ///< the use of its bytes
};

/// Why a run failed.
struct RunError : Diagnostic {
    bool of_check = false; ///< a check that did not hold, which is among the checks, too
};

struct RunRecord {
    std::string pipeline; ///< the file's name as given, or "pipe"
    std::string about;
    std::string text;    ///< of the pipeline, for pages
    std::string command; ///< that runs it again, for a shell; empty: unknown
    Json params = Json::object();
    std::vector<FileRecord> inputs, outputs;
    std::vector<std::string> absent;  ///< files that inputs name and that do not exist: a run goes on
    std::vector<std::string> reports; ///< that were written, from the output folder
    std::vector<StageRecord> stages;
    std::vector<Check> checks;
    std::vector<OutputView> views;     ///< for pages: what was written, or where the run ended
    std::size_t pictures_left_out = 0; ///< of a page, which would have become too large
    bool pictures_shrunk = false;      ///< some are smaller than usual for the same reason
    std::vector<Diagnostic> not_drawn; ///< textures that the pictures of a page do without
    std::vector<Diagnostic> warnings;  ///< of the run as a whole
    std::vector<RunError> errors;      ///< why it failed
    int exit_code = 0;
    double seconds = 0;
    std::size_t peak_memory = 0; ///< bytes
    int threads = 0;
    Json final_properties; ///< of the scene at the end, all of property_table()
};

} // namespace facetmill::report
