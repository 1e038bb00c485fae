#include "platform/sandbox.hpp"

#include "platform/address_sanitizer.hpp"
#include "platform/file_names.hpp"
#include "platform/file_status.hpp"
#include "platform/nearest_existing.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <link.h>
#include <memory>
#include <seccomp.h>
#include <set>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace facetmill {

namespace fs = std::filesystem;

namespace {

constexpr bool possible = !has_address_sanitizer;

#if defined(__x86_64__) || defined(__aarch64__)
constexpr bool filters_calls = possible;
#else // the order of clone's arguments may differ
constexpr bool filters_calls = false;
#endif

std::atomic<int> files_version{0};
std::atomic<bool> calls_given_up{false};

// --- Landlock: its interface from the kernel's documentation, because headers may be older than kernels

constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446; // the same on every architecture

constexpr std::uint64_t right(int bit) { return std::uint64_t{1} << bit; }
constexpr std::uint64_t run_file = right(0), write_file = right(1), read_file = right(2),
                        read_folder = right(3), remove_folders = right(4), remove_files = right(5),
                        make_folders = right(7), make_files = right(8), truncate_file = right(14);
/// The rights that a rule for a file, instead of a folder, may contain.
constexpr std::uint64_t of_a_file = run_file | write_file | read_file | truncate_file;
constexpr std::uint64_t reading = read_file | read_folder;
constexpr std::uint64_t writing =
    reading | write_file | truncate_file | make_folders | make_files | remove_folders | remove_files;

struct Ruleset {
    std::uint64_t files, network, scopes;
};
struct __attribute__((packed)) BeneathRule {
    std::uint64_t allowed;
    std::int32_t parent;
};

int landlock_version() {
    constexpr unsigned ask_version = 1;
    const long version = ::syscall(create_ruleset, nullptr, 0, ask_version);
    return version > 0 ? static_cast<int>(version) : 0;
}

/// All rights that this version can restrict.
Ruleset all_of(int version) {
    const int bits = version >= 5 ? 16 : version >= 3 ? 15 : version >= 2 ? 14 : 13;
    return {right(bits) - 1, version >= 4 ? std::uint64_t{3} : 0, version >= 6 ? std::uint64_t{3} : 0};
}

std::size_t size_of(int version) { return version >= 6 ? 24 : version >= 4 ? 16 : 8; }

class Rules {
  public:
    explicit Rules(int version) : handled_(all_of(version)) {
        descriptor_ = Descriptor(static_cast<int>(::syscall(create_ruleset, &handled_, size_of(version), 0)));
    }

    /// Missing files and files without names need no rule. The other end of a pipe has no name, and is never
    /// refused.
    void allow(const fs::path& path, std::uint64_t rights) {
        const Descriptor file(::open(path.c_str(), O_PATH | O_CLOEXEC));
        // If descriptors or memory run out, a rule would be missing, and a planned file would be refused.
        // Then no rules apply.
        if (!file) whole_ = whole_ && errno != EMFILE && errno != ENFILE && errno != ENOMEM && errno != EIO;
        if (!file) return;
        const auto about = status_of(file);
        if (!about) {
            whole_ = false;
            return;
        }
        const std::uint64_t possible_rights =
            about->kind == FileKind::folder ? handled_.files : handled_.files & of_a_file;
        const BeneathRule rule{rights & possible_rights, file.number()};
        constexpr int beneath_path = 1;
        whole_ =
            (::syscall(add_rule, descriptor_.number(), beneath_path, &rule, 0) == 0 || errno != ENOMEM) &&
            whole_;
    }

    bool enforce() const {
        return whole_ && descriptor_ && ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
               ::syscall(restrict_self, descriptor_.number(), 0) == 0;
    }

  private:
    Ruleset handled_;
    Descriptor descriptor_;
    bool whole_ = true;
};

/// Places of libraries loaded on demand (TBB), and of system information that they and this program read:
/// limits, cores, open descriptors.
constexpr std::array system_places{
    "/usr/lib",         "/usr/lib64",     "/usr/local/lib",      "/lib",          "/lib64",
    "/etc/ld.so.cache", "/etc/localtime", "/proc/self",          "/proc/meminfo", "/proc/cpuinfo",
    "/proc/stat",       "/sys/fs/cgroup", "/sys/devices/system", "/dev/urandom",  "/dev/zero"};

/// The files of the program and its loaded libraries: without a build id, the id is computed from them.
std::vector<fs::path> loaded_files() {
    std::vector<fs::path> files{"/proc/self/exe"};
    ::dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* all) {
            const std::string name = info->dlpi_name ? info->dlpi_name : "";
            if (name.starts_with('/') && !name.starts_with("/lib") && !name.starts_with("/usr/lib"))
                static_cast<std::vector<fs::path>*>(all)->emplace_back(name);
            return 0;
        },
        &files);
    return files;
}

// --- seccomp

/// Calls that fail; calls that the architecture lacks are omitted.
constexpr int refused_calls[] = {
    // other programs
    SCMP_SYS(execve), SCMP_SYS(execveat), SCMP_SYS(fork), SCMP_SYS(vfork), SCMP_SYS(ptrace),
    SCMP_SYS(process_vm_readv), SCMP_SYS(process_vm_writev), SCMP_SYS(kcmp), SCMP_SYS(personality),
    // networks, and calls that open files and sockets without passing this filter
    SCMP_SYS(socket), SCMP_SYS(socketpair), SCMP_SYS(connect), SCMP_SYS(bind), SCMP_SYS(listen),
    SCMP_SYS(accept), SCMP_SYS(accept4), SCMP_SYS(io_uring_setup), SCMP_SYS(io_uring_enter),
    SCMP_SYS(io_uring_register),
    // mounts, namespaces, keys
    SCMP_SYS(mount), SCMP_SYS(umount2), SCMP_SYS(pivot_root), SCMP_SYS(chroot), SCMP_SYS(unshare),
    SCMP_SYS(setns), SCMP_SYS(add_key), SCMP_SYS(request_key), SCMP_SYS(keyctl), SCMP_SYS(open_tree),
    SCMP_SYS(move_mount), SCMP_SYS(fsopen), SCMP_SYS(fsconfig), SCMP_SYS(fsmount), SCMP_SYS(fspick),
    SCMP_SYS(mount_setattr), SCMP_SYS(name_to_handle_at), SCMP_SYS(open_by_handle_at),
    // the kernel and the machine
    SCMP_SYS(bpf), SCMP_SYS(perf_event_open), SCMP_SYS(userfaultfd), SCMP_SYS(init_module),
    SCMP_SYS(finit_module), SCMP_SYS(delete_module), SCMP_SYS(kexec_load), SCMP_SYS(kexec_file_load),
    SCMP_SYS(reboot), SCMP_SYS(swapon), SCMP_SYS(swapoff), SCMP_SYS(sethostname), SCMP_SYS(setdomainname),
    SCMP_SYS(settimeofday), SCMP_SYS(clock_settime), SCMP_SYS(adjtimex), SCMP_SYS(clock_adjtime),
    SCMP_SYS(syslog), SCMP_SYS(acct), SCMP_SYS(quotactl), SCMP_SYS(vhangup), SCMP_SYS(fanotify_init),
    SCMP_SYS(iopl), SCMP_SYS(ioperm), SCMP_SYS(modify_ldt), SCMP_SYS(uselib), SCMP_SYS(ustat),
    SCMP_SYS(sysfs),
    // other processes by a descriptor
    SCMP_SYS(pidfd_send_signal), SCMP_SYS(pidfd_open), SCMP_SYS(pidfd_getfd),
    440, // process_madvise, which libseccomp 2.5 does not know
};

using Filter = std::unique_ptr<void, decltype(&seccomp_release)>;

bool refuse(const Filter& filter, int call, int error = EPERM) {
    return seccomp_rule_add_array(filter.get(), SCMP_ACT_ERRNO(error), call, 0, nullptr) == 0;
}

/// Only if the masked bits of an argument match. Flags and requests have 32 bits; higher bits are ignored.
bool refuse_if(const Filter& filter, int call, unsigned argument, std::uint64_t mask, std::uint64_t bits) {
    const scmp_arg_cmp condition{argument, SCMP_CMP_MASKED_EQ, mask, bits};
    return seccomp_rule_add_array(filter.get(), SCMP_ACT_ERRNO(EPERM), call, 1, &condition) == 0;
}

/// Refuses calls of another architecture (x32 too), which have a second set of call numbers.
bool fill(const Filter& filter) {
    constexpr std::uint64_t thread = 0x00010000, request = UINT32_MAX;
    constexpr std::uint64_t types_for_terminal = 0x5412, pastes_in_console = 0x541c; // TIOCSTI, TIOCLINUX
    bool whole = seccomp_attr_set(filter.get(), SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_ERRNO(EPERM)) == 0 &&
                 seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1) == 0;
    for (const int call : refused_calls) whole = whole && refuse(filter, call);
    // clone3 has its flags in memory, where filters cannot check them; the C library then falls back to
    // clone.
    return whole && refuse(filter, SCMP_SYS(clone3), ENOSYS) &&
           refuse_if(filter, SCMP_SYS(clone), 0, thread, 0) &&
           refuse_if(filter, SCMP_SYS(ioctl), 1, request, types_for_terminal) &&
           refuse_if(filter, SCMP_SYS(ioctl), 1, request, pastes_in_console);
}

} // namespace

Protections offered_protections() {
    Protections offered;
    if (!possible) return offered;
    offered.files = landlock_version();
    constexpr unsigned for_all_threads = 2; // a level of seccomp_api_get(3)
    offered.calls = filters_calls && seccomp_api_get() >= for_all_threads;
    return offered;
}

Protections active_protections() { return {.files = files_version, .calls = calls_given_up}; }

bool confine_files(const AllowedFiles& allowed) {
    const int version = possible ? landlock_version() : 0;
    if (version == 0) return false;
    Rules rules(version);
    for (const char* place : system_places) rules.allow(place, reading);
    rules.allow("/dev/null", reading | write_file);
    for (const auto& file : loaded_files()) rules.allow(file, reading);
    if (allowed.read_all) rules.allow("/", reading);
    if (allowed.run_all) rules.allow("/", run_file);
    for (const auto& path : std::set<fs::path>(allowed.read.begin(), allowed.read.end()))
        rules.allow(path, reading);
    std::set<fs::path> written;
    for (const auto& path : allowed.written) written.insert(nearest_existing(path));
    for (const auto& path : written) rules.allow(path, writing);
    for (const auto& path : allowed.folders_made) rules.allow(path, make_folders | remove_folders);
    if (!rules.enforce()) return false;
    files_version = version;
    return true;
}

bool confine_calls() {
    if (!filters_calls || calls_given_up) return calls_given_up;
    // libseccomp crashes without memory. It needs far less than this, so this throws bad_alloc instead.
    void* volatile room = ::operator new (std::size_t{4} << 20);
    ::operator delete(room);
    const Filter filter(seccomp_init(SCMP_ACT_ALLOW), &seccomp_release);
    calls_given_up = filter && fill(filter) && seccomp_load(filter.get()) == 0;
    return calls_given_up;
}

std::string sandbox_hint(const fs::path& file, int error) {
    if (files_version == 0 || error != EACCES) return {};
    const bool there = ::access(file.c_str(), F_OK) == 0;
    const bool permitted = there ? may_read(file) : may_write(nearest_existing(file));
    return permitted ? "the plan does not list it, so the sandbox refuses it: use --no-sandbox to run "
                       "without the sandbox"
                     : "";
}

} // namespace facetmill
