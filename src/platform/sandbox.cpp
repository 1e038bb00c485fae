#include "platform/sandbox.hpp"

#include "platform/nearest_existing.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <link.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <set>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define FACETMILL_LEAKS_ARE_SOUGHT 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FACETMILL_LEAKS_ARE_SOUGHT 1
#endif
#endif

namespace facetmill {

namespace fs = std::filesystem;

namespace {

#ifdef FACETMILL_LEAKS_ARE_SOUGHT
constexpr bool possible = false;
#else
constexpr bool possible = true;
#endif

std::atomic<int> files_version{0};
std::atomic<bool> calls_given_up{false};

// --- Landlock: its interface as the kernel documents it, since headers may be older than kernels

constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446; // on every architecture

constexpr std::uint64_t right(int bit) { return std::uint64_t{1} << bit; }
constexpr std::uint64_t run_file = right(0), write_file = right(1), read_file = right(2),
                        read_folder = right(3), remove_folders = right(4), remove_files = right(5),
                        make_folders = right(7), make_files = right(8), truncate_file = right(14);
/// Those that a rule for a file, and not a folder, may give.
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

/// All that this version can refuse.
Ruleset all_of(int version) {
    const int bits = version >= 5 ? 16 : version >= 3 ? 15 : version >= 2 ? 14 : 13;
    return {right(bits) - 1, version >= 4 ? std::uint64_t{3} : 0, version >= 6 ? std::uint64_t{3} : 0};
}

std::size_t size_of(int version) { return version >= 6 ? 24 : version >= 4 ? 16 : 8; }

class Rules {
  public:
    explicit Rules(int version) : handled_(all_of(version)) {
        descriptor_ = static_cast<int>(::syscall(create_ruleset, &handled_, size_of(version), 0));
    }
    ~Rules() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    Rules(const Rules&) = delete;
    Rules& operator=(const Rules&) = delete;

    /// What is not there, or cannot be named (the other end of a pipe, which is never refused), needs no
    /// rule.
    void allow(const fs::path& path, std::uint64_t rights) {
        const int fd = ::open(path.c_str(), O_PATH | O_CLOEXEC);
        // Without descriptors or memory a rule would lack, and what the plan names be refused: then there are
        // no rules.
        if (fd < 0) whole_ = whole_ && errno != EMFILE && errno != ENFILE && errno != ENOMEM && errno != EIO;
        if (fd < 0) return;
        struct stat about {};
        if (::fstat(fd, &about) == 0) {
            const std::uint64_t possible_rights =
                S_ISDIR(about.st_mode) ? handled_.files : handled_.files & of_a_file;
            const BeneathRule rule{rights & possible_rights, fd};
            constexpr int beneath_path = 1;
            whole_ =
                (::syscall(add_rule, descriptor_, beneath_path, &rule, 0) == 0 || errno != ENOMEM) && whole_;
        } else
            whole_ = false;
        ::close(fd);
    }

    bool enforce() const {
        return whole_ && descriptor_ >= 0 && ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
               ::syscall(restrict_self, descriptor_, 0) == 0;
    }

  private:
    Ruleset handled_;
    int descriptor_ = -1;
    bool whole_ = true;
};

/// Where libraries are found that are loaded when they are first needed (TBB), and what they and
/// this program ask of the system: its limits, its cores, its own descriptors.
constexpr std::array system_places{
    "/usr/lib",         "/usr/lib64",     "/usr/local/lib",      "/lib",          "/lib64",
    "/etc/ld.so.cache", "/etc/localtime", "/proc/self",          "/proc/meminfo", "/proc/cpuinfo",
    "/proc/stat",       "/sys/fs/cgroup", "/sys/devices/system", "/dev/urandom",  "/dev/zero"};

/// The files of the program and of the libraries that are there: where they have no build id, it is made of
/// them.
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

#if defined(__x86_64__)
#define FACETMILL_CALLS_OF AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define FACETMILL_CALLS_OF AUDIT_ARCH_AARCH64
#endif

#ifdef FACETMILL_CALLS_OF
/// Calls that fail; of those that only one architecture or a newer kernel has, where the headers know them.
constexpr unsigned refused_calls[] = {
    // other programs
    SYS_execve,
    SYS_execveat,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_kcmp,
    SYS_personality,
    // networks, and what opens files and sockets past this filter
    SYS_socket,
    SYS_socketpair,
    SYS_connect,
    SYS_bind,
    SYS_listen,
    SYS_accept,
    SYS_accept4,
    425,
    426,
    427, // io_uring
    // mounts, namespaces, keys
    SYS_mount,
    SYS_umount2,
    SYS_pivot_root,
    SYS_chroot,
    SYS_unshare,
    SYS_setns,
    SYS_add_key,
    SYS_request_key,
    SYS_keyctl,
    428,
    429,
    430,
    431,
    432,
    433,
    442, // open_tree, move_mount, fsopen, fsconfig, fsmount, fspick, mount_setattr
    SYS_name_to_handle_at,
    SYS_open_by_handle_at,
    // the kernel and the machine
    SYS_bpf,
    SYS_perf_event_open,
    SYS_userfaultfd,
    SYS_init_module,
    SYS_finit_module,
    SYS_delete_module,
    SYS_kexec_load,
    SYS_reboot,
    SYS_swapon,
    SYS_swapoff,
    SYS_sethostname,
    SYS_setdomainname,
    SYS_settimeofday,
    SYS_clock_settime,
    SYS_adjtimex,
    SYS_clock_adjtime,
    SYS_syslog,
    SYS_acct,
    SYS_quotactl,
    SYS_vhangup,
    SYS_fanotify_init,
    // other processes by a descriptor: pidfd_send_signal, pidfd_open, pidfd_getfd, process_madvise
    424,
    434,
    438,
    440,
#ifdef SYS_kexec_file_load
    SYS_kexec_file_load,
#endif
#ifdef __x86_64__
    SYS_fork,
    SYS_vfork,
    SYS_iopl,
    SYS_ioperm,
    SYS_modify_ldt,
    SYS_uselib,
    SYS_ustat,
    SYS_sysfs,
#endif
};

constexpr std::uint32_t of_this = offsetof(seccomp_data, nr), of_architecture = offsetof(seccomp_data, arch);
/// The lower half of an argument: both architectures have it first.
constexpr std::uint32_t argument(std::size_t i) {
    return static_cast<std::uint32_t>(offsetof(seccomp_data, args) + 8 * i);
}

constexpr std::uint32_t failing(int error) { return SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error); }

constexpr sock_filter load(std::uint32_t at) { return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, at); }
constexpr sock_filter answer(std::uint32_t what) { return BPF_STMT(BPF_RET | BPF_K, what); }
/// The next answers if the value is that, or has one of the bits; else as many are skipped.
constexpr sock_filter unless_equal(std::uint32_t value, std::uint8_t skip) {
    return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, skip);
}
constexpr sock_filter unless_any_bit(std::uint32_t bits, std::uint8_t skip) {
    return BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, 0, skip);
}

std::vector<sock_filter> filter() {
    constexpr std::uint32_t of_x32 = 0x40000000, thread = 0x00010000, clone3 = 435;
    constexpr std::uint32_t types_for_terminal = 0x5412, pastes_in_console = 0x541c; // TIOCSTI, TIOCLINUX
    const sock_filter refusal = answer(failing(EPERM)), permission = answer(SECCOMP_RET_ALLOW);
    std::vector<sock_filter> program{
        load(of_architecture), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, FACETMILL_CALLS_OF, 1, 0), refusal,
        load(of_this), unless_any_bit(of_x32, 1), // a second set of numbers for the same calls
        refusal,
        // clone3 tells its flags in memory, which no filter sees: the C library then takes clone
        unless_equal(clone3, 1), answer(failing(ENOSYS)), unless_equal(SYS_clone, 4), load(argument(0)),
        unless_any_bit(thread, 1), permission, refusal, unless_equal(SYS_ioctl, 6), load(argument(1)),
        unless_equal(types_for_terminal, 1), refusal, unless_equal(pastes_in_console, 1), refusal,
        permission};
    for (const unsigned call : refused_calls) {
        program.push_back(unless_equal(call, 1));
        program.push_back(refusal);
    }
    program.push_back(permission);
    return program;
}
#endif

} // namespace

Protections offered_protections() {
    Protections offered;
    if (!possible) return offered;
    offered.files = landlock_version();
#ifdef FACETMILL_CALLS_OF
    const std::uint32_t action = SECCOMP_RET_ERRNO;
    offered.calls = ::syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
#endif
    return offered;
}

Protections active_protections() { return {files_version, calls_given_up}; }

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
#ifdef FACETMILL_CALLS_OF
    if (!possible || calls_given_up) return calls_given_up;
    auto program = filter();
    const sock_fprog all{static_cast<unsigned short>(program.size()), program.data()};
    calls_given_up = ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                     ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &all) == 0;
    return calls_given_up;
#else
    return false;
#endif
}

std::string sandbox_hint(const fs::path& file, int error) {
    if (files_version == 0 || error != EACCES) return {};
    const bool there = ::access(file.c_str(), F_OK) == 0;
    const bool permitted =
        there ? ::access(file.c_str(), R_OK) == 0 : ::access(nearest_existing(file).c_str(), W_OK) == 0;
    return permitted ? "the plan does not name it, so the sandbox refuses it: --no-sandbox runs without one"
                     : "";
}

} // namespace facetmill
