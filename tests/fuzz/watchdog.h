// Ends the process when a call works on for long without asking whether to stop. It counts processor time: on a busy
// machine a sound call may take any time by the wall.
#pragma once

namespace fairing::fuzz {

// Counts while it lives.
class Watchdog {
public:
    Watchdog() { restart(); }
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    // Whenever progress is asked, within a watchdog's life.
    static void restart();
};

}  // namespace fairing::fuzz
