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

void set_timer(time_t seconds) {
    const itimerval timer{{0, 0}, {seconds, 0}};
    setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace

Watchdog::~Watchdog() { set_timer(0); }

void Watchdog::restart() {
    [[maybe_unused]] static const auto previous = std::signal(SIGPROF, bark);
    set_timer(patience);
}

}  // namespace fairing::fuzz
