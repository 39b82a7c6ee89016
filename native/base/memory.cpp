#include "base/memory.h"

#include <fstream>
#include <sstream>

namespace fairing {

namespace {

// Free vertices.
constexpr int least_checked = 100000;  // a seventh of a gigabyte

std::string gigabytes(double bytes) {
    std::ostringstream text;
    text.precision(2);
    text << bytes / 1e9 << " GB";
    return text.str();
}

}  // namespace

// Measured on hemispheres of 100k and 1M free vertices with uniform weights on two threads: up to 1.37 and 1.20 kB for
// each. λ that aren't symmetric take up to twice that.
double memory_estimate(int free_count) {
    constexpr double bytes = 1380.0;  // for each free vertex
    return bytes * free_count;
}

std::optional<double> available_memory() {
    std::ifstream report("/proc/meminfo");
    std::string name;
    double kilobytes = 0.0;
    double sum = 0.0;
    bool known = false;
    for (std::string unit; report >> name >> kilobytes && std::getline(report, unit);) {
        if (name == "MemAvailable:" || name == "SwapFree:") sum += 1024.0 * kilobytes;
        known = known || name == "MemAvailable:";
    }
    return known ? std::optional(sum) : std::nullopt;
}

void check_memory(int free_count, std::optional<double> available) {
    const double wanted = memory_estimate(free_count);
    if (free_count < least_checked || !available || wanted <= *available) return;
    throw MemoryShortage("about " + gigabytes(wanted) + " of memory are needed for " + std::to_string(free_count) +
                         " free vertices, and " + gigabytes(*available) + " are available");
}

void check_memory(int free_count) {
    if (free_count >= least_checked) check_memory(free_count, available_memory());
}

}  // namespace fairing
