#include "base/parallel.h"

#include <thread>

#include "base/progress.h"
#include "base/thread_team.h"

namespace fairing {

namespace {

// Of our own choice: more bring little, since parts of every solve are serial. And of the caller's.
constexpr int most_chosen = 8;
constexpr int most_asked = 64;

int wanted_threads(int count) {
    if (count > 0) return std::min(count, most_asked);
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most_chosen);
}

// The team of this thread, taken away for as long as it works on a loop.
class Taken {
public:
    Taken() { ThreadTeam::current = nullptr; }
    ~Taken() { ThreadTeam::current = team; }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;

    ThreadTeam* const team = ThreadTeam::current;
};

}  // namespace

Threads::Threads(int count)
    : team_(std::make_unique<ThreadTeam>(wanted_threads(count))), previous_(ThreadTeam::current) {
    ThreadTeam::current = team_.get();
}

Threads::~Threads() { ThreadTeam::current = previous_; }

void run_pieces(int pieces, const std::function<void(int)>& piece) {
    const Taken taken;
    if (taken.team && pieces > 1) {
        taken.team->run(pieces, piece);
        return;
    }
    for (int k = 0; k < pieces; ++k) {
        piece(k);
        checkpoint();
    }
}

}  // namespace fairing
