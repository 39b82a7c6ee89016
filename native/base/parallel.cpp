#include "base/parallel.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#if defined(__x86_64__) || defined(_M_X64)
#include <immintrin.h>
#endif

#include "base/beside.h"
#include "base/progress.h"

namespace fairing {

namespace {

// Of our own choice: more bring little, since parts of every solve are serial. And of the caller's.
constexpr int most_chosen = 8;
constexpr int most_asked = 64;

int wanted_threads(int count) {
    if (count > 0) return std::min(count, most_asked);
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most_chosen);
}

// One loop, shared by those who work on it.
class Job {
public:
    Job(int pieces, const std::function<void(int)>& piece) : pieces_(pieces), piece_(piece) {}

    void work() {
        for (int k = next_++; k < pieces_; k = next_++) {
            try {
                piece_(k);
                checkpoint();
            } catch (...) {
                next_ = pieces_;
                const std::scoped_lock lock(mutex_);
                if (!error_) error_ = std::current_exception();
            }
        }
    }

    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

private:
    const int pieces_;
    const std::function<void(int)>& piece_;
    std::atomic<int> next_ = 0;
    std::mutex mutex_;
    std::exception_ptr error_;
};

// A solve enters some thousand loops of a hundredth to a tenth of a millisecond, one soon after the other, and waking a
// thread takes as long as such a loop. So who has nothing to do looks on for a while before it sleeps.
class LookOut {
public:
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
    static constexpr std::chrono::microseconds longest{50};
    static constexpr int looks = 32;  // between two readings of the clock

    static void pause() {
#if defined(__x86_64__) || defined(_M_X64)
        _mm_pause();
#else
        std::this_thread::yield();
#endif
    }
};

}  // namespace

// Work beside a thread, done by whoever takes it first.
class Errand {
public:
    explicit Errand(std::function<void()> work) : work_(std::move(work)) {}

    // False where another thread has.
    bool take() { return !taken_.exchange(true); }

    // On a helper's thread.
    void run() {
        const Progress progress([this](double, std::string_view) { return !dropped_; });
        const Checkpoints checkpoints(progress);
        try {
            work_();
        } catch (...) {
            error_ = std::current_exception();
        }
        const std::scoped_lock lock(mutex_);
        done_ = true;
        ended_.notify_all();
    }

    void run_here() {
        work_();
        done_ = true;
    }

    void wait() {
        constexpr std::chrono::milliseconds between{50};
        if (!LookOut::until([this] { return done_.load(); })) {
            std::unique_lock lock(mutex_);
            while (!ended_.wait_for(lock, between, [this] { return done_.load(); })) checkpoint();
        }
        const std::scoped_lock lock(mutex_);  // run() has let go of it
        if (error_) std::rethrow_exception(error_);
    }

    void drop() {
        dropped_ = true;
        if (take()) return;
        std::unique_lock lock(mutex_);
        ended_.wait(lock, [this] { return done_.load(); });
    }

private:
    const std::function<void()> work_;
    std::atomic<bool> taken_ = false;
    std::atomic<bool> dropped_ = false;
    std::atomic<bool> done_ = false;
    std::exception_ptr error_;
    std::mutex mutex_;
    std::condition_variable ended_;
};

class ThreadTeam {
public:
    explicit ThreadTeam(int count) : helpers_wanted_(count - 1) {}

    ~ThreadTeam() {
        {
            const std::scoped_lock lock(mutex_);
            ends_ = true;
        }
        ++posted_;
        wake_.notify_all();
        for (std::thread& helper : helpers_) helper.join();
    }

    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    // Doesn't wait for helpers that have not begun by the time the work is done.
    void run(int pieces, const std::function<void(int)>& piece) {
        Job job(pieces, piece);
        start_helpers();
        post([&] {
            job_ = &job;
            ++generation_;
        });
        job.work();
        {
            const std::scoped_lock lock(mutex_);
            job_ = nullptr;
        }
        if (!LookOut::until([&] { return working_ == 0; })) {
            std::unique_lock lock(mutex_);
            idle_.wait(lock, [&] { return working_ == 0; });
        }
        job.rethrow();
    }

    void send(std::shared_ptr<Errand> errand) {
        start_helpers();
        post([&] { errands_.push_back(std::move(errand)); });
    }

private:
    void start_helpers() {
        for (; helpers_wanted_ > 0; --helpers_wanted_) {
            try {
                helpers_.emplace_back([this] { help(); });
            } catch (const std::system_error&) {
                helpers_wanted_ = 0;  // the system has no more threads for us: fewer do it too
                return;
            }
        }
    }

    // change(): of what helpers find to do.
    template <typename Change>
    void post(const Change& change) {
        bool asleep = false;
        {
            const std::scoped_lock lock(mutex_);
            change();
            asleep = asleep_ > 0;
        }
        ++posted_;  // without the lock, which who looks on takes next
        if (asleep) wake_.notify_all();
    }

    void help() {
        unsigned seen = 0;
        unsigned looked = 0;
        while (true) {
            const bool news = LookOut::until([&] { return posted_ != looked; });
            std::unique_lock lock(mutex_);
            looked = posted_;
            const auto is_wanted = [&] { return ends_ || !errands_.empty() || (job_ && generation_ != seen); };
            if (!is_wanted()) {
                if (news) continue;
                ++asleep_;
                wake_.wait(lock, is_wanted);
                --asleep_;
            }
            if (ends_) return;
            errands_.empty() ? help_with_job(lock, seen) : run_errand(lock);
        }
    }

    void help_with_job(std::unique_lock<std::mutex>& lock, unsigned& seen) {
        seen = generation_;
        Job& job = *job_;
        ++working_;
        lock.unlock();
        job.work();
        lock.lock();
        if (--working_ == 0) idle_.notify_all();
    }

    void run_errand(std::unique_lock<std::mutex>& lock) {
        const std::shared_ptr<Errand> errand = std::move(errands_.front());
        errands_.pop_front();
        lock.unlock();
        if (errand->take()) errand->run();
    }

    int helpers_wanted_;
    std::vector<std::thread> helpers_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable idle_;
    Job* job_ = nullptr;
    std::deque<std::shared_ptr<Errand>> errands_;
    unsigned generation_ = 0;           // of jobs
    std::atomic<unsigned> posted_ = 0;  // jobs, errands
    std::atomic<int> working_ = 0;
    int asleep_ = 0;
    bool ends_ = false;
};

namespace {

thread_local ThreadTeam* current_team = nullptr;

// The team of this thread, taken away for as long as it works on a loop.
class Taken {
public:
    Taken() : team(current_team) { current_team = nullptr; }
    ~Taken() { current_team = team; }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;

    ThreadTeam* const team;
};

}  // namespace

Threads::Threads(int count) : team_(std::make_unique<ThreadTeam>(wanted_threads(count))), previous_(current_team) {
    current_team = team_.get();
}

Threads::~Threads() { current_team = previous_; }

Beside::Beside(std::function<void()> work) : errand_(std::make_shared<Errand>(std::move(work))) {
    if (current_team) current_team->send(errand_);
}

Beside::~Beside() {
    if (errand_) errand_->drop();
}

void Beside::finish() {
    if (!errand_) return;
    const std::shared_ptr<Errand> errand = std::move(errand_);
    errand->take() ? errand->run_here() : errand->wait();
}

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
