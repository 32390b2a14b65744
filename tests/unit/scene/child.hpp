#pragma once
// Runs cases in a child process with limits, so that a crash, a hang or a huge allocation is a
// failure with its seed, and the next seed goes on in a new child.

#include <csignal>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TAUT_TEST_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TAUT_TEST_ASAN 1
#endif
#endif

namespace child {

struct Limits
{
    rlim_t address_space = rlim_t(512) << 20; ///< bytes; not under sanitizers, whose shadow needs terabytes
    int cpu_seconds = 10;                     ///< of one case
};

/// How one run over the seeds ended.
struct Outcome
{
    std::uint64_t accepted = 0, refused = 0; ///< case returned true or false
    std::string failures;                    ///< "seed 17: signal Segmentation fault\n", at most ten
};

namespace detail {

struct Progress
{
    std::uint64_t seed, accepted, refused;
    char why[200];
};

inline void limit(const Limits& limits)
{
    for (const int number : {SIGSEGV, SIGABRT, SIGFPE, SIGILL, SIGTERM}) // the test program catches them
        signal(number, SIG_DFL);
    const rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
#if !defined(TAUT_TEST_ASAN)
    const rlimit space = {limits.address_space, limits.address_space};
    setrlimit(RLIMIT_AS, &space);
#else
    (void)limits;
#endif
}

[[noreturn]] inline void work(Progress& progress, std::uint64_t first, std::uint64_t last,
                              const std::function<bool(std::uint64_t)>& one_case, const Limits& limits)
{
    limit(limits);
    for (std::uint64_t seed = first; seed < last; ++seed)
    {
        progress.seed = seed;
        const itimerval timer = {{0, 0}, {limits.cpu_seconds, 0}};
        setitimer(ITIMER_PROF, &timer, nullptr); // SIGPROF ends the child
        try
        {
            ++(one_case(seed) ? progress.accepted : progress.refused);
        }
        catch (const std::exception& error)
        {
            std::strncpy(progress.why, error.what(), sizeof progress.why - 1);
            _exit(1);
        }
    }
    _exit(0);
}

} // namespace detail

/// `one_case` returns whether the input was accepted; whatever it throws is a failure.
inline Outcome run(std::uint64_t seeds, const std::function<bool(std::uint64_t)>& one_case,
                   const Limits& limits = {})
{
    void* memory =
        mmap(nullptr, sizeof(detail::Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    auto& progress = *new (memory) detail::Progress{};
    Outcome outcome;
    std::uint64_t first = 0;
    for (int failures = 0; first < seeds && failures < 10;)
    {
        const pid_t pid = fork();
        if (pid == 0)
            detail::work(progress, first, seeds, one_case, limits);
        int status = 0;
        waitpid(pid, &status, 0);
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
            break;
        outcome.failures += "seed " + std::to_string(progress.seed) + ": ";
        if (WIFSIGNALED(status))
            outcome.failures += std::string("signal ") + strsignal(WTERMSIG(status)) + '\n';
        else
            outcome.failures += "exit " + std::to_string(WEXITSTATUS(status)) + ' ' + progress.why + '\n';
        first = progress.seed + 1;
        ++failures;
    }
    outcome.accepted = progress.accepted;
    outcome.refused = progress.refused;
    munmap(memory, sizeof(detail::Progress));
    return outcome;
}

} // namespace child
