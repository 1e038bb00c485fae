#include "io/outputs/outputs.hpp"

#include "base/hash.hpp"
#include "io/outputs/clean_up.hpp"
#include "io/outputs/output_files.hpp"
#include "parallel/parallel.hpp"
#include "platform/file_bytes.hpp"
#include "platform/file_lock.hpp"
#include "platform/file_names.hpp"
#include "platform/temporary_files.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fmt/format.h>
#include <mutex>
#include <utility>

namespace facetmill::io {

namespace fs = std::filesystem;

namespace {

/// The limit for temporaries held open with a lock. Beyond it, only the process id shows that they are in
/// use.
constexpr std::size_t max_locks = 128;

[[noreturn]] void cannot_write(const Outputs::File& file, int error) {
    try {
        io::cannot_write(file.target, error);
    } catch (Error& e) {
        throw e.at(file.where);
    }
}

bool is_streamed(const Outputs::File& file) { return file.temporary.empty() && !file.is_input; }

void stream_out(const Outputs::File& file) {
    Descriptor to = file.target == "-"
                        ? Descriptor::standard_output()
                        : open_file(file.target, {.what = OpenFor::writing, .truncates = true});
    if (!to) cannot_write(file, errno);
    try {
        write_all(to, file.stream, file.target);
    } catch (Error& e) {
        throw e.at(file.where);
    }
    if (!to.close()) cannot_write(file, errno);
}

} // namespace

Outputs::~Outputs() { discard(); }

void Outputs::make_directory(const fs::path& directory) {
    std::error_code error;
    constexpr int max_attempts = 1000;
    for (int attempt = 0; !directory.empty() && !fs::is_directory(directory, error); ++attempt) {
        make_directory(directory.parent_path());
        if (make_folder(directory)) {
            made_directories_.push_back({directory, clean_up_directory(directory)});
            return;
        }
        const int why = errno;
        if (fs::is_directory(directory, error)) return;
        // A failed run may have removed this folder or a parent that it had made.
        const bool vanished =
            why == ENOENT || (why == EEXIST && !fs::exists(fs::symlink_status(directory, error)));
        if (vanished && attempt < max_attempts) continue;
        throw Error(ErrorKind::output, why == ENOSPC ? "E-SPACE" : "E-DIRECTORY",
                    fmt::format("the directory '{}' cannot be made: {}", directory.generic_string(),
                                why == EEXIST ? "a file has this name" : std::strerror(why)),
                    hint_to_write(directory, why));
    }
}

namespace {

/// Whether a run of this process recently cleaned the directory. Without this check, each of a thousand runs
/// would list the outputs of all.
bool swept_lately(const fs::path& directory) {
    static std::mutex guard;
    static std::map<fs::path, std::chrono::steady_clock::time_point> times;
    constexpr std::chrono::seconds a_while(10);
    const auto now = std::chrono::steady_clock::now();
    const std::lock_guard lock(guard);
    const auto [known, is_new] = times.emplace(directory, now);
    if (!is_new && now - known->second < a_while) return true;
    known->second = now;
    return false;
}

} // namespace

void Outputs::remove_stale(const fs::path& directory) {
    if (!swept_.insert(directory).second || swept_lately(directory)) return;
    remove_abandoned(directory);
}

void Outputs::stage(File& file, const std::function<void(const Put&)>& produce) {
    const fs::path directory = file.resolved.parent_path();
    constexpr int max_attempts = 1000;
    for (int attempt = 0;; ++attempt) {
        file.temporary = directory / temporary_name(file.resolved, attempt);
        file.clean_up = clean_up_file(file.temporary);
        file.lock = open_file(file.temporary, {.what = OpenFor::writing, .create = Create::always});
        if (file.lock) break;
        const int why = errno;
        keep(file.clean_up);
        if (attempt >= max_attempts || (why != EEXIST && why != ENOENT)) cannot_write(file, why);
        if (why == ENOENT) make_directory(directory); // a failed run had made it and then removed it
    }
    try {
        try_lock(file.lock);
        keep_permissions(file.lock, file.resolved, file.target);
        produce([&](Span bytes) { write_all(file.lock, bytes, file.target); });
        if (settings_.sync) begin_sync(file.lock);
        // Network file systems may report a full disk only on close. The other descriptor holds the lock.
        if (Descriptor copy = duplicate(file.lock); !copy || !copy.close()) cannot_write(file, errno);
    } catch (...) {
        file.lock.close();
        remove_file(file.temporary);
        keep(file.clean_up);
        throw;
    }
    if (files_.size() >= max_locks) file.lock.close();
}

namespace {

[[noreturn]] void refuse_input(const fs::path& target, const Mark& where) {
    throw Error(ErrorKind::output, "E-OVERWRITE",
                fmt::format("'{}' would overwrite an input", target.generic_string()),
                "give the output another name, or write elsewhere with --output-dir", where);
}

[[noreturn]] void refuse_twice(const fs::path& target) {
    throw Error(
        ErrorKind::output, "E-DUPLICATE-OUTPUT",
        fmt::format("'{}' is written twice in one run, with different contents", target.generic_string()),
        "give the second output another name or folder");
}

} // namespace

void Outputs::protect(const fs::path& input, std::string sum) {
    if (!is_stream(input)) inputs_.insert_or_assign(identity(input), std::move(sum));
}

std::unique_ptr<Outputs::File> Outputs::file_for(const fs::path& target, const Mark& where) const {
    if (is_reserved_name(target))
        throw Error(ErrorKind::output, "E-WRITE",
                    fmt::format("'{}' cannot be written: Windows does not allow this file name",
                                target.generic_string()),
                    "give another name, without : * ? \" < > |, that is no device such as NUL or AUX")
            .at(where);
    auto file = std::make_unique<File>();
    file->target = target;
    file->where = where;
    file->resolved = is_stream(target) ? target : followed(target);
    return file;
}

void Outputs::make_place(const File& file) {
    std::error_code error;
    if (file.target.filename().empty() || fs::is_directory(file.resolved, error))
        cannot_write(file.target, EISDIR);
    make_directory(file.resolved.parent_path());
    remove_stale(file.resolved.parent_path());
}

const Outputs::File& Outputs::add(const fs::path& target, const std::function<void(const Put&)>& produce,
                                  const Mark& where) {
    auto file = file_for(target, where);
    const fs::path self = identity(file->resolved);
    if (inputs_.contains(self)) refuse_input(target, where);
    if (by_identity_.contains(self)) refuse_twice(target);
    if (settings_.names_only) return hold(std::move(file), self);
    make_place(*file);
    Sha256 sum;
    stage(*file, [&](const Put& put) {
        produce([&](Span bytes) {
            sum.add(bytes);
            file->bytes += bytes.size();
            put(bytes);
        });
    });
    file->sha256 = sum.digest();
    return hold(std::move(file), self);
}

const Outputs::File& Outputs::add(const fs::path& target, Span bytes, const Mark& where) {
    auto file = file_for(target, where);
    const bool stream = is_stream(target);
    file->bytes = bytes.size();
    const fs::path self = stream ? target : identity(file->resolved);
    const auto input = inputs_.find(self);
    file->is_input = input != inputs_.end();
    const auto take_sum = [&] { file->sha256 = sha256(bytes); };
    const auto put_bytes = [&] { stage(*file, [&](const Put& put) { put(bytes); }); };
    if (!stream && !file->is_input && !by_identity_.contains(self) && !settings_.names_only) {
        make_place(*file);
        constexpr std::size_t few = std::size_t{1}
                                    << 16; // bytes; smaller files take less time than starting a thread
        parallel_for(
            2, [&](std::size_t i) { i == 0 ? take_sum() : put_bytes(); }, bytes.size() < few ? 2 : 1);
        return hold(std::move(file), self);
    }
    take_sum();
    if (file->is_input && input->second != file->sha256) refuse_input(target, where);
    if (const auto there = by_identity_.find(self); there != by_identity_.end()) {
        const File& other = *there->second;
        // Two glTF files in a folder may share textures.
        if (!stream && other.bytes == file->bytes && other.sha256 == file->sha256) return other;
        refuse_twice(target);
    }
    if (stream && !settings_.names_only) file->stream.assign(bytes.begin(), bytes.end());
    return hold(std::move(file), self);
}

const Outputs::File& Outputs::hold(std::unique_ptr<File> file, const fs::path& self) {
    by_identity_.emplace(self, file.get());
    return *files_.emplace_back(std::move(file));
}

Input Outputs::staged(const File& file) const {
    if (file.is_input) return Input::open(file.resolved);
    if (is_streamed(file)) return Input::of(file.target.generic_string(), file.stream);
    auto instead = std::make_shared<Input::Instead>();
    for (const auto& other : files_)
        if (!other->temporary.empty()) instead->emplace(other->target.lexically_normal(), other->temporary);
    return Input::open(file.temporary).staged_as(file.target, std::move(instead));
}

namespace {

template <class AllRenamed>
void put_back(const AllRenamed& all) {
    for (const auto& renamed : all) {
        if (renamed.aside.empty())
            remove_file(renamed.file->resolved);
        else
            rename_file(renamed.aside, renamed.file->resolved);
        keep(renamed.clean_up);
    }
}

} // namespace

/// Treats files that already have the right bytes like inputs, so that they stay unchanged.
void Outputs::leave_unchanged() {
    if (!settings_.keep_unchanged) return;
    for (const auto& file : files_) {
        std::error_code error;
        const auto& there = file->resolved;
        if (file->temporary.empty() || !fs::is_regular_file(there, error) ||
            fs::file_size(there, error) != file->bytes)
            continue;
        try {
            if (sha256(Input::open(there).stored()) != file->sha256) continue;
        } catch (const Error&) {
            continue; // an unreadable file is replaced
        }
        remove_file(file->temporary);
        keep(file->clean_up);
        file->clean_up = nullptr;
        file->temporary.clear();
        file->is_input = true;
    }
}

/// Flushes the contents of the files to be renamed to disk.
void Outputs::sync_contents() const {
    if (!settings_.sync) return;
    for (const auto& file : files_) {
        if (file->temporary.empty()) continue;
        const Descriptor again = file->lock ? Descriptor() : open_file(file->temporary);
        if (!file->lock && !again) cannot_write(*file, errno);
        if (!synced(file->lock ? file->lock : again)) cannot_write(*file, errno);
    }
}

/// Syncs the folders with new names. Failures are ignored (an unreadable folder, a failing disk), because
/// the files themselves are complete.
void Outputs::sync_names() const {
    if (!settings_.sync) return;
    std::set<fs::path> folders;
    for (const auto& file : files_)
        if (!file->temporary.empty()) folders.insert(file->resolved.parent_path());
    for (const auto& made : made_directories_) folders.insert(made.path.parent_path());
    for (const auto& folder : folders) {
        const Descriptor names = open_file(folder.empty() ? "." : folder, {.is_folder = true});
        if (names) synced(names);
    }
}

std::vector<Outputs::Renamed> Outputs::rename_all(bool streams_follow) {
    std::vector<Renamed> all;
    try {
        for (const auto& file : files_) {
            if (file->temporary.empty()) continue;
            fs::path aside = files_.size() > 1 ? set_aside(file->resolved) : fs::path();
            if (!rename_file(file->temporary, file->resolved)) {
                const int why = errno;
                std::error_code ignored;
                fs::remove(aside, ignored);
                cannot_write(*file, why);
            }
            all.push_back({file.get(), std::move(aside)});
        }
    } catch (...) {
        put_back(all);
        forget(true);
        throw;
    }
    sync_names();
    for (auto& renamed : all) {
        keep(renamed.file->clean_up); // the temporary has its final name now
        if (!streams_follow) continue;
        const fs::path& path = renamed.file->resolved;
        renamed.clean_up =
            renamed.aside.empty() ? clean_up_file(path) : clean_up_restore(renamed.aside, path);
    }
    return all;
}

void Outputs::settle(const std::vector<Renamed>& all) {
    for (const auto& renamed : all) {
        std::error_code ignored;
        keep(renamed.clean_up);
        if (!renamed.aside.empty()) fs::remove(renamed.aside, ignored);
    }
    for (const auto& directory : made_directories_) keep(directory.clean_up);
    made_directories_.clear();
    forget(false);
}

void Outputs::commit() {
    const bool streams =
        std::any_of(files_.begin(), files_.end(), [](const auto& f) { return is_streamed(*f); });
    std::vector<Renamed> all;
    leave_unchanged(); // reading may take long for large files, so do it before signals wait
    sync_contents();   // writing to disk may take long, too
    {
        const HoldSignals hold;
        all = rename_all(streams);
        if (!streams) return settle(all);
    }
    try {
        for (const auto& file : files_)
            if (is_streamed(*file)) stream_out(*file);
    } catch (...) {
        const HoldSignals hold;
        put_back(all);
        forget(true);
        throw;
    }
    const HoldSignals hold;
    settle(all);
}

void Outputs::forget(bool remove) {
    for (const auto& file : files_) {
        if (remove && !file->temporary.empty()) remove_file(file->temporary);
        file->lock.close();
        keep(file->clean_up);
    }
    files_.clear();
    by_identity_.clear();
    for (auto it = made_directories_.rbegin(); it != made_directories_.rend(); ++it) {
        if (remove) remove_folder(it->path);
        keep(it->clean_up);
    }
    made_directories_.clear();
}

void Outputs::discard() { forget(true); }

void write_now(const fs::path& target, Span bytes, const CommitSettings& settings) {
    Outputs outputs;
    outputs.set(settings);
    outputs.add(target, bytes);
    outputs.commit();
}

} // namespace facetmill::io
