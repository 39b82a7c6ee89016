// Ends the process when a call works on for long without asking whether to stop. It counts processor time: on a busy
// machine a sound call may take any time by the wall.
#pragma once

namespace fairing::fuzz {

// Begins anew: at the start of each input, and whenever progress is asked.
void restart_watchdog();

}  // namespace fairing::fuzz
