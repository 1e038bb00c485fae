#include "batch/journal.hpp"

#include "base/hash.hpp"
#include "base/json.hpp"
#include "io/bytes.hpp"
#include "io/outputs/output_files.hpp"
#include "io/outputs/outputs.hpp"
#include "platform/file_bytes.hpp"
#include "platform/file_lock.hpp"
#include "platform/file_names.hpp"
#include "platform/file_status.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::batch {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = ".facetmill-batch.", suffix = ".jsonl";

Json stamps_json(const std::vector<Stamp>& stamps) {
    Json all = Json::array();
    for (const auto& s : stamps) all.push_back({s.path, s.bytes, s.time, s.sha256});
    return all;
}

std::vector<Stamp> stamps_from(const Json& json) {
    std::vector<Stamp> all;
    for (const auto& one : json)
        all.push_back({one.at(0).get<std::string>(), one.at(1).get<std::uint64_t>(),
                       one.at(2).get<std::int64_t>(), one.at(3).get<std::string>()});
    return all;
}

Json number_json(const std::optional<std::uint64_t>& number) {
    return number ? Json(*number) : Json(nullptr);
}

std::optional<std::uint64_t> number_from(const Json& json) {
    return json.is_null() ? std::nullopt : std::optional(json.get<std::uint64_t>());
}

Json files_json(const std::vector<OutcomeFile>& files) {
    Json all = Json::array();
    for (const auto& f : files)
        all.push_back(
            {f.path, f.bytes, number_json(f.faces), number_json(f.draw_calls), number_json(f.pixels)});
    return all;
}

std::vector<OutcomeFile> files_from(const Json& json) {
    std::vector<OutcomeFile> all;
    for (const auto& one : json)
        all.push_back({one.at(0).get<std::string>(), one.at(1).get<std::uint64_t>(), number_from(one.at(2)),
                       number_from(one.at(3)), number_from(one.at(4))});
    return all;
}

Json done_json(const Done& done) {
    Json json = {{"asset", done.asset},
                 {"digest", done.digest},
                 {"source", done.source},
                 {"mount_point", done.mount_point},
                 {"of_table", done.of_table},
                 {"inputs", stamps_json(done.inputs)},
                 {"outputs", stamps_json(done.outputs)},
                 {"absent", done.absent},
                 {"former", done.former},
                 {"written", done.written},
                 {"warnings", done.warnings},
                 {"picture", done.picture},
                 {"pictured", done.pictured}};
    for (const Column& column : columns())
        if (!column.of_model || done.figures.model.measured())
            if (const auto value = column.value(done.figures)) json[column.key] = *value;
    if (done.figures.model.measured()) json["unit"] = done.figures.model.unit;
    json["files"] = files_json(done.files);
    if (done.deviation) json["deviation"] = *done.deviation;
    if (!done.measured.empty()) json["measured"] = done.measured;
    return json;
}

Done done_from(const Json& json) {
    Done done;
    json.at("asset").get_to(done.asset);
    json.at("digest").get_to(done.digest);
    json.at("source").get_to(done.source);
    done.mount_point = json.value("mount_point", "");
    json.at("of_table").get_to(done.of_table);
    done.inputs = stamps_from(json.at("inputs"));
    done.outputs = stamps_from(json.at("outputs"));
    json.at("absent").get_to(done.absent);
    json.at("former").get_to(done.former);
    done.measured = json.value("measured", "");
    if (const auto files = json.find("files"); files != json.end()) done.files = files_from(*files);
    if (const auto most = json.find("deviation"); most != json.end()) done.deviation = most->get<double>();
    for (const Column& column : columns()) { // another release may lack some columns
        if (column.of_model && done.measured.empty()) continue;
        const auto value = json.find(column.key);
        column.set(done.figures,
                   value == json.end() ? std::optional<double>() : std::optional(value->get<double>()));
    }
    done.figures.model.unit = json.value("unit", "");
    json.at("written").get_to(done.written);
    json.at("warnings").get_to(done.warnings);
    json.at("picture").get_to(done.picture);
    done.pictured = json.value("pictured", !done.picture.empty());
    return done;
}

/// Skips truncated lines, which a killed process leaves.
template <class Take>
void for_each_done(std::string_view text, Take&& take) {
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        try {
            take(done_from(parse_json(text.substr(0, end))));
        } catch (const Json::exception&) {
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

/// True if the file is unchanged; updates its stamp. Files with another time are read.
bool is_as_it_was(const fs::path& file, Stamp& stamp, bool& renewed) {
    const auto now = stamp_of(file);
    if (!now || now->bytes != stamp.bytes) return false;
    if (now->time != 0 && now->time == stamp.time) return true;
    try {
        if (sha256(io::Input::open(file).stored()) != stamp.sha256) return false;
    } catch (const Error&) {
        return false;
    }
    renewed = renewed || now->time != stamp.time;
    stamp.time = now->time;
    return true;
}

} // namespace

std::optional<Stamp> stamp_of(const fs::path& file) {
    const auto about = status_of(file);
    if (!about || about->kind != FileKind::regular) return {};
    // Kernels update file times in ticks of up to 10 ms, some file systems in steps of 2 s.
    constexpr std::int64_t recent = 2'000'000'000;
    const std::int64_t time = about->stamp.modified;
    const bool settled = nanoseconds_now() - time > recent;
    return Stamp{file.generic_string(), about->stamp.bytes, settled ? time : 0, {}};
}

fs::path Journal::path_in(const fs::path& folder, const std::string& name) {
    std::error_code ignored;
    const bool is_file = name != "-" && fs::exists(name, ignored); // else a built-in pipeline
    const std::string stem = name == "-" ? "stdin" : fs::path(name).stem().generic_string();
    const std::string place =
        is_file
            ? fs::relative(fs::canonical(name), fs::weakly_canonical(fs::absolute(folder))).generic_string()
            : name;
    constexpr std::size_t digits = 8;
    return folder / fmt::format("{}{}-{}{}", prefix, stem,
                                sha256(std::as_bytes(std::span(place))).substr(0, digits), suffix);
}

std::vector<std::string> Journal::assets_in(const fs::path& folder, const std::string& name) {
    std::vector<std::string> assets;
    std::error_code ignored;
    const fs::path path = path_in(folder, name);
    if (!fs::exists(path, ignored)) return assets;
    const auto input = io::Input::open(path);
    for_each_done(io::as_text(input.bytes()), [&](Done done) { assets.push_back(std::move(done.asset)); });
    return assets;
}

Journal::Journal(const fs::path& folder, const std::string& name)
    : folder_(folder), path_(path_in(folder, name)) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw Error(
            ErrorKind::output, "E-DIRECTORY",
            fmt::format("the directory '{}' cannot be made: {}", folder.generic_string(), error.message()),
            io::hint_to_write(folder, error.value()));
    open_locked();
    read();
}

void Journal::open_locked() {
    while (true) {
        file_ = open_file(path_, {.what = OpenFor::both, .create = Create::if_missing, .appends = true});
        if (!file_)
            throw Error(
                ErrorKind::output, "E-WRITE",
                fmt::format("'{}' cannot be written: {}", path_.generic_string(), std::strerror(errno)),
                "a batch records its progress in this folder; choose another one with --output-dir");
        if (!try_lock(file_))
            throw Error(
                ErrorKind::output, "E-BUSY",
                fmt::format("another batch of this pipeline is running in '{}'", folder_.generic_string()),
                "wait until it ends, or choose another folder with --output-dir");
        const auto held = FileStamp::of(file_), named = FileStamp::of(path_);
        if (held && named && held->is_same_file(*named)) return;
        file_.close(); // a batch that just ended has replaced the file
    }
}

void Journal::read() {
    const auto input = io::Input::open(path_);
    const std::string_view text = io::as_text(input.bytes());
    for_each_done(text, [&](Done done) { all_.insert_or_assign(done.asset, std::move(done)); });
    if (!text.empty() && !text.ends_with('\n')) static_cast<void>(write_some(file_, io::bytes_of_text("\n")));
}

std::set<std::string> Journal::outputs_of_others() const {
    std::set<std::string> all;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
        const std::string name = entry.path().filename().generic_string();
        if (!name.starts_with(prefix) || !name.ends_with(suffix) || name == path_.filename()) continue;
        const auto input = io::Input::open(entry.path());
        for_each_done(io::as_text(input.bytes()), [&](const Done& done) {
            for (const auto& output : done.outputs) all.insert(output.path);
        });
    }
    return all;
}

const Done* Journal::unchanged(const std::string& asset, const std::string& digest) {
    const auto found = all_.find(asset);
    if (found == all_.end() || found->second.digest.empty() || found->second.digest != digest) return nullptr;
    Done& done = found->second;
    bool renewed = false;
    std::error_code ignored;
    for (const auto& path : done.absent)
        if (fs::exists(path, ignored)) return nullptr;
    for (auto& input : done.inputs)
        if (!is_as_it_was(input.path, input, renewed)) return nullptr;
    for (auto& output : done.outputs)
        if (!is_as_it_was(folder_ / output.path, output, renewed)) return nullptr;
    return &done;
}

std::optional<Diagnostic> Journal::unwritable(int error) {
    if (std::exchange(told_, true)) return {};
    return Diagnostic{Severity::warning,
                      "W-STATE",
                      fmt::format("the progress cannot be recorded in '{}': {}", path_.generic_string(),
                                  std::strerror(error)),
                      {},
                      "the next batch will process these assets again"};
}

std::optional<Diagnostic> Journal::add(Done done) {
    if (const auto before = all_.find(done.asset); before != all_.end()) {
        done.former = before->second.former;
        for (const auto& output : before->second.outputs)
            done.former.emplace_back(output.path, output.sha256);
    }
    std::erase_if(done.former, [&](const auto& former) {
        return std::any_of(done.outputs.begin(), done.outputs.end(),
                           [&](const Stamp& output) { return output.path == former.first; });
    });
    std::string line;
    try {
        line = done_json(done).dump() + "\n";
    } catch (const Json::exception&) {
        return {}; // a name that is not UTF-8: the asset will run again
    }
    const auto n = write_some(file_, std::as_bytes(std::span(line)));
    const int error = n ? ENOSPC : errno;
    all_.insert_or_assign(done.asset, std::move(done));
    if (n == line.size()) return {};
    return unwritable(error);
}

bool Journal::remove_output(const std::string& path, const std::string& sha) {
    const fs::path file = folder_ / path;
    Stamp stamp;
    stamp.sha256 = sha;
    const auto now = stamp_of(file);
    std::error_code ignored;
    if (!now || fs::is_symlink(file, ignored)) return false; // batches never write links
    stamp.bytes = now->bytes;
    bool renewed = false;
    if (!is_as_it_was(file, stamp, renewed)) return false;
    std::error_code error;
    if (!fs::remove(file, error)) return false;
    for (fs::path above = fs::path(path).parent_path(); !above.empty(); above = above.parent_path())
        if (!fs::remove(folder_ / above, error)) break; // not empty
    return true;
}

std::vector<std::string> Journal::remove_former(const std::string& asset,
                                                const std::set<std::string>& current) {
    std::vector<std::string> removed;
    const auto found = all_.find(asset);
    if (found == all_.end()) return removed;
    for (const auto& [path, sha] : std::exchange(found->second.former, {}))
        if (!current.contains(path) && remove_output(path, sha)) removed.push_back(path);
    return removed;
}

std::vector<std::string> Journal::remove_all(const std::string& asset, const std::set<std::string>& current) {
    const auto found = all_.find(asset);
    if (found == all_.end()) return {};
    for (const auto& output : found->second.outputs)
        found->second.former.emplace_back(output.path, output.sha256);
    auto removed = remove_former(asset, current);
    all_.erase(asset);
    return removed;
}

std::optional<Diagnostic> Journal::compact() {
    std::string text;
    for (const auto& [asset, done] : all_) {
        try {
            text += done_json(done).dump() + "\n";
        } catch (const Json::exception&) { // a name that is not UTF-8, as in add
        }
    }
    const fs::path part = path_.generic_string() + ".part";
    Descriptor file = open_file(
        part, {.what = OpenFor::both, .create = Create::if_missing, .truncates = true, .appends = true});
    if (!file) return unwritable(errno);
    try_lock(file); // the file has no name that others could use
    const auto n = write_some(file, std::as_bytes(std::span(text)));
    if (n != text.size() || !rename_file(part, path_)) {
        const int error = n ? ENOSPC : errno;
        file.close();
        remove_file(part);
        return unwritable(error);
    }
    file_ = std::move(file);
    return {};
}

} // namespace facetmill::batch
