// Loaded before the C library (LD_PRELOAD): stops threads of the process at random instructions, so that the parts of a
// loop run, end and meet in another order each time.
//
//   FACETMILL_SCHEDULE=SEED   which threads are stopped, when and how long (the machine has a say in it, too)
//   FACETMILL_SCHEDULE_LOG=FILE   gets at the end how often a thread was stopped, and how many threads there were
//
// A thread of this library sends one of the others a signal every few hundred microseconds; whoever gets it gives its
// processor away or sleeps for up to a millisecond.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

enum { MOST = 256 };
static atomic_int ids[MOST]; // of threads that run; 0 where there is none
static atomic_int begun;
static atomic_long stops;
static atomic_int over;
static uint64_t state;
static int log_file = -1; // opened before the sandbox is closed

static int (*create)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);

static uint64_t drawn(void) { // xorshift64*
    state ^= state >> 12, state ^= state << 25, state ^= state >> 27;
    return state * 0x2545F4914F6CDD1Dull;
}

static void sleep_for(long nanoseconds) {
    const struct timespec time = {0, nanoseconds};
    syscall(SYS_clock_nanosleep, CLOCK_MONOTONIC, 0, &time, NULL);
}

static void stop(int signal, siginfo_t* information, void* context) {
    (void)signal, (void)context;
    const int error = errno;
    atomic_fetch_add(&stops, 1);
    if (information->si_value.sival_int == 0) sched_yield();
    else sleep_for(information->si_value.sival_int);
    errno = error;
}

static int registered(void) {
    const int id = (int)syscall(SYS_gettid);
    atomic_fetch_add(&begun, 1);
    for (int at = 0; at < MOST; ++at) {
        int none = 0;
        if (atomic_compare_exchange_strong(&ids[at], &none, id)) return at;
    }
    return -1;
}

struct Work {
    void* (*function)(void*);
    void* argument;
};

static void* run(void* given) {
    const struct Work work = *(struct Work*)given;
    free(given);
    const int at = registered();
    void* result = work.function(work.argument);
    if (at >= 0) atomic_store(&ids[at], 0);
    return result;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*function)(void*), void* argument) {
    if (!create) create = (__typeof__(create))dlsym(RTLD_NEXT, "pthread_create");
    struct Work* const work = malloc(sizeof *work);
    if (!work) return EAGAIN;
    *work = (struct Work){function, argument};
    const int failed = create(thread, attributes, run, work);
    if (failed) free(work);
    return failed;
}

static void* disturb(void* none) {
    (void)none;
    while (!atomic_load(&over)) {
        sleep_for((long)(20000 + drawn() % 300000));
        const int at = (int)(drawn() % 16);
        const int id = atomic_load(&ids[at]);
        const uint64_t how = drawn();
        siginfo_t information = {.si_code = SI_QUEUE};
        information.si_value.sival_int = how % 4 == 0 ? 0 : (int)(how / 4 % 1000000);
        if (id) syscall(SYS_rt_tgsigqueueinfo, getpid(), id, SIGUSR2, &information);
    }
    return NULL;
}

__attribute__((constructor)) static void begin(void) {
    const char* const seed = getenv("FACETMILL_SCHEDULE");
    if (!seed) return;
    state = strtoull(seed, NULL, 10) * 0x9E3779B97F4A7C15ull + 1;
    for (int k = 0; k < 8; ++k) drawn();
    const char* const log = getenv("FACETMILL_SCHEDULE_LOG");
    if (log) log_file = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    struct sigaction action = {.sa_sigaction = stop, .sa_flags = SA_SIGINFO | SA_RESTART};
    sigaction(SIGUSR2, &action, NULL);
    registered();
    create = (__typeof__(create))dlsym(RTLD_NEXT, "pthread_create");
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before); // those of the program are for its own threads
    pthread_t thread;
    if (create(&thread, NULL, disturb, NULL) == 0) pthread_detach(thread);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

__attribute__((destructor)) static void end(void) {
    atomic_store(&over, 1);
    if (log_file >= 0) dprintf(log_file, "%ld %d\n", atomic_load(&stops), atomic_load(&begun));
}
