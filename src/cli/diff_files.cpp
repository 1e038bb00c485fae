#include "cli/diff_files.hpp"

#include "base/progress.hpp"
#include "io/codec.hpp"
#include "io/convert.hpp"
#include "options/types.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

/// The size of the file with its neighbours.
report::SizeOnDisk size_of(const std::string& name, io::Span bytes, const io::ReadLog& log) {
    report::SizeOnDisk size;
    const auto add = [&](const std::string& path, std::uint64_t count, io::Span contents) {
        const io::ByteKinds kinds = io::byte_kinds(path, count, contents);
        size.bytes += count;
        size.kinds.geometry += kinds.geometry;
        size.kinds.textures += kinds.textures;
        size.kinds.json += kinds.json;
    };
    add(name, bytes.size(), bytes);
    for (const io::ReadFile& file : log.files) {
        std::error_code unknown;
        const auto count = file.sha256.empty() ? std::filesystem::file_size(file.path, unknown) : file.bytes;
        if (!unknown) add(file.path.generic_string(), count, {});
    }
    return size;
}

/// A length from the command line, in A's units or in percent.
std::optional<report::ComparisonSettings::Limit> limit_of(const std::string& text, const std::string& option,
                                                          Unit unit, const CommandLine& line) {
    if (text.empty()) return {};
    Length length;
    Problems problems;
    const Mark mark = line.find(option);
    if (OptionType<Length>::parse(Value::scalar(text, mark), length, problems) && !(length.amount >= 0))
        problems.add(mark, "E-RANGE", fmt::format("{} must be a distance, found {}", option, text),
                     "at least 0");
    problems.throw_if_any(ErrorKind::usage);
    if (length.kind == Length::Kind::percent) return report::ComparisonSettings::Limit{length.amount, true};
    if (length.kind == Length::Kind::scene) return report::ComparisonSettings::Limit{length.amount, false};
    if (!(metres(unit) > 0))
        throw Error(ErrorKind::usage, "E-UNIT",
                    fmt::format("{} is {}, but the first file has no unit", option, text),
                    "give a bare number or a percentage", mark);
    return report::ComparisonSettings::Limit{length.amount / metres(unit), false};
}

/// Reads a file and records data that its reader could not keep, so that the files do not count as the same.
Scene read(const std::string& name, bool is_a, const DiffOptions& options, report::Comparison& notes,
           const Console& console) {
    io::ReadLog log;
    const io::Input input = io::Input::open(name);
    Scene scene = io::read_scene(input, read_settings(options.asset_roots), log);
    (is_a ? notes.size_a : notes.size_b) = size_of(name, input.stored(), log);
    for (const auto& warning : log.warnings) {
        console.diagnostic(warning);
        if (warning.is_loss) notes.left_out.push_back({is_a, warning.message});
    }
    return scene;
}

/// Sets the unit and axis from the command line if the file does not state them.
void state(Scene& scene, bool is_a, const DiffOptions& options) {
    const auto stated = [&](const std::vector<std::string>& said) {
        return said.empty() ? std::string() : is_a ? said.front() : said.back();
    };
    if (scene.unit == Unit::unknown) scene.unit = unit_named(stated(options.units)).value_or(Unit::unknown);
    if (const std::string up = stated(options.ups); scene.up == UpAxis::unknown && !up.empty())
        scene.up = up == "y" ? UpAxis::y : UpAxis::z;
}

/// Whether the scene is a single part named after its file, because the format has no names.
bool is_named_by_file(const Scene& scene, const std::string& file) {
    const std::string own =
        file == "-" ? "standard input" : std::filesystem::path(file).stem().generic_string();
    return scene.parts.size() == 1 && scene.parts[0].name == own;
}

} // namespace

ComparedFiles compared_files(const DiffOptions& options, const std::string& name_a, const std::string& name_b,
                             const CommandLine& line, const Console& console) {
    report::Comparison notes;
    ComparedFiles out;
    Scene &a = out.a, &b = out.b;
    ProgressSteps steps({2, 2, options.settings.deviation.certify ? 50.0 : 20.0});
    a = read(name_a, true, options, notes, console);
    steps.next();
    b = read(name_b, false, options, notes, console);
    steps.next();
    report::Origin origin{{a.unit, a.up}, {b.unit, b.up}, {}};
    state(a, true, options);
    state(b, false, options);
    origin.of_second = io::convert(b, {b.unit == Unit::unknown ? Unit::unknown : a.unit,
                                       b.up == UpAxis::unknown ? UpAxis::unknown : a.up});
    if (is_named_by_file(a, name_a) && is_named_by_file(b, name_b)) b.parts[0].name = a.parts[0].name;
    auto settings = options.settings;
    settings.origin = origin;
    settings.maximum = limit_of(options.maximum, "--max", a.unit, line);
    settings.rms = limit_of(options.rms, "--rms", a.unit, line);
    settings.mean = limit_of(options.mean, "--mean", a.unit, line);
    out.comparison = report::compare(a, b, settings);
    out.comparison.left_out = std::move(notes.left_out);
    out.comparison.size_a = notes.size_a;
    out.comparison.size_b = notes.size_b;
    return out;
}

void tell_not_drawn(const std::vector<Diagnostic>& not_drawn, const Console& console) {
    for (const Diagnostic& warning : not_drawn) console.diagnostic(warning);
}

} // namespace facetmill::cli
