#include "platform/sandbox.hpp"

#include "platform/windows/child_processes.hpp"

#include <atomic>
#include <windows.h>

namespace facetmill {

namespace {

std::atomic<bool> is_confined{false};

template <class Policy>
bool set_policy(PROCESS_MITIGATION_POLICY which, Policy policy) {
    return ::SetProcessMitigationPolicy(which, &policy, sizeof policy) != 0;
}

} // namespace

Protections offered_protections() { return {.mitigations = true}; }

Protections active_protections() { return {.mitigations = is_confined}; }

/// Windows can drop access to files only when a process starts (AppContainer).
bool confine_files(const AllowedFiles&) { return false; }

bool confine_calls() {
    if (is_confined) return true;
    PROCESS_MITIGATION_DYNAMIC_CODE_POLICY code{};
    code.ProhibitDynamicCode = 1;
    PROCESS_MITIGATION_IMAGE_LOAD_POLICY images{};
    images.NoRemoteImages = images.NoLowMandatoryLabelImages = 1;
    PROCESS_MITIGATION_EXTENSION_POINT_DISABLE_POLICY extensions{};
    extensions.DisableExtensionPoints = 1;
    PROCESS_MITIGATION_CHILD_PROCESS_POLICY children{};
    children.NoChildProcessCreation = 1;
    // All are tried, even if one fails.
    bool whole = set_policy(ProcessImageLoadPolicy, images);
    whole = set_policy(ProcessExtensionPointDisablePolicy, extensions) && whole;
    if (needs_child_processes) {
        whole = false; // opening a page may need code of other programs, too
    } else {
        whole = set_policy(ProcessDynamicCodePolicy, code) && whole;
        whole = set_policy(ProcessChildProcessPolicy, children) && whole;
    }
    is_confined = whole;
    return whole;
}

std::string sandbox_hint(const std::filesystem::path&, int) { return {}; }

} // namespace facetmill
