#include "cli/console.hpp"

#include "base/stopwatch.hpp"
#include "base/text/readable_numbers.hpp"
#include "cli/command.hpp"
#include "cli/pipe_hints.hpp"
#include "platform/signals.hpp"
#include "platform/terminal.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <mutex>
#include <system_error>
#include <thread>

namespace facetmill::cli {

void print(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
    if (errno == EPIPE) end_by_closed_pipe();
    throw Error(ErrorKind::output, "E-WRITE", fmt::format("standard output: {}", std::strerror(errno)));
}

void show(std::string_view text) { print(for_terminal(text)); }

namespace {

/// Writes a message to standard error. If the reader has closed it (facetmill run ... 2>&1 | head), the run
/// continues, because only the outputs and the exit code matter.
template <class... Args>
void tell(fmt::format_string<Args...> format, Args&&... args) {
    const std::string text = fmt::format(format, std::forward<Args>(args)...);
    std::fwrite(text.data(), 1, text.size(), stderr);
}

bool terminal() {
    const char* kind = std::getenv("TERM");
    return standard_error_is_terminal() && !(kind && std::string_view(kind) == "dumb");
}

void line(const Json& object) {
    const std::string text = object.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    std::fputs(text.c_str(), stderr);
}

/// One line, redrawn a few times a second: "[####....] 3/8 simplify 42 %, about 12 s left".
class Bar : public Progress {
  public:
    ~Bar() override { done(); }
    void stage(int number, int number_of, const std::string& name) override {
        const double all = std::max(number_of, 1);
        begin((number - 1) / all, number / all, fmt::format("{}/{} {}", number, number_of, name));
    }
    void beside_stages(const std::string& what) override { begin(until_, until_, what); }
    void share(double done) override {
        if (done <= share_) return;
        share_ = done;
        told_ = watch_.seconds();
    }
    void done() override {
        {
            const std::lock_guard lock(guard_);
            over_ = true;
        }
        wake_.notify_all();
        if (drawer_.joinable()) drawer_.join();
        if (drawn_) std::fputs("\r\033[K", stderr);
        drawn_ = false;
    }

  private:
    void begin(double filled, double until, const std::string& what) {
        const std::lock_guard lock(guard_);
        filled_ = filled;
        until_ = until;
        what_ = for_terminal(what);
        watch_ = {};
        share_ = told_ = 0;
        draw();
        if (drawer_.joinable()) return;
        try {
            drawer_ = std::thread([this] { draw_until_done(); });
        } catch (const std::system_error&) { // without a further thread, the bar is drawn less often
        }
    }

    void draw_until_done() {
        std::unique_lock lock(guard_);
        while (!wake_.wait_for(lock, std::chrono::milliseconds(250), [this] { return over_; })) draw();
    }

    void draw() {
        constexpr int width = 24;
        const double share = std::clamp<double>(share_, 0, 1), since = watch_.seconds();
        const int filled = static_cast<int>(width * (filled_ + share * (until_ - filled_)));
        tell("\r\033[K[{}{}] {}{}", std::string(static_cast<std::size_t>(filled), '#'),
             std::string(static_cast<std::size_t>(width - filled), '.'), what_,
             how_far(since, {share_, told_}));
        std::fflush(stderr);
        drawn_ = true;
    }

    double filled_ = 0, until_ = 0; ///< shares of the bar, before the stage and after it
    std::string what_;
    Stopwatch watch_;
    std::atomic<double> share_ = 0, told_ = 0; ///< the reported share, and the time of that report in seconds
    bool drawn_ = false, over_ = false;
    std::mutex guard_; ///< protects the members above
    std::condition_variable wake_;
    std::thread drawer_;
};

/// A line per stage, with the time since the start.
class Lines : public Progress {
  public:
    explicit Lines(bool json) : json_(json) {}
    void stage(int number, int number_of, const std::string& name) override {
        const double since = watch_.seconds();
        if (json_)
            line({{"level", "info"},
                  {"event", "begin"},
                  {"name", name},
                  {"number", number},
                  {"of", number_of},
                  {"seconds", since}});
        else
            tell("{:7.2f}s  {}/{} {}\n", since, number, number_of, for_terminal(name));
    }
    void beside_stages(const std::string& what) override {
        const double since = watch_.seconds();
        if (!json_) tell("{:7.2f}s  {}\n", since, for_terminal(what));
    }
    void share(double) override {}
    void done() override {}

  private:
    bool json_;
    const Stopwatch watch_;
};

} // namespace

namespace {

/// The time in whole seconds, because the remaining time is only an estimate.
std::string in_seconds(double seconds) {
    return seconds < 60 ? fmt::format("{:.0f} s", std::ceil(seconds)) : timed(seconds);
}

} // namespace

std::string how_far(double seconds, const PrintedMessage& last) {
    constexpr double long_enough = 1; // shorter work needs no number
    if (seconds < long_enough) return {};
    if (last.share <= 0 || last.share > 1 || last.seconds <= 0) return ", " + in_seconds(seconds);
    // The next work may report nothing for long; meanwhile the remaining time continues to fall.
    const double all = std::max(last.seconds / last.share, seconds);
    return fmt::format(" {:.0f} %, about {} left", std::floor(100 * last.share), in_seconds(all - seconds));
}

bool Console::colour() const {
    const char* no_colour = std::getenv("NO_COLOR");
    return !json && terminal() && !(no_colour && *no_colour);
}

void Console::diagnostic(const Diagnostic& d) const {
    if (quiet && d.severity == Severity::note) return;
    const bool is_typed = pipe || (d.where.known() && d.where.source->name == command_line_name);
    if (is_typed && !d.hint.empty()) {
        Diagnostic as_typed = d;
        as_typed.hint = in_pipe_syntax(d.hint);
        if (as_typed.hint != d.hint) return diagnostic(as_typed);
    }
    if (!json) {
        // The line may contain a progress bar.
        tell("{}{}\n", terminal() ? "\r\033[K" : "", render(d, colour()));
        return;
    }
    const char* level = d.severity == Severity::error     ? "error"
                        : d.severity == Severity::warning ? "warning"
                                                          : "note";
    Json object = {{"level", level}, {"id", d.id}, {"message", d.message}};
    if (d.where.known()) {
        object["file"] = d.where.source->name;
        if (d.where.line > 0) object["line"] = d.where.line;
        if (d.where.column > 0) object["column"] = d.where.column;
    }
    if (!d.hint.empty()) object["hint"] = d.hint;
    line(object);
}

void Console::diagnostics(const Error& error) const {
    for (const auto& d : error.diagnostics()) diagnostic(d);
}

void Console::say(std::string_view text) const {
    if (quiet) return;
    while (text.ends_with('\n')) text.remove_suffix(1);
    if (json)
        line({{"level", "info"}, {"message", text}});
    else
        tell("{}\n", for_terminal(text));
}

void Console::say(const Painted& text) const {
    if (quiet) return;
    std::string_view lines = text.text();
    while (lines.ends_with('\n')) lines.remove_suffix(1);
    tell("{}\n", lines);
}

void Console::event(const Json& object) const {
    if (json && !quiet) line(object);
}

bool Console::redraws() const { return !quiet && !verbose && !json && terminal(); }

std::unique_ptr<Progress> Console::progress() const {
    if (quiet) return {};
    if (verbose) return std::make_unique<Lines>(json);
    if (redraws()) return std::make_unique<Bar>();
    return {};
}

} // namespace facetmill::cli
