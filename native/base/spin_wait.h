// A short wait that keeps the processor busy.
#pragma once

#include <chrono>
#include <thread>

#if defined(__x86_64__) || defined(_M_X64)
#include <immintrin.h>
#endif

namespace fairing {

// After so long a wait that sleeps looks whether the call is to stop.
inline constexpr std::chrono::milliseconds between_looks{50};

// A solve enters some thousand loops of a hundredth to a tenth of a millisecond in quick succession, and waking a
// thread takes as long as such a loop. So an idle thread spins for a while before it sleeps.
class SpinWait {
public:
    // Whether the condition holds by then.
    template <typename Condition>
    static bool until(const Condition& condition) {
        const auto end = Clock::now() + longest;
        do {
            for (int k = 0; k < looks; ++k) {
                if (condition()) return true;
                pause();
            }
        } while (Clock::now() < end);
        return condition();
    }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::microseconds longest{50};  // then the core is left to others
    static constexpr int looks = 32;                         // between two readings of the clock

    static void pause() {
#if defined(__x86_64__) || defined(_M_X64)
        _mm_pause();
#else
        std::this_thread::yield();
#endif
    }
};

}  // namespace fairing
