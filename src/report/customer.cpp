#include "report/customer.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "report/check_text.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// A text that replaces a technical one.
struct Plain {
    std::string_view technical; ///< part of it, or an id, or the name of a property
    std::string_view plain;
};

template <std::size_t n>
std::string_view plain_for(const Plain (&table)[n], std::string_view text) {
    for (const Plain& row : table)
        if (text.find(row.technical) != text.npos) return row.plain;
    return {};
}

/// Why a repair was not possible, after "because", by the words of clean.
constexpr Plain obstacles[] = {
    {"oriented inconsistently", "the faces around it disagree about which side is outside"},
    {"fewer than three edges", "it is a slit without width"},
    {"more than two faces", "several sheets of the surface meet at it"},
    {"more than", "it is larger than the holes that we close"},
    {"single face", "it surrounds a single loose triangle"},
    {"not planar", "its border does not lie in a plane"},
    {"intersects itself", "its border crosses itself"},
    {"without area", "its border is a line without area"},
    {"border of a flat surface", "it is the border of a flat sheet, not a hole in a solid"},
    {"intersect other faces", "a cover would pass through other parts of the model"},
    {"is open", "some of these surfaces are open, and only closed ones can be joined"},
    {"float32", "the surfaces are closer together than the file format can store"},
    {"rounded", "the surfaces are closer together than the file format can store"},
    {"rounding", "the surfaces are closer together than the file format can store"},
};

/// A property that fails: the sentence for the customer, the request, and the repair that would have helped.
struct FailedProperty {
    std::string_view property;
    std::string_view what; ///< {} is the place: " near (1, 2, 3)"
    std::string_view ask;
    std::string_view step = {}; ///< the step of clean that mends it
};

constexpr std::string_view ask_to_unite =
    "Please unite the overlapping parts in your modelling program, and send the file again.";
constexpr std::string_view ask_for_gap =
    "Please leave a small gap there, or let the parts overlap, and send the file again.";
constexpr std::string_view ask_for_export = "Please export it again, and send the new file.";
constexpr std::string_view ask_for_normals =
    "Please make all normals face outward in your modelling program, and send the file again.";

/// About a file that has more defects than the scene: rounding has merged or crossed surfaces.
constexpr std::string_view too_close_text =
    "Parts of the model touch only at edges or points, or are closer together than the file format can "
    "store. Please "
    "leave a small gap there, or let the parts overlap, and send the file again.";

constexpr FailedProperty failed_properties[] = {
    {"oriented",
     "Neighbouring faces point in opposite directions{}, so inside and outside cannot be told apart.",
     ask_for_normals, "orient"},
    {"outward_oriented", "Part of the surface is inside out{}.", ask_for_normals, "orient"},
    {"edge_manifold", "More than two faces meet at an edge{}, so inside and outside cannot be told apart.",
     ask_for_gap, "non_manifold"},
    {"vertex_manifold", "Parts of the model touch only at a point{}.", ask_for_gap, "non_manifold"},
    {"self_intersections", "Surfaces of the model pass through each other{}.", ask_to_unite,
     "self_intersections"},
    {"coplanar_overlaps", "Faces of the model lie on each other{}.", ask_to_unite, "self_intersections"},
    {"folded_faces", "The surface is folded onto itself{}.", ask_to_unite, "self_intersections"},
    {"touching", "Surfaces of the model touch each other{}.", ask_for_gap, "self_intersections"},
    {"degenerate_faces", "The model has faces without area{}.", ask_for_export, "degenerate"},
    {"duplicate_faces", "The model has the same face twice{}.", ask_for_export, "duplicates"},
    {"isolated_vertices", "The model has points that belong to no face{}.", ask_for_export, "isolated"},
    {"t_junctions", "Corners of faces lie on the edges of other faces{}, which leaves invisible gaps.",
     ask_for_export, "t_junctions"},
    {"unit_normals", "The file has shading directions of the wrong length{}.", ask_for_export},
    {"finite_attributes", "The file has values that are not numbers{}.", ask_for_export},
    {"weights_normalized", "The joint weights of the animation do not sum to 1{}.", ask_for_export},
};

/// Properties that fail because the surface is open.
constexpr std::array<std::string_view, 8> of_openness{
    "closed",           "boundary_loops", "boundary_edges", "boundary_length",
    "longest_boundary", "volume",         "solid_volume",   "genus"};

bool is_of_openness(const Check& check) {
    return std::find(of_openness.begin(), of_openness.end(), check.name) != of_openness.end();
}

/// " near (1, 2, 3)", or empty without a place.
std::string near(const Check& check) {
    const auto places = failing_locations(check);
    return places.empty() ? "" : fmt::format(" near ({})", readable(places.front(), ", "));
}

/// The results of the repairs of a run.
class Repairs {
  public:
    explicit Repairs(const RunRecord& record) {
        for (const StageRecord& stage : record.stages) {
            if (stage.skipped) continue;
            tried_ = tried_ || stage.stage == "clean" || stage.stage == "orient";
            if (stage.stage == "clean" || stage.stage == "orient") add(stage.stage, stage.result);
        }
    }
    bool tried() const { return tried_; }
    bool one_sided() const { return one_sided_; }
    /// The reasons of a step that was not done.
    std::vector<std::string> obstacles_of(std::string_view step) const {
        std::vector<std::string> all;
        for (const auto& [name, why] : not_done_)
            if (name == step) all.push_back(why);
        return all;
    }
    /// "We could not ... because ...".
    std::string why_not(const std::string& repair, std::string_view step) const {
        if (!tried_) return fmt::format("We did not {}, because this check does not change models.", repair);
        std::string_view plain;
        for (const auto& why : obstacles_of(step))
            if (plain.empty()) plain = plain_for(obstacles, why);
        return fmt::format("We could not {}, because {}.", repair,
                           plain.empty() ? "our automatic repair found no safe way" : plain);
    }

  private:
    /// Only the last stage of each kind counts.
    void add(const std::string& stage, const Json& result) {
        if (stage == "clean") not_done_.clear();
        if (stage == "orient") one_sided_ = false;
        const auto parts = result.find("parts");
        if (parts == result.end() || !parts->is_array()) return;
        for (const Json& part : *parts) {
            if (stage == "orient") {
                one_sided_ = one_sided_ || part.value("non_orientable_components", 0) > 0;
                continue;
            }
            const auto all = part.find("not_done");
            if (all == part.end()) continue;
            for (const Json& one : *all) not_done_.emplace_back(one.value("step", ""), one.value("why", ""));
        }
    }

    bool tried_ = false, one_sided_ = false;
    std::vector<std::pair<std::string, std::string>> not_done_; ///< steps and reasons
};

/// A measured value of the model, if it was measured.
std::optional<double> measured(const RunRecord& record, std::string_view name) {
    const auto columns = model_columns();
    for (std::size_t i = 0; i < std::min(columns.size(), record.model.values.size()); ++i)
        if (columns[i].name == name) return record.model.values[i];
    return {};
}

/// Whether no two triangles of the model are connected.
bool is_loose(const RunRecord& record) {
    const auto components = measured(record, "components"), triangles = measured(record, "triangles");
    return components && triangles && *components > 1 && *components == *triangles;
}

/// The text about a surface that is not closed.
std::string open_text(const Check& check, const RunRecord& record, const Repairs& repairs) {
    const auto why = repairs.obstacles_of("holes");
    const auto all_are = [&](std::string_view reason) {
        return !why.empty() &&
               std::all_of(why.begin(), why.end(), [&](const auto& w) { return w.find(reason) != w.npos; });
    };
    if (all_are("single face") || is_loose(record))
        return "The model consists of loose triangles that are not connected, so it encloses no space. "
               "Please join them into a closed surface, and send the file again.";
    if (all_are("border of a flat surface"))
        return "The model is a thin sheet without thickness, so it encloses no space. Please give it a "
               "thickness, and send the file again.";
    constexpr std::size_t all_listed = 10; // evidence lists at most this many
    std::size_t loops = 0;
    if (check.evidence)
        for (const auto& entry : *check.evidence) loops += entry.loop.has_value();
    const std::string place = near(check);
    const std::string what = loops == 1 || place.empty() ? fmt::format("The model has a hole{}.", place)
                             : loops == 0 ? fmt::format("The surface of the model is not closed{}.", place)
                                          : fmt::format("The model has {}{} holes, one of them{}.",
                                                        loops >= all_listed ? "at least " : "", loops, place);
    return fmt::format("{} {} Please close {} in your modelling program, and send the file again.", what,
                       repairs.why_not(loops > 1 ? "close them" : "close it", "holes"),
                       loops > 1 ? "them" : "it");
}

std::string with_unit(const std::string& number, const RunRecord& record) {
    const std::string& unit = record.model.unit;
    return unit.empty() || unit == to_string(Unit::unknown) ? number : fmt::format("{} {}", number, unit);
}

std::string number_text(const Check& check) {
    if (const auto* number = std::get_if<double>(&check.found)) return readable(*number);
    return found_text(check);
}

/// A property as words: "max_extent" becomes "max extent".
std::string words_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    std::replace(name.begin(), name.end(), '.', ' ');
    return name;
}

/// The required value, without the value in scene units in parentheses.
std::string required(const Check& check) { return check.expected.substr(0, check.expected.find(" (")); }

/// The text about a size that is out of its limits.
std::string size_text(const Check& check, const RunRecord& record) {
    const std::string found = number_text(check);
    if (check.name == "wall_thickness")
        return fmt::format(
            "The thinnest wall is {} thick{}. It must be {}. Please make thin walls thicker, and "
            "send the file again.",
            with_unit(found, record), near(check), required(check));
    if (check.name == "max_extent")
        return fmt::format(
            "The longest side of the model is {}. It must be {}. Please scale the model, or cut "
            "it into parts, and send the file again.",
            with_unit(found, record), required(check));
    if (check.name == "bounds")
        return fmt::format(
            "The model is too large or in the wrong place: its corners are at {}. They must be "
            "{}. Please scale or move the model, and send the file again.",
            found, required(check));
    if (check.name == "faces" && found == "0")
        return record.stages.empty() || !record.stages.front().after ||
                       record.stages.front().after->faces == 0
                   ? "The file has no surface: it contains no faces. Please export the model as a mesh, and "
                     "send "
                     "the file again."
                   : "The faces of the model have no area, so no surface is left. Please check the model in "
                     "your "
                     "modelling program, and send the file again.";
    return fmt::format(
        "The value '{}' of the model is {}{}. It must be {}. Please change the model, and send "
        "the file again.",
        words_of(check.name), found, near(check), required(check));
}

std::string check_text(const Check& check, const RunRecord& record, const Repairs& repairs) {
    if (is_of_openness(check)) return open_text(check, record, repairs);
    for (const FailedProperty& row : failed_properties) {
        if (row.property != check.name) continue;
        if (!check.file.empty()) return std::string(too_close_text);
        const std::string what = fmt::format(fmt::runtime(row.what), near(check));
        return fmt::format("{} {} {}", what, repairs.why_not("repair this", row.step), row.ask);
    }
    return size_text(check, record);
}

constexpr std::string_view one_sided_text =
    "The surface of the model has only one side, like a Moebius strip, so it has no inside. No repair can "
    "change "
    "this. Please give the surface a thickness, and send the file again.";

constexpr std::string_view unknown_format = "We cannot read this kind of file. Please export the model as "
                                            "STL, 3MF, OBJ, PLY or glTF, and send the new "
                                            "file.";

/// The name of a missing file that the model refers to: from 'buffers[0].uri: the file "a/b.bin" is missing'.
std::string missing_file(const std::string& message) {
    constexpr std::string_view before = "the file \"";
    const auto at = message.find(before);
    if (at == message.npos || message.find(" is missing", at) == message.npos) return {};
    const std::string path = message.substr(at + before.size());
    return std::filesystem::path(path.substr(0, path.find('"'))).filename().generic_string();
}

constexpr std::string_view our_fault = "We could not process the model because of a problem on our side. "
                                       "Your file may be fine. We will look into it.";

/// Texts for errors whose id is more specific than their kind, by the id without its first letter.
constexpr Plain reasons[] = {
    {"EMPTY",
     "The file has no surface: it contains no faces. Please export the model as a mesh, and send the "
     "file again."},
    {"NAN", "The file has coordinates that are not numbers. Please export the model again, and send the new "
            "file."},
    {"INDEX", "The file is damaged: a face refers to a corner that the file does not have. Please export the "
              "model again, and send the new file."},
    {"FACE", "The file is damaged: a face has too few corners, or the same corner twice. Please export the "
             "model again, and send the new file."},
    {"URI", "The file refers to another file that we did not receive. Please send all files of the model "
            "together, or export a single file (.glb, .3mf or .stl)."},
    {"FILE", "We did not receive the file, or a file that it refers to. Please send all files of the model "
             "together."},
    {"PERMISSION", "We could not open the file. Please send it again."},
    {"ASSET-ROOT",
     "The file refers to files outside its own folder. Please send all files of the model in one "
     "folder."},
    {"FORMAT-VERSION", "The file has a version of its format that we cannot read. Please export the model as "
                       "STL, 3MF, OBJ, PLY or glTF, and send the new file."},
    {"EXTENSION",
     "The file uses an extension of its format that we cannot read. Please export the model without "
     "it, and send the new file."},
    {"ENCODING",
     "The file is text in an encoding that we cannot read. Please save it as UTF-8, and send the new "
     "file."},
    {"TIME",
     "The model takes longer to process than our limit. Please reduce its number of triangles, and send "
     "the file again."},
    {"MEMORY",
     "The model is too large for us to process. Please reduce its number of triangles, and send the "
     "file again."},
    {"EXPANSION", "The compressed file becomes larger than our limit. Please send it without compression."},
    {"LIMIT", "The model is too large for us to process. Please reduce its number of triangles, and send the "
              "file again."},
    {"UNIT", "The file does not state its unit of length. Please tell us the unit: mm, cm, m or inches."},
    {"SPACE", our_fault},
};

std::string kind_text(ErrorKind kind) {
    switch (kind) {
    case ErrorKind::missing:
        return "We did not receive all files of the model. Please send them together.";
    case ErrorKind::malformed:
        return "The file is damaged or incomplete, so we could not read it. Please export the model again, "
               "and "
               "send the new file.";
    case ErrorKind::stage:
        return "The model has a shape that our process cannot handle. Please contact us about it.";
    case ErrorKind::limit:
        return "The model is too large for us to process. Please reduce its number of triangles, and send "
               "the file "
               "again.";
    case ErrorKind::check:
        return "The model did not pass one of our checks. Please contact us about it.";
    case ErrorKind::usage:
    case ErrorKind::output:
    case ErrorKind::bug:
        break;
    }
    return std::string(our_fault);
}

constexpr std::string_view ask_for_unit =
    "The file does not state its unit of length. Please tell us the unit: mm, cm, m or inches.";

void add_once(std::vector<std::string>& all, std::string text) {
    if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(std::move(text));
}

/// The texts of the failed checks, the causes of others first.
std::vector<std::string> failed_checks(const RunRecord& record) {
    const Repairs repairs(record);
    std::vector<std::string> texts;
    bool open = false; // one text for all properties of an open surface
    const auto is_of_sides = [](const Check& check) {
        return is_of_openness(check) || check.name == "oriented" || check.name == "outward_oriented";
    };
    for (const Check& check : record.checks)
        if (check.name == "faces" && !check.passed && found_text(check) == "0")
            return {size_text(check, record)}; // everything else follows from it
    for (const Check& check : record.checks) {
        if (check.passed || check.severity != Severity::error) continue;
        if (std::holds_alternative<std::monostate>(check.found) && !is_of_openness(check)) continue;
        if (repairs.one_sided() && is_of_sides(check)) {
            add_once(texts, std::string(one_sided_text));
        } else if (!is_of_openness(check) || !std::exchange(open, true)) {
            add_once(texts, check_text(check, record, repairs));
        }
    }
    return texts;
}

} // namespace

std::string customer_text(const Diagnostic& error, ErrorKind kind) {
    const std::string id = error.id.starts_with("E-") ? error.id.substr(2) : error.id;
    if (id == "STRICT" && error.message.find("-UNITS ") != error.message.npos)
        return std::string(ask_for_unit);
    if (id == "FORMAT") return std::string(unknown_format);
    if (id == "FILE")
        if (const std::string file = missing_file(error.message); !file.empty())
            return fmt::format(
                "The file refers to '{}', which we did not receive. Please send all files of the "
                "model together, or export a single file (.glb, .3mf or .stl).",
                file);
    const bool may_be_the_file =
        kind != ErrorKind::usage && kind != ErrorKind::output && kind != ErrorKind::bug;
    for (const Plain& row : reasons)
        if (may_be_the_file && row.technical == id) return std::string(row.plain);
    return kind_text(kind);
}

std::string customer_text(const RunRecord& record) {
    if (record.exit_code == 0) return {};
    constexpr std::size_t most = 3;
    std::vector<std::string> texts;
    // Other failures than checks decide the exit code.
    const auto kind = static_cast<ErrorKind>(record.exit_code);
    for (const RunError& error : record.errors)
        if (!error.of_check) add_once(texts, customer_text(error, kind));
    for (auto& text : failed_checks(record)) add_once(texts, std::move(text));
    if (texts.empty()) texts.push_back(kind_text(kind));
    texts.resize(std::min(texts.size(), most));
    return join_texts(texts, " ");
}

} // namespace facetmill::report
