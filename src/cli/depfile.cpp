#include "cli/depfile.hpp"

#include "io/outputs.hpp"

#include <algorithm>

namespace facetmill::cli {

std::string make_spelling(const std::string& path, bool target) {
    std::string text;
    std::size_t backslashes = 0;
    for (const char c : path) {
        if (c == '\n' || c == '\r')
            throw Error(ErrorKind::output, "E-DEPFILE",
                        "a depfile cannot name a path with a line break: " + path);
        // A colon would end the targets, and a % among them make a pattern. Backslashes before one of these
        // would escape it, so they are doubled; elsewhere they are plain.
        if (c == ' ' || c == '#' || c == '\t' || c == ':' || (c == '%' && target))
            text.append(backslashes + 1, '\\');
        if (c == '$') text += '$';
        text += c;
        backslashes = c == '\\' ? backslashes + 1 : 0;
    }
    return text;
}

std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs) {
    std::string text = make_spelling(target, true) + ":";
    for (const auto& input : inputs) text += " \\\n  " + make_spelling(input, false);
    text += "\n";
    for (const auto& input : inputs) text += make_spelling(input, true) + ":\n";
    return text;
}

namespace {

void add_once(std::vector<std::string>& all, const std::string& path) {
    if (path != "-" && std::find(all.begin(), all.end(), path) == all.end()) all.push_back(path);
}

} // namespace

void write_depfile(const std::string& depfile, const report::RunRecord& record, const std::string& pipeline,
                   const std::string& target) {
    std::vector<std::string> outputs, inputs;
    for (const bool mesh : {true, false})
        for (const auto& file : record.outputs)
            if (!mesh || !file.read_back.is_null()) add_once(outputs, file.path);
    for (const auto& report : record.reports) add_once(outputs, report);
    outputs.push_back(depfile); // a gate writes nothing; its rule is for the depfile itself
    if (!pipeline.empty()) add_once(inputs, pipeline);
    for (const auto& file : record.inputs) add_once(inputs, file.path);
    for (const auto& file : record.absent) add_once(inputs, file); // when it appears, the run is due again
    const std::string text = depfile_text(target.empty() ? outputs.front() : target, inputs);
    io::write_now(depfile, std::as_bytes(std::span(text)));
}

} // namespace facetmill::cli
