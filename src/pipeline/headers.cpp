#include "io/gltf/contents/textures.hpp"
#include "io/images/image_files.hpp"
#include "io/packing.hpp"
#include "pipeline/plan.hpp"
#include "stage/options/plane.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace facetmill::pipeline {

namespace fs = std::filesystem;

namespace {

/// True if the header can be read without reading the whole file.
bool has_open_header(const fs::path& path) {
    std::error_code error;
    if (path == "-" || !fs::is_regular_file(path, error)) return false;
    char magic[2] = {};
    std::ifstream(path, std::ios::binary).read(magic, sizeof magic);
    return !(magic[0] == '\x1f' && magic[1] == '\x8b');
}

/// Option names with their values.
using Lengths = std::vector<std::pair<std::string, Value>>;

void add_physical(const std::string& name, const Value& value, Lengths& found) {
    Problems ignored; // a range may be a map or a text; its stage has checked it
    Length length;
    if (OptionType<Length>::parse(value, length, ignored) && length.kind == Length::Kind::physical)
        found.emplace_back(name, value);
}

/// Finds lengths with a physical unit among the values of options.
void find_physical(const Option& option, const Value& value, Lengths& found);

void find_physical(const Declaration& declaration, const Value& given, Lengths& found) {
    if (given.is_map()) {
        for (const auto& entry : given.entries)
            if (const Option* option = declaration.find(entry.key))
                find_physical(*option, entry.value, found);
    } else if (const Option* option = declaration.primary()) {
        find_physical(*option, given, found);
    }
}

void find_physical(const Option& option, const Value& value, Lengths& found) {
    if (option.one == OptionKind::plane)
        if (const auto length = length_in_plane(value)) return add_physical(option.name, *length, found);
    if (option.fields) return find_physical(*option.fields, value, found);
    for (const auto& item : value.items) find_physical(option, item, found);
    for (const auto& entry : value.entries) find_physical(option, entry.value, found); // {min: 2mm}
    if (option.dimension == Dimension::length && value.is_scalar() && !value.deferred)
        add_physical(option.name, value, found);
}

/// The value of the option in the pipeline; null if it is not given, or if the name is empty.
const Value* given_option(const Step& step, const std::string& name) {
    return !name.empty() && step.given.is_map() ? step.given.find(name) : nullptr;
}

/// Collects the reasons why files of a stage cannot be loaded. A pattern may match thousands of files that
/// are not meshes, so only the first few are listed.
class Refusals {
  public:
    void add(const Error& error, const fs::path& path) {
        if (++count_ <= most_told)
            told_.push_back(error);
        else if (!first_untold_)
            first_untold_ = {error, path};
    }

    void move_to(std::vector<Error>& errors) {
        errors.insert(errors.end(), told_.begin(), told_.end());
        if (!first_untold_) return;
        const auto& [error, path] = *first_untold_;
        const Diagnostic& one = error.diagnostics().front();
        const std::size_t untold = count_ - most_told;
        errors.emplace_back(error.kind(), one.id,
                            untold == 1
                                ? fmt::format("'{}' cannot be loaded, either", path.generic_string())
                                : fmt::format("{} more files cannot be loaded, '{}' the first of them",
                                              untold, path.generic_string()),
                            one.hint, one.where);
    }

  private:
    static constexpr std::size_t most_told = 10;
    std::vector<Error> told_;
    std::optional<std::pair<Error, fs::path>> first_untold_;
    std::size_t count_ = 0;
};

class Walk {
  public:
    explicit Walk(const Folders& places) : places_(places) {}
    Headers headers;

    /// unit: the unit of the input scene; empty: unknown.
    void steps(const Steps& all, std::optional<Unit> unit) {
        for (const auto& step : all) {
            if (step.when && step.when->known == false) continue;
            for (const auto& arm : step.arms) steps(*arm.steps, unit);
            if (!step.stage) continue;
            images_changed_ |= step.info->changes_images;
            try {
                add_written(step);
            } catch (Error& error) { // an input that can no longer be read
                headers.errors.push_back(error.at(step.where));
            }
            // A stage that sets the unit makes it unknown here, for its own lengths too.
            if (given_option(step, step.info->roles.sets_unit)) unit.reset();
            if (step.info->reads_headers)
                load(step, unit);
            else if (unit == Unit::unknown)
                refuse_units(step);
            else if (unit)
                resolve_lengths(step, *unit);
            if (step.ensure && unit == Unit::unknown) contract(*step.ensure);
        }
    }

  private:
    using Images = std::vector<io::NamedImage>;
    struct Loaded {
        io::FileHeader header;
        std::function<io::LibraryImageNames()> library_images;
    };

    void load(const Step& step, std::optional<Unit>& unit) {
        bool first = !any_loaded_;
        any_loaded_ = true;
        Refusals refused;
        for (const auto& file : planned_files({step}, places_)) {
            if (!has_open_header(file.path)) {
                first = false;
                continue;
            }
            try {
                const io::FileHeader header = step.stage->header(file.path, places_);
                if (std::exchange(first, false)) unit = header.unit;
                if (known_.insert(file.path.generic_string()).second)
                    headers.inputs.push_back({file.path, header});
                headers.more_inputs.insert(headers.more_inputs.end(), header.files.begin(),
                                           header.files.end());
                loaded_.push_back({header, [path = file.path, roots = asset_roots_of({step}, places_)] {
                                       return io::library_images(path, roots);
                                   }});
            } catch (Error& error) {
                refused.add(error.at(file.where), file.path);
                first = false;
            }
        }
        refused.move_to(headers.errors);
    }

    /// Adds the files that are written next to an output because of the scene's contents. A branch also
    /// counts files loaded in earlier branches, because an extra file in the list is better than a missing
    /// one.
    void add_written(const Step& step) {
        const StageFiles files = step.stage->files();
        const auto has_materials = [](const Loaded& file) {
            return file.header.has_materials && file.header.has_materials();
        };
        const bool all = files.materials.has_value();
        const bool library = all && std::any_of(loaded_.begin(), loaded_.end(), has_materials);
        if (library) headers.more_outputs.push_back(places_.output(files.materials->text));
        if (!files.images || (all && !library)) return;
        headers.images_change |= images_changed_;
        const fs::path path = files.images->text;
        // Formats that name images in a library write all of them as files.
        io::ImageNames names(io::stem_of_neighbours(path),
                             all ? io::ImageNames::Spelling::plain : io::ImageNames::Spelling::kept);
        std::map<std::string, std::pair<fs::path, bool>>
            copies; // for each digest, the image's name and whether it is written
        const auto copy = [&](const io::NamedImage& image, bool used) {
            if (files.copies && !files.copies(image)) return;
            const auto [place, fresh] = copies.try_emplace(image.digest);
            auto& [name, written] = place->second;
            if (fresh) name = names.add(image.relative);
            if (used && !std::exchange(written, true))
                headers.more_outputs.push_back(places_.output((path.parent_path() / name).generic_string()));
        };
        for (auto& file : loaded_) {
            const io::LibraryImageNames of_file = all ? known(file.library_images) : io::LibraryImageNames{};
            const auto is_used = [&](const io::NamedImage& image) {
                return !of_file.idle.contains(image.relative);
            };
            for (const auto& image : known(file.header.images)) copy(image, is_used(image));
            for (const auto& image : of_file.embedded) copy(image, is_used(image));
        }
    }

    /// Computes the images once for all outputs.
    template <class Images>
    static Images known(std::function<Images()>& images) {
        if (!images) return {};
        const Images all = images();
        images = [all] { return all; };
        return all;
    }

    void resolve_lengths(const Step& step, Unit unit) {
        Lengths found;
        find_physical(*step.info->options, step.given, found);
        for (const auto& [option, value] : found) {
            Problems ignored; // the pattern was already parsed
            Length length;
            OptionType<Length>::parse(value, length, ignored);
            Headers::Lengths& lengths = headers.lengths[step.path];
            lengths.unit = unit;
            set_resolved(lengths.all, {option, value.text, length.amount / metres(unit)});
        }
    }

    /// Refuses values that need a unit if the scene has none.
    void refuse_units(const Step& step) {
        const Value* wanted = given_option(step, step.info->roles.writes_in_unit);
        if (wanted && wanted->is_scalar() &&
            unit_named(wanted->text).value_or(Unit::unknown) != Unit::unknown)
            headers.errors.push_back(
                Error(ErrorKind::usage, "E-UNIT",
                      fmt::format("the scene has no unit, so it cannot be written in {}", wanted->text),
                      "give the unit of the file (load: {unit: mm})", wanted->mark));
        Lengths found;
        find_physical(*step.info->options, step.given, found);
        for (const auto& [option, value] : found) no_unit(option, value.text, value.mark);
        if (step.when) assertions(step.when->predicates);
    }

    void contract(const Contract& contract) {
        assertions(contract.assertions);
        if (!contract.deviation) return;
        const DeviationLimits& limits = *contract.deviation;
        const std::optional<Length>* const lengths[] = {&limits.max, &limits.rms, &limits.mean};
        for (std::size_t i = 0; i < contract.deviation_at.size(); ++i)
            if (*lengths[i] && (*lengths[i])->kind == Length::Kind::physical)
                no_unit("deviation", (*lengths[i])->text, contract.deviation_at[i]);
    }

    void assertions(const Assertions& all) {
        for (const auto& [property, length, where] : all.physical()) no_unit(property, length->text, where);
    }

    void no_unit(const std::string& option, const std::string& text, const Mark& where) {
        headers.errors.push_back(Error(
            ErrorKind::usage, "E-UNIT", fmt::format("'{}' is {}, but the scene has no unit", option, text),
            "give the unit of the file (load: {unit: mm}), or use a bare number or a percentage", where));
    }

    const Folders& places_;
    std::vector<Loaded> loaded_;
    std::set<std::string> known_; ///< paths in headers.inputs
    bool any_loaded_ = false, images_changed_ = false;
};

} // namespace

Headers read_headers(const Plan& plan) {
    Walk walk(plan.places);
    walk.steps(plan.steps, std::nullopt);
    return std::move(walk.headers);
}

} // namespace facetmill::pipeline
