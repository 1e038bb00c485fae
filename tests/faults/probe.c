// Loaded before the C library (LD_PRELOAD): a reader that tries more. When the program opens the file FACETMILL_PROBE_AT
// the first time, it tries what an attacker in a reader would, and writes "NAME ERROR" (0: it succeeded) for each try to
// the descriptor FACETMILL_PROBE_LOG, which is open already; and how many threads there were when the sandbox closed.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

static atomic_int done;
static int log_file = -1;
static const char* prefix = "";

static void tell(const char* name, long result) {
    char line[256];
    snprintf(line, sizeof line, "%s%s %d\n", prefix, name, result < 0 ? errno : 0);
    const ssize_t ignored = write(log_file, line, strlen(line));
    (void)ignored;
}

static int raw_open(const char* path, int flags) { return (int)syscall(SYS_openat, AT_FDCWD, path, flags | O_CLOEXEC, 0600); }

static void try_file(const char* name, const char* path, int flags) {
    const int fd = raw_open(path, flags);
    tell(name, fd);
    if (fd >= 0) close(fd);
}

/// Files named by FACETMILL_PROBE_SECRET (outside), _BESIDE (of the input) and _OUTSIDE (a folder).
static void try_files(void) {
    char path[4096], other[4096];
    const char* outside = getenv("FACETMILL_PROBE_OUTSIDE");
    try_file("read-passwd", "/etc/passwd", O_RDONLY);
    try_file("read-secret", getenv("FACETMILL_PROBE_SECRET"), O_RDONLY);
    try_file("write-secret", getenv("FACETMILL_PROBE_SECRET"), O_WRONLY);
    try_file("list-outside", outside, O_RDONLY | O_DIRECTORY);
    try_file("read-beside", getenv("FACETMILL_PROBE_BESIDE"), O_RDONLY);
    snprintf(path, sizeof path, "%s/made", outside);
    try_file("make-file", path, O_WRONLY | O_CREAT);
    tell("truncate", truncate(getenv("FACETMILL_PROBE_SECRET"), 1));
    tell("make-folder", mkdir(strcat(path, "-folder"), 0700));
    snprintf(path, sizeof path, "%s/link", outside);
    tell("make-link", symlink("/etc/passwd", path));
    tell("remove", unlink(getenv("FACETMILL_PROBE_VICTIM")));
    snprintf(path, sizeof path, "%s/moved", outside);
    snprintf(other, sizeof other, "%s/here", outside);
    tell("rename", rename(other, path));
}

static void try_calls(void) {
    char* const arguments[] = {(char*)"/bin/true", NULL};
    char* const nothing[] = {NULL};
    // A path that is not there: without a filter that is ENOENT, and the process goes on.
    tell("execve", execve("/no/such/program", arguments, nothing));
    pid_t child = (pid_t)syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0);
    if (child == 0) _exit(0);
    tell("clone", child);
    if (child > 0) waitpid(child, NULL, 0);
    child = fork();
    if (child == 0) _exit(0);
    tell("fork", child);
    if (child > 0) waitpid(child, NULL, 0);
    const int error = posix_spawn(&child, "/bin/true", NULL, NULL, arguments, nothing);
    errno = error;
    tell("spawn", error ? -1 : 0);
    if (!error) waitpid(child, NULL, 0);
    tell("socket-inet", socket(AF_INET, SOCK_STREAM, 0));
    tell("socket-unix", socket(AF_UNIX, SOCK_STREAM, 0));
    tell("ptrace", ptrace(PTRACE_SEIZE, getppid(), 0, 0));
    tell("unshare", unshare(CLONE_FS));
    tell("bpf", syscall(SYS_bpf, -1, 0, 0));           // without a filter EINVAL
    tell("keyctl", syscall(SYS_keyctl, 0, -3, 1));     // its session's keyring
    tell("io_uring", syscall(425, 0, 0));              // without a filter EFAULT or EINVAL
    tell("mount", mount("none", "/no/such/folder", "tmpfs", 0, ""));
}

static void* try_all(void* name) {
    prefix = name;
    try_files();
    if (strcmp(name, "") == 0) try_calls();
    return NULL;
}

static void probe(const char* path) {
    const char* at = getenv("FACETMILL_PROBE_AT");
    if (!at || !path || !strstr(path, at) || atomic_exchange(&done, 1)) return;
    log_file = atoi(getenv("FACETMILL_PROBE_LOG"));
    try_all((void*)"");
    pthread_t thread; // one that starts now is as limited
    if (pthread_create(&thread, NULL, try_all, (void*)"thread-") == 0) pthread_join(thread, NULL);
}

/// How many threads there are.
static long threads(void) {
    struct stat about;
    return stat("/proc/self/task", &about) == 0 ? (long)about.st_nlink - 2 : -1;
}

/// With FACETMILL_PROBE_OLD_KERNEL neither Landlock nor seccomp are there. Else tells of the threads that would keep their
/// access when the files are given up.
long syscall(long number, ...) {
    static long (*next)(long, ...);
    if (!next) next = (long (*)(long, ...))dlsym(RTLD_NEXT, "syscall");
    va_list rest;
    va_start(rest, number);
    long a[6];
    for (int i = 0; i < 6; ++i) a[i] = va_arg(rest, long);
    va_end(rest);
    const int closes = number == 446, is_of_sandbox = closes || number == 444 || number == 445 || number == SYS_seccomp;
    if (is_of_sandbox && getenv("FACETMILL_PROBE_OLD_KERNEL")) {
        errno = ENOSYS;
        return -1;
    }
    if (closes && getenv("FACETMILL_PROBE_LOG")) {
        char line[64];
        snprintf(line, sizeof line, "threads %ld\n", threads());
        const ssize_t ignored = write(atoi(getenv("FACETMILL_PROBE_LOG")), line, strlen(line));
        (void)ignored;
    }
    return next(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}

#define OPEN(name)                                                                                                     \
    int name(const char* path, int flags, ...) {                                                                       \
        static int (*next)(const char*, int, ...);                                                                     \
        if (!next) next = (int (*)(const char*, int, ...))dlsym(RTLD_NEXT, #name);                                     \
        va_list rest;                                                                                                  \
        va_start(rest, flags);                                                                                         \
        const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;                                  \
        va_end(rest);                                                                                                  \
        if (!(flags & O_PATH)) probe(path);                                                                            \
        return next(path, flags, mode);                                                                                \
    }
OPEN(open)
OPEN(open64)
