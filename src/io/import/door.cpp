#include "io/import/door.hpp"

#include "base/math/numbers.hpp"
#include "io/flatten.hpp"
#include "io/import/import.hpp"
#include "io/packing.hpp"
#include "parallel/loop_check.hpp"
#include "parallel/memory.hpp"
#include "parallel/memory_limit.hpp"
#include "platform/confined_program.hpp"
#include "platform/cores.hpp"
#include "platform/file_names.hpp"
#include "platform/sandbox.hpp"
#include "platform/worker_pool.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <mutex>
#include <set>

namespace facetmill::io {

namespace {

namespace fs = std::filesystem;

// --- messages between the two processes

struct OrderHeader {
    std::uint64_t memory, most_output, bytes;
    std::uint32_t seconds, texts; ///< the program, then the arguments, then the paths
    std::uint32_t arguments;
    std::uint32_t is_limit; ///< 1: the texts are all files and folders that later orders may name
};

enum class Kind : std::uint64_t { data, good, bad, not_started };

struct AnswerHeader {
    Kind kind; ///< data: a piece of the stream follows; otherwise it ended, and a message follows
    std::uint64_t bytes;
};

bool send_text(const Descriptor& socket, std::string_view text) {
    const std::uint64_t size = text.size();
    return send_all(socket, &size, sizeof size) && send_all(socket, text.data(), text.size());
}

bool receive_text(const Descriptor& socket, std::string& text) {
    constexpr std::uint64_t most = 1 << 20;
    std::uint64_t size = 0;
    if (!receive_all(socket, &size, sizeof size) || size > most) return false;
    text.resize(size);
    return receive_all(socket, text.data(), size);
}

bool answer(const Descriptor& socket, Kind kind, std::string_view bytes) {
    const AnswerHeader header{kind, bytes.size()};
    return send_all(socket, &header, sizeof header) && send_all(socket, bytes.data(), bytes.size());
}

// --- the worker process

bool finish(const Descriptor& socket, Kind kind, std::string_view bytes) {
    return answer(socket, kind, bytes) && WorkerPool::order_ends(socket);
}

/// The reason why the program gave no result; empty if it gave one.
std::string problem_of(const ConfinedEnd& end, const ConfinedProgram& settings) {
    using How = ProgramEnd::How;
    if (end.too_much) return fmt::format("it gave more than {} bytes and was ended", settings.most_output);
    if (end.how == How::late)
        return fmt::format("it took more than {} s (FACETMILL_IMPORT_SECONDS) and was ended",
                           settings.limit.count());
    if (end.how == How::deserted) return "it was ended";
    const std::string tail = end.said.empty() ? "" : ": " + end.said;
    if (end.how == How::by_signal) return fmt::format("it crashed (signal {}){}", end.number, tail);
    constexpr int no_program = 127; // of exec and of the loader
    if (end.number == no_program) return fmt::format("it or one of its libraries cannot be loaded{}", tail);
    if (end.number != 0) return fmt::format("it failed (exit code {}){}", end.number, tail);
    return {};
}

/// The files and folders that orders may name.
class Readable {
  public:
    [[nodiscard]] bool is_limited() const { return real_.has_value(); }

    void limit(const std::vector<std::string>& paths) {
        real_.emplace();
        for (const fs::path path : paths) {
            std::error_code failed;
            if (const fs::path real = fs::weakly_canonical(path, failed); !failed) real_->insert(real);
        }
    }

    [[nodiscard]] bool covers(const fs::path& path) const {
        if (!real_) return true;
        std::error_code failed;
        fs::path real = fs::weakly_canonical(path, failed);
        while (!failed && real_->count(real) == 0 && real.has_relative_path()) real = real.parent_path();
        return !failed && real_->count(real) > 0;
    }

  private:
    std::optional<std::set<fs::path>> real_; ///< without a limit, only the sandbox of a helper decides
};

std::optional<std::vector<std::string>> receive_texts(const Descriptor& socket, std::uint32_t count) {
    std::vector<std::string> texts;
    for (std::string text; count > 0; --count) {
        if (!receive_text(socket, text)) return {};
        texts.push_back(std::move(text));
    }
    return texts;
}

/// Serves an order. False if the client has ended or sends nonsense.
bool serve(const Descriptor& socket, Readable& readable) {
    OrderHeader order{};
    constexpr std::uint32_t most_texts = 1000;
    if (!receive_all(socket, &order, sizeof order)) return false;
    if (order.is_limit != 0) {
        const auto paths = receive_texts(socket, order.texts);
        if (!paths || readable.is_limited()) return false; // a limit is final
        readable.limit(*paths);
        return true;
    }
    if (order.texts > most_texts || order.texts == 0 || order.arguments >= order.texts) return false;
    const auto received = receive_texts(socket, order.texts);
    if (!received) return false;
    const auto& texts = *received;
    Bytes bytes(order.bytes);
    if (!receive_all(socket, bytes.data(), bytes.size())) return false;
    const Descriptor file = file_in_memory(bytes);
    bytes = Bytes();
    const auto& known = import::helper_names;
    if (std::find(known.begin(), known.end(), texts.front()) == known.end()) return false;
    const auto program = import::helper_program(texts.front());
    const auto first_path = texts.begin() + 1 + order.arguments;
    ConfinedProgram settings{{}, {texts.begin() + 1, first_path}, {first_path, texts.end()}};
    std::erase_if(settings.read, [&](const fs::path& path) { return !readable.covers(path); });
    if (!program || !file) return finish(socket, Kind::not_started, program ? "no memory" : "it is missing");
    settings.program = *program;
    settings.memory = order.memory;
    settings.most_output = order.most_output;
    settings.limit = std::chrono::seconds(order.seconds);
    const ConfinedEnd end = run_confined(settings, file, socket, [&](std::span<const std::byte> piece) {
        (void)answer(socket, Kind::data, as_text(piece)); // a client that has ended is noticed later
    });
    if (end.how == ProgramEnd::How::not_started)
        return finish(socket, Kind::not_started, std::strerror(end.number));
    const std::string problem = problem_of(end, settings);
    return finish(socket, problem.empty() ? Kind::good : Kind::bad, problem);
}

// --- the client process

WorkerPool& workers() {
    static WorkerPool all;
    return all;
}

[[noreturn]] void refuse(const Input& input, const std::string& why, ErrorKind kind = ErrorKind::malformed) {
    constexpr std::size_t most = 500;
    const std::string text = why.size() > most ? "..." + why.substr(why.size() - most) : why;
    throw Error(kind, "E-IMPORT", fmt::format("'{}' cannot be read: {}", input.name(), one_line(text)),
                "open it in the program that made it, and export it as glTF (.glb) or STL",
                file_mark(input.name()));
}

/// The bytes that a helper may allocate: half of the available memory. The memory limit of a run
/// applies to this process and the helper together.
std::uint64_t memory_allowed() {
    constexpr std::uint64_t usual_least = std::uint64_t{1} << 30;
    constexpr std::uint64_t to_start = std::uint64_t{256}
                                       << 20; // address space of a helper and its libraries
    const std::uint64_t half = memory_there() / 2;
    if (memory_limit() == 0) return std::max(half, usual_least);
    return std::max(std::min(half, memory_left().value_or(half)), to_start);
}

/// The seconds that a helper may take; FACETMILL_IMPORT_SECONDS replaces the usual limit.
std::uint32_t seconds_allowed() {
    constexpr int usual = 600, most = 86400;
    const char* given = std::getenv("FACETMILL_IMPORT_SECONDS");
    if (!given || !*given) return usual;
    const auto seconds = parse_integer(given);
    if (!seconds || *seconds < 1 || *seconds > most)
        throw Error(ErrorKind::usage, "E-ARGUMENT",
                    fmt::format("FACETMILL_IMPORT_SECONDS must be between 1 and {}, found '{}'", most, given),
                    "unset it to allow 600 seconds");
    return static_cast<std::uint32_t>(*seconds);
}

bool send_order(const Descriptor& socket, const Input& input, const import::DoorOrder& order) {
    OrderHeader header{};
    header.memory = memory_allowed();
    header.most_output = most_unpacked(input.bytes().size()); // a file is a kind of packing
    header.bytes = input.bytes().size();
    header.seconds = seconds_allowed();
    header.arguments = static_cast<std::uint32_t>(order.arguments.size());
    header.texts = static_cast<std::uint32_t>(1 + order.arguments.size() + order.read.size());
    bool sent = send_all(socket, &header, sizeof header) && send_text(socket, order.program);
    for (const auto& text : order.arguments) sent = sent && send_text(socket, text);
    for (const auto& path : order.read) sent = sent && send_text(socket, path.string());
    return sent && send_all(socket, input.bytes().data(), input.bytes().size());
}

/// The stream of the helper, after its end.
Bytes received(WorkerPool::Loan& loan, const Input& input, const std::string& program) {
    Bytes stream;
    const std::uint64_t most = memory_there();
    for (;;) {
        AnswerHeader header{};
        loan.wait();
        const bool came = receive_all(*loan.socket(), &header, sizeof header) && header.bytes <= most &&
                          stream.size() + header.bytes <= most;
        const std::size_t before = stream.size();
        if (came) stream.resize(before + header.bytes);
        if (!came || !receive_all(*loan.socket(), stream.data() + before, header.bytes)) {
            loan.drop();
            refuse(input, fmt::format("the process that runs {} was ended", program));
        }
        if (header.kind == Kind::data) continue;
        const std::string problem(as_text(Span(stream).subspan(before)));
        stream.resize(before);
        loan.end();
        if (header.kind == Kind::good) return stream;
        const bool started = header.kind == Kind::bad;
        refuse(input,
               fmt::format("{} {}: {}", program, started ? "gave no result" : "cannot be started", problem),
               started ? ErrorKind::malformed : ErrorKind::missing);
    }
}

} // namespace

void start_import_workers() {
    const auto& names = import::helper_names;
    const auto is_there = [](const char* name) { return import::helper_program(name).has_value(); };
    if (std::none_of(names.begin(), names.end(), is_there)) return;
    constexpr int most = 4; // each helper may need much memory
    workers().start(std::min(most, default_threads()), [](const Descriptor& socket) {
        Readable readable;
        while (serve(socket, readable)) {
        }
    });
}

void limit_import_workers(const std::vector<fs::path>& readable) {
    std::set<std::string> paths; // a batch names the same folder for many assets
    for (const fs::path& path : readable) paths.insert(path.string());
    OrderHeader header{};
    header.is_limit = 1;
    header.texts = static_cast<std::uint32_t>(paths.size());
    workers().for_each([&](const Descriptor& socket) {
        // A worker that has ended refuses its next order.
        bool sent = send_all(socket, &header, sizeof header);
        for (const std::string& path : paths) sent = sent && send_text(socket, path);
    });
}

namespace import {

std::optional<fs::path> helper_program(const std::string& name) {
    if (!has_workers()) return {}; // nothing could start it
    std::vector<fs::path> folders;
    if (const char* given = std::getenv("FACETMILL_IMPORTERS"); given && *given) {
        folders = {given};
    } else if (const fs::path own = executable().parent_path(); !own.empty()) {
        folders = {own, own / "../libexec/facetmill"};
    }
    for (const fs::path& folder : folders) {
        std::error_code failed;
        const fs::path file = fs::absolute(folder / name, failed);
        if (!failed && fs::is_regular_file(file, failed) && may_run(file)) return file;
    }
    return {};
}

Answer ask_helper(const Input& input, const DoorOrder& order) {
    if (!active_protections().calls) start_import_workers();
    // Under a limit of memory, helpers run one after another, and each may use all that is left.
    static std::timed_mutex alone;
    std::unique_lock one(alone, std::defer_lock);
    constexpr std::chrono::milliseconds between_checks(100);
    while (memory_limit() > 0 && !one.try_lock_for(between_checks)) check_loop_now();
    WorkerPool::Loan loan(workers(), check_loop_now);
    if (!loan.socket()) refuse(input, order.program + " cannot be started", ErrorKind::missing);
    if (!send_order(*loan.socket(), input, order)) {
        loan.drop();
        refuse(input, fmt::format("the process that runs {} was ended", order.program));
    }
    Bytes stream = received(loan, input, order.program);
    constexpr std::string_view magic = "FMIMPORT";
    constexpr std::size_t size_bytes = 8, head = magic.size() + size_bytes;
    if (stream.size() < head || as_text(Span(stream).first(magic.size())) != magic)
        refuse(input, order.program + " gave no stream of glTF");
    const std::uint64_t size = little_endian(stream, magic.size(), size_bytes);
    if (size > stream.size() - head) refuse(input, order.program + " gave a truncated stream");
    Answer result{parse_json(as_text(Span(stream).subspan(head, size)), Broken::discarded), {}};
    stream.erase(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(head + size));
    result.glb = std::move(stream);
    if (!result.notes.is_object()) refuse(input, order.program + " gave malformed notes");
    if (result.notes.contains("error") && result.notes["error"].is_string())
        refuse(input, result.notes["error"].get<std::string>());
    return result;
}

} // namespace import

} // namespace facetmill::io
