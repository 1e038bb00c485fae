#include "io/images/ktx_workers.hpp"

#include "parallel/loop_check.hpp"
#include "platform/cores.hpp"
#include "platform/file_names.hpp"
#include "platform/run_program.hpp"
#include "platform/sandbox.hpp"
#include "platform/temporary_files.hpp"
#include "platform/worker_pool.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace facetmill::io {

namespace fs = std::filesystem;

namespace {

// --- messages between the two processes

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30; // maximum size of an image or a result

struct OrderMessage {
    std::uint8_t uastc, srgb, alpha, quality;
    std::uint32_t seconds;
    std::uint64_t bytes; ///< size of the PNG that follows
};
struct AnswerMessage {
    std::uint64_t good;  ///< 1: a file follows; 0: an error message follows
    std::uint64_t bytes; ///< bytes that follow
};

// --- the worker process

bool is_toktx(const fs::path& program) { return program.filename().generic_string().starts_with("toktx"); }

std::vector<std::string> common_arguments(const OrderMessage& order, const char* quality_option,
                                          const char* uastc_option) {
    constexpr int best = 255;
    if (order.uastc != 0) return {"--encode", "uastc", uastc_option, "2"};
    return {"--encode", "etc1s",        "--clevel",
            "2",        quality_option, std::to_string(std::max(1, order.quality * best / 100))};
}

std::vector<std::string> arguments_of_toktx(const OrderMessage& order) {
    std::vector<std::string> all{"--t2", "--genmipmap", "--threads", "1"};
    for (auto& argument : common_arguments(order, "--qlevel", "--uastc_quality")) all.push_back(argument);
    if (order.uastc != 0) all.insert(all.end(), {"--zcmp", "18"});
    all.insert(all.end(), {"--assign_oetf", order.srgb != 0 ? "srgb" : "linear", "--assign_primaries",
                           order.srgb != 0 ? "bt709" : "none", "--target_type",
                           order.alpha != 0 ? "RGBA" : "RGB", "out.ktx2", "in.png"});
    return all;
}

/// Before version 4.4, ktx has another option for the transfer function.
std::vector<std::string> arguments_of_ktx(const OrderMessage& order, bool is_old) {
    std::vector<std::string> all{"create", "--generate-mipmap", "--threads", "1"};
    for (auto& argument : common_arguments(order, "--qlevel", "--uastc-quality"))
        all.push_back(argument == "etc1s" ? "basis-lz" : argument);
    if (order.uastc != 0) all.insert(all.end(), {"--zstd", "18"});
    all.insert(all.end(),
               {"--format",
                fmt::format("R8G8B8{}_{}", order.alpha != 0 ? "A8" : "", order.srgb != 0 ? "SRGB" : "UNORM"),
                is_old ? "--assign-oetf" : "--assign-tf", order.srgb != 0 ? "srgb" : "linear",
                "--assign-primaries", order.srgb != 0 ? "bt709" : "none", "in.png", "out.ktx2"});
    return all;
}

std::string contents_of(const char* file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The last line with text, for a message.
std::string last_line(const std::string& log) {
    constexpr std::size_t most = 300;
    std::string line, last;
    std::istringstream lines(log);
    while (std::getline(lines, line))
        if (line.find_first_not_of(" \t\r") != line.npos) last = line;
    std::replace_if(
        last.begin(), last.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return last.substr(0, most);
}

/// Runs the program in the working directory. Returns the error, or an empty text.
std::string problem_of(const ProgramSettings& settings, const Descriptor& socket) {
    using How = ProgramEnd::How;
    const auto [how, number] = run_program(settings, socket);
    if (how == How::not_started) return fmt::format("cannot be started: {}", std::strerror(number));
    if (how == How::late) return fmt::format("took longer than {} s and was ended", settings.limit.count());
    if (how == How::deserted) return "was ended";
    const std::string said = last_line(contents_of("log"));
    const std::string tail = said.empty() ? "" : ": " + said;
    if (how == How::by_signal) return fmt::format("was ended by signal {}{}", number, tail);
    if (number != 0) return fmt::format("failed with exit code {}{}", number, tail);
    return {};
}

/// The version text looks like "ktx version: v4.3.2".
bool is_before_4_4(const std::string& version) {
    const auto at = version.find_first_of("0123456789");
    int major = 0, minor = 0;
    return at != version.npos && std::sscanf(version.c_str() + at, "%d.%d", &major, &minor) == 2 &&
           (major < 4 || (major == 4 && minor < 4));
}

/// Serves orders until the client has ended.
class Worker {
  public:
    Worker(fs::path program, const Descriptor& socket) : program_(std::move(program)), socket_(socket) {}

    void run() {
        OrderMessage order{};
        while (receive_all(socket_, &order, sizeof order) && order.bytes <= most_bytes) {
            Bytes png(order.bytes);
            if (!receive_all(socket_, png.data(), png.size())) break;
            std::string problem =
                prepared() ? "" : "has no folder to work in: " + std::string(std::strerror(errno));
            std::string file;
            if (problem.empty()) problem = encode(order, png, file);
            const std::string& text = problem.empty() ? file : problem;
            const AnswerMessage answer{problem.empty() ? 1U : 0U, text.size()};
            if (!send_all(socket_, &answer, sizeof answer) || !send_all(socket_, text.data(), text.size()) ||
                !WorkerPool::order_ends(socket_))
                break;
        }
        std::error_code ignored;
        if (!folder_.empty()) fs::remove_all(folder_, ignored);
    }

  private:
    /// Makes and enters the program's working folder.
    bool prepared() {
        if (!folder_.empty()) return true;
        folder_ = temporary_folder("facetmill-ktx-");
        std::error_code failed;
        if (!folder_.empty()) fs::current_path(folder_, failed);
        return !folder_.empty() && !failed;
    }

    std::string encode(const OrderMessage& order, const Bytes& png, std::string& file) {
        remove_file("out.ktx2");
        std::ofstream in("in.png", std::ios::binary);
        in.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
        in.close();
        if (!in) return "cannot be given the image: the temporary folder cannot be written";
        const std::chrono::seconds limit(order.seconds);
        if (!is_toktx(program_) && !is_old_) {
            run_program({program_, {"--version"}, "log", limit}, socket_);
            is_old_ = is_before_4_4(contents_of("log"));
        }
        const std::string problem = problem_of(
            {program_, is_toktx(program_) ? arguments_of_toktx(order) : arguments_of_ktx(order, *is_old_),
             "log", limit},
            socket_);
        if (!problem.empty()) return problem;
        std::error_code failed;
        if (!(fs::file_size("out.ktx2", failed) <= most_bytes) || failed)
            return "wrote no file, or a file that is too large";
        file = contents_of("out.ktx2");
        return {};
    }

    fs::path program_, folder_;
    const Descriptor& socket_;
    std::optional<bool> is_old_;
};

// --- the client process

WorkerPool& workers() {
    static WorkerPool all;
    return all;
}

[[noreturn]] void fail(WorkerPool::Loan& loan) {
    loan.drop();
    throw Error(ErrorKind::stage, "E-KTX", "the process that runs ktx was ended",
                "it may need more memory; textures: {format: webp} needs no other program");
}

} // namespace

std::optional<fs::path> ktx_program() {
    if (const char* named = std::getenv("FACETMILL_KTX"); named && *named) {
        std::error_code failed;
        const fs::path file = fs::absolute(named, failed);
        const bool runs = !failed && fs::is_regular_file(file, failed) && may_run(file);
        return runs ? std::optional(file) : std::nullopt;
    }
    if (auto ktx = program_in_path("ktx")) return ktx;
    return program_in_path("toktx");
}

void start_ktx_workers() {
    constexpr int most = 8;
    const auto program = ktx_program();
    if (!program) return;
    workers().start(std::min(most, default_threads()),
                    [&](const Descriptor& served) { Worker(*program, served).run(); });
}

Bytes run_ktx(Span png, const KtxOrder& order) {
    if (!active_protections().calls) start_ktx_workers();
    WorkerPool::Loan loan(workers(), check_loop_now);
    if (!loan.socket())
        throw Error(ErrorKind::stage, "E-KTX",
                    "KTX2 needs the program ktx or toktx, which cannot be started");
    const OrderMessage message{order.uastc,
                               order.srgb,
                               order.alpha,
                               static_cast<std::uint8_t>(order.quality),
                               static_cast<std::uint32_t>(order.limit.count()),
                               png.size()};
    AnswerMessage answer{};
    const Descriptor& socket = *loan.socket();
    if (!send_all(socket, &message, sizeof message) || !send_all(socket, png.data(), png.size())) fail(loan);
    loan.wait();
    if (!receive_all(socket, &answer, sizeof answer) || answer.bytes > most_bytes) fail(loan);
    Bytes bytes(answer.bytes);
    if (!receive_all(socket, bytes.data(), bytes.size())) fail(loan);
    loan.end();
    if (answer.good == 1) return bytes;
    throw Error(ErrorKind::stage, "E-KTX", std::string(as_text(bytes)));
}

} // namespace facetmill::io
