#include "cli/warning_limiter.hpp"

#include "base/text/readable_numbers.hpp"

#include <fmt/format.h>
#include <string_view>

namespace facetmill::cli {

namespace {

constexpr std::size_t most = 10;

std::string kind_of(const Diagnostic& d) {
    constexpr std::string_view made_of = "--strict makes "; // followed by the id of the warning
    const auto at = d.id == "E-STRICT" ? d.message.find(made_of) : std::string::npos;
    const std::string of = at == std::string::npos
                               ? std::string()
                               : d.message.substr(at, d.message.find(' ', at + made_of.size()) - at);
    return fmt::format("{} {} {} {}", static_cast<int>(d.severity), d.id, of, to_string(d.where));
}

} // namespace

void WarningLimiter::tell(const Diagnostic& diagnostic) {
    if (console_.json) return console_.diagnostic(diagnostic);
    Kind& kind = kinds_[kind_of(diagnostic)];
    if (++kind.count <= most)
        console_.diagnostic(diagnostic);
    else
        kind.last = diagnostic;
}

void WarningLimiter::finish() {
    for (auto& [name, kind] : kinds_) {
        if (kind.count <= most) continue;
        if (kind.count > most + 1) { // a single omitted warning takes no more room than the note about it
            kind.last.message = fmt::format("{} more like these", grouped(kind.count - most));
            kind.last.hint = "--report run.json lists all of them";
        }
        console_.diagnostic(kind.last);
    }
    kinds_.clear();
}

} // namespace facetmill::cli
