#include "cli/depfile.hpp"

#include "base/ordered_set.hpp"
#include "io/outputs/outputs.hpp"

namespace facetmill::cli {

std::string make_escaped(const std::string& path, bool target) {
    std::string text;
    std::size_t backslashes = 0;
    for (const char c : path) {
        if (c == '\n' || c == '\r')
            throw Error(ErrorKind::output, "E-DEPFILE",
                        "a depfile cannot contain a path with a line break: " + path,
                        "rename the file: Make and Ninja cannot express this path");
        // Make ends the targets at a colon, and takes a % in a target for a pattern. Backslashes before an
        // escaped character are doubled; elsewhere they are plain.
        if (c == ' ' || c == '#' || c == '\t' || c == ':' || (c == '%' && target))
            text.append(backslashes + 1, '\\');
        if (c == '$') text += '$';
        text += c;
        backslashes = c == '\\' ? backslashes + 1 : 0;
    }
    return text;
}

std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs) {
    std::string text = make_escaped(target, true) + ":";
    for (const auto& input : inputs) text += " \\\n  " + make_escaped(input, false);
    text += "\n";
    for (const auto& input : inputs)
        // Unescaped, a % would be a pattern for Make; escaped, it would be another file for Ninja.
        if (input.find('%') == input.npos) text += make_escaped(input, true) + ":\n";
    return text;
}

namespace {

/// The files of a run as Make and Ninja name them, without standard input and output.
class Paths {
  public:
    void add(const std::string& path) {
        if (path != "-") once_.add(path);
    }
    const std::vector<std::string>& all() const { return once_.all(); }

  private:
    OrderedSet<std::string> once_;
};

/// The possible targets, the best first.
std::vector<std::string> targets_of(const report::RunRecord& record, const std::string& depfile) {
    Paths paths;
    for (const bool mesh : {true, false})
        for (const auto& file : record.outputs)
            if (!mesh || !file.read_back.is_null()) paths.add(file.path);
    for (const auto& report : record.reports) paths.add(report);
    auto all = paths.all();
    all.push_back(depfile); // a pipeline of checks writes no files, so the depfile is the target
    return all;
}

} // namespace

void require_spellable(const std::string& target, const pipeline::Plan& plan) {
    if (!target.empty()) make_escaped(target, true);
    const auto outputs = pipeline::planned_outputs(plan);
    if (target.empty() && !outputs.empty()) make_escaped(outputs.front().generic_string(), true);
    for (const auto& file : pipeline::planned_inputs(plan)) make_escaped(file.generic_string(), false);
}

void write_depfile(const std::string& depfile, const std::string& target, const std::string& pipeline_file,
                   const pipeline::Plan& plan, const report::RunRecord& record) {
    Paths inputs;
    if (!pipeline_file.empty()) inputs.add(pipeline_file);
    for (const auto& file : record.inputs) inputs.add(file.path);
    for (const auto& file : pipeline::planned_inputs(plan))
        inputs.add(file.generic_string()); // a baseline ...
    const std::string text =
        depfile_text(target.empty() ? targets_of(record, depfile).front() : target, inputs.all());
    io::write_now(depfile, std::as_bytes(std::span(text)));
}

} // namespace facetmill::cli
