#include "batch/causes.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <tuple>

namespace facetmill::batch {

namespace {

/// The text after `before` up to `end`; empty if the message has no such text.
std::string between(std::string_view message, std::string_view before, char end) {
    const auto at = message.find(before);
    if (at == message.npos) return {};
    message.remove_prefix(at + before.size());
    return std::string(message.substr(0, message.find(end)));
}

/// The part of a message by which the causes of an id differ. The asset's name may come before it.
std::string subject_of(const Diagnostic& d, const Asset& asset) {
    std::string_view message = d.message;
    if (const auto at = message.find(asset.name + ": "); at != message.npos)
        message.remove_prefix(at + asset.name.size());
    if (d.id == "E-CHECK" || d.id == "W-CHECK") return between(message, "'", '\'');
    if (d.id == "E-STRICT") return between(message, "--strict makes ", ' ');
    return {};
}

} // namespace

std::vector<Cause> causes_of(const Summary& summary) {
    std::map<std::tuple<bool, std::string, std::string>, Cause> all; // errors before warnings
    const auto add = [&](const Diagnostic& d, const std::string& asset, std::string about, bool new_asset) {
        Cause& cause = all[{d.severity != Severity::error, d.id, about}];
        if (cause.messages++ == 0) cause = {d.severity, d.id, std::move(about), 0, 1, asset, d.message};
        cause.assets += new_asset;
    };
    for (std::size_t i = 0; i < summary.assets.size(); ++i) {
        const Asset& asset = summary.assets[i];
        std::set<std::string> seen; // causes of this asset
        for (const auto* list : {&summary.outcomes[i].errors, &summary.outcomes[i].warnings})
            for (const Diagnostic& d : *list) {
                std::string about = subject_of(d, asset);
                const bool is_new = seen.insert(d.id + " " + about).second;
                add(d, asset.name, std::move(about), is_new);
            }
    }
    for (const auto* list : {&summary.errors, &summary.warnings})
        for (const Diagnostic& d : *list) add(d, "", "", false);
    std::vector<Cause> causes;
    causes.reserve(all.size());
    for (auto& [key, cause] : all) causes.push_back(std::move(cause));
    std::stable_sort(causes.begin(), causes.end(), [](const Cause& a, const Cause& b) {
        return a.severity != b.severity ? a.severity == Severity::error : a.assets > b.assets;
    });
    return causes;
}

std::string name_of(const Cause& cause) {
    return cause.about.empty() ? cause.id : fmt::format("{} {}", cause.id, cause.about);
}

} // namespace facetmill::batch
