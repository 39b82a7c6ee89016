#include "watchdog.h"

#include <csignal>
#include <cstdlib>
#include <string_view>

#include <sys/time.h>
#include <unistd.h>

namespace fairing::fuzz {

namespace {

constexpr time_t patience = 10;  // seconds, of all threads together and under the sanitizers

// Aborts, which the fuzzer keeps as a find; nothing here may allocate.
extern "C" void bark(int /*signal*/) {
    constexpr std::string_view text = "== BREACH: a call asks now and then whether to stop\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
    std::abort();
}

}  // namespace

void restart_watchdog() {
    [[maybe_unused]] static const auto previous = std::signal(SIGPROF, bark);
    const itimerval timer{{0, 0}, {patience, 0}};
    setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace fairing::fuzz
